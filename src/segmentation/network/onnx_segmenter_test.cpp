#include "segmentation/network/onnx_segmenter.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/files/test_folder.hpp"

namespace stdc {
namespace {

using test::message_of;
using test::TestFolder;

// What ONNX needs of the protocol buffers' wire format: numbers and nested messages.
std::string varint(std::uint64_t value) {
  std::string bytes;
  for (; value > 127; value >>= 7U) bytes += static_cast<char>(0x80U | (value & 127U));
  return bytes + static_cast<char>(value);
}
std::string number(std::uint64_t field, std::uint64_t value) { return varint(field << 3U) + varint(value); }
std::string part(std::uint64_t field, const std::string& content) {
  return varint((field << 3U) | 2U) + varint(content.size()) + content;
}

std::string float_tensor(const std::string& name, const std::vector<int>& shape,
                         const std::vector<float>& values) {
  std::string bytes;
  for (const int size : shape) bytes += number(1, static_cast<std::uint64_t>(size));
  constexpr int kFloat = 1;
  bytes += number(2, kFloat) + part(8, name);
  return bytes + part(9, {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)});
}

std::string tensor_info(const std::string& name, const std::vector<int>& shape) {
  std::string dims;
  for (const int size : shape) dims += part(1, number(1, static_cast<std::uint64_t>(size)));
  return part(1, name) + part(2, part(1, number(1, 1) + part(2, dims)));
}

/// A model of one 1x1 convolution: class 0 gets nothing, class 1 the red channel, class 2 the blue one.
std::string colour_model(int width, int height) {
  std::string node = part(1, "image") + part(1, "w") + part(2, "logits") + part(4, "Conv");
  node += part(5, part(1, "kernel_shape") + number(8, 1) + number(8, 1) + number(20, 7));
  const std::string graph = part(1, node) + part(2, "g") +
                            part(5, float_tensor("w", {3, 3, 1, 1}, {0, 0, 0, 1, 0, 0, 0, 0, 1})) +
                            part(11, tensor_info("image", {1, 3, height, width})) +
                            part(12, tensor_info("logits", {1, 3, height, width}));
  return number(1, 7) + part(7, graph) + part(8, number(2, 11));
}

TEST(OnnxDescription, HasDefaultsAndIsChecked) {
  const TestFolder folder;
  EXPECT_EQ(read_onnx_description(folder / "net.onnx").dynamic_classes, std::vector<int>{15});
  folder.write("net.json", std::string(R"({"input_width":320,"mean":[0,0,0],"dynamic_classes":[1,2]})"));
  const OnnxModel model = read_onnx_description(folder / "net.onnx");
  EXPECT_EQ(model.input_size, cv::Size(320, 384));
  EXPECT_EQ(model.mean[1], 0);
  EXPECT_EQ(model.dynamic_classes, (std::vector<int>{1, 2}));
  for (const char* bad : {"[]", "x", R"({"input_width":0})", R"({"input_width":"a"})", R"({"std":[0,1,1]})",
                          R"({"mean":[1]})", R"({"dynamic_classes":[-1]})"}) {
    folder.write("net.json", std::string(bad));
    EXPECT_NE(message_of([&] { read_onnx_description(folder / "net.onnx"); }).find("net.json: "),
              std::string::npos)
        << bad;
  }
}

TEST(OnnxSegmenter, SaysThatItIsNotThere) {
  if (OnnxSegmenter::available()) GTEST_SKIP() << "it is";
  EXPECT_NE(message_of([] { OnnxSegmenter("net.onnx", {}); }).find("-DSTDC_ONNX=ON"), std::string::npos);
}

TEST(OnnxSegmenter, RunsAModel) {
  if (!OnnxSegmenter::available()) GTEST_SKIP() << "built without OpenCV's dnn module";
  const TestFolder folder;
  const auto file = folder.write("net.onnx", colour_model(64, 32));
  OnnxSegmenter segmenter(file, {{64, 32}, {0.5, 0.5, 0.5}, {0.25, 0.25, 0.25}, {1}});
  cv::Mat image(120, 160, CV_8UC3, cv::Scalar(20, 20, 20));
  image(cv::Rect(80, 0, 80, 120)) = cv::Scalar(10, 10, 250);  // red
  image(cv::Rect(0, 60, 80, 60)) = cv::Scalar(250, 10, 10);   // blue
  const cv::Mat mask = segmenter.segment({image, 0, 0});
  ASSERT_EQ(mask.size(), image.size());
  cv::Mat wanted(image.size(), CV_8UC1, cv::Scalar(0));
  wanted(cv::Rect(80, 0, 80, 120)) = 255;
  EXPECT_LT(cv::countNonZero(mask != wanted), 120 * 3);
  OnnxSegmenter other(file, {{64, 32}, {0.5, 0.5, 0.5}, {0.25, 0.25, 0.25}, {3}});
  EXPECT_NE(message_of([&] {
              other.segment({image, 0, 0});
            }).find("has 3 classes, not the one of number 3"),
            std::string::npos);
}

TEST(OnnxSegmenter, RefusesDamagedFiles) {
  if (!OnnxSegmenter::available()) GTEST_SKIP() << "built without OpenCV's dnn module";
  const TestFolder folder;
  EXPECT_NE(message_of([&] { OnnxSegmenter(folder / "none.onnx", {}); }).find("none.onnx: cannot be opened"),
            std::string::npos);
  const auto file = folder.write("net.onnx", std::string("no model"));
  EXPECT_NE(message_of([&] { OnnxSegmenter(file, {}); }).find("net.onnx: OpenCV cannot read it"),
            std::string::npos);
}

}  // namespace
}  // namespace stdc
