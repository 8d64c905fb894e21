#include <gtest/gtest.h>

#include "input/depth_formats/test_depth_files.hpp"
#include "input/frame_decoder.hpp"
#include "input/layouts/record3d_metadata.hpp"
#include "input/open_source.hpp"
#include "input/test_layouts.hpp"

namespace stdc {
namespace {

using test::message_of;
using test::TestFolder;

constexpr const char* kRecord3dCamera =
    R"("w": 160, "h": 128, "dw": 80, "dh": 64, "fps": 60, "K": [140, 0, 0, 0, 141, 0, 79.5, 63.5, 1])";

/// Three frames below EXR_RGBD, as the app exports them: depth of half the size, in metres.
void write_export(const TestFolder& folder, const std::string& metadata,
                  const std::string& root = "EXR_RGBD/") {
  for (int i = 0; i < 3; ++i) {
    folder.write(fmt::format("{}rgb/{}.jpg", root, i + 8),
                 encode_jpeg(cv::Mat(128, 160, CV_8UC3, cv::Scalar(10, 20, 30))));
    folder.write(fmt::format("{}depth/{}.exr", root, i + 8),
                 test::make_exr(80, 64, "R", std::vector<float>(80 * 64, 1.5F + static_cast<float>(i))));
  }
  folder.write(root + "metadata.json", "{" + metadata + "}");
}

std::string ten_poses(const std::string& last) {
  std::string poses;
  for (int i = 0; i < 10; ++i) poses += fmt::format("[0, 0, 0, 1, {}, 2, 3], ", i);
  return R"(, "poses": [)" + poses + last + "]";
}

TEST(Record3d, ReadsAnExport) {
  const TestFolder folder;
  write_export(folder, std::string(kRecord3dCamera) + ten_poses("[0, 0, 0, 0, 0, 0, 0]") +
                           R"(, "frameTimestamps": [0, 1, 2, 3, 4, 5, 6, 7, 8.5, 9.25, 10.125])");
  const auto source = open_source(folder.path());
  EXPECT_EQ(source->kind(), "record3d");
  EXPECT_EQ(source->frame_count(), 3);
#ifndef STDC_WITH_EXR
  GTEST_SKIP() << "needs libopenexr-dev";
#endif
  const Camera camera = source->cameras()->colour;
  EXPECT_EQ(camera.fy, 141);
  EXPECT_EQ(camera.cx, 79.5);
  EXPECT_EQ(camera.frames_per_second, 60);
  ASSERT_TRUE(source->cameras()->depth);
  EXPECT_EQ(source->cameras()->depth->camera.width, 80);
  const FrameDecoder decoder(*source->cameras());
  const auto first = source->next(), second = source->next();
  ASSERT_TRUE(second);
  EXPECT_EQ(first->name, "8") << "8 comes before 10";
  EXPECT_EQ(second->timestamp, 9.25);
  const RgbdImage image = decoder.decode(*second, ColourMode::as_stored);
  ASSERT_EQ(image.depth.size(), cv::Size(160, 128));
  EXPECT_EQ(image.depth.at<float>(64, 80), 2.5F);

  const GroundTruth truth = source->ground_truth().value();
  ASSERT_EQ(truth.poses.size(), 2U);
  EXPECT_EQ(truth.without_pose, 1) << "all zero is no rotation";
  EXPECT_EQ(truth.poses[0].timestamp, 8.5);
  EXPECT_EQ(truth.poses[0].world_from_cam.translation, Eigen::Vector3d(8, 2, 3));
  // ARKit's camera looks along -z with y up.
  EXPECT_LT(
      (truth.poses[0].world_from_cam * Eigen::Vector3d(0.1, 0.2, 1) - Eigen::Vector3d(8.1, 1.8, 2)).norm(),
      1e-9);
  EXPECT_NE(source->notes().front().find("are poses that ARKit found, no ground truth"), std::string::npos);
}

TEST(Record3d, DoesWithoutTimesAndPoses) {
#ifndef STDC_WITH_EXR
  GTEST_SKIP() << "needs libopenexr-dev";
#endif
  const TestFolder folder;
  write_export(folder, kRecord3dCamera, "");
  cv::Mat confidence(64, 80, CV_8UC1, cv::Scalar(2));
  confidence(cv::Rect(0, 0, 40, 64)).setTo(0);
  folder.write("confidence/9.png", encode_png(confidence));
  const auto source = open_source(folder.path());
  EXPECT_EQ(source->kind(), "record3d");
  EXPECT_FALSE(source->ground_truth());
  EXPECT_NEAR(source->next()->timestamp, 8 / 60.0, 1e-12);
  EXPECT_NE(source->notes().front().find("has no times: frame n is taken to be at n / 60 s"),
            std::string::npos);
  const cv::Mat depth = source->next()->images->depth({});
  EXPECT_EQ(depth.at<float>(30, 10), 0) << "without confidence";
  EXPECT_EQ(depth.at<float>(30, 60), 2.5F);
  SourceOptions options;
  options.rate = 10;
  const auto slower = open_source(folder.path(), options);
  EXPECT_NEAR(slower->next()->timestamp, 0.8, 1e-12);
  folder.write("camera.yaml", format_camera(test::layout_camera()));
  EXPECT_EQ(open_source(folder.path())->cameras()->colour.width, 80) << "goes before";
}

TEST(Record3d, RefusesImagesOfAnotherShape) {
#ifndef STDC_WITH_EXR
  GTEST_SKIP() << "needs libopenexr-dev";
#endif
  const TestFolder folder;
  write_export(folder, R"("w": 128, "h": 160, "K": [140, 0, 0, 0, 141, 0, 63.5, 79.5, 1])");
  EXPECT_NE(message_of([&] { open_source(folder.path()); }).find("8.jpg: is 160 x 128 pixels, but by "),
            std::string::npos);
  std::filesystem::remove_all(folder / "EXR_RGBD/depth");
  std::filesystem::create_directories(folder / "EXR_RGBD/depth");
  EXPECT_NE(message_of([&] { open_source(folder.path()); }).find("no frame has images in both rgb and depth"),
            std::string::npos);
}

TEST(Record3d, RefusesMetadataThatIsNone) {
  const auto fault = [](const std::string& text) {
    return message_of([&] { parse_record3d_metadata(text, "metadata.json"); });
  };
  EXPECT_EQ(fault(std::string("{") + kRecord3dCamera + "}"), "");
  for (const char* text : {"", "[]", "{", "3"}) {
    EXPECT_NE(fault(text).find("metadata.json: is no JSON object"), std::string::npos) << text;
  }
  EXPECT_NE(fault(R"({"w": 1e99, "h": 3})").find("has no size of images"), std::string::npos);
  EXPECT_NE(fault(R"({"w": "4", "h": 3})").find("has no size of images"), std::string::npos);
  EXPECT_NE(fault(R"({"w": 4, "h": 3, "K": [1, 2]})").find("has no camera matrix"), std::string::npos);
  EXPECT_NE(fault(R"({"w": 4, "h": 3, "K": [1, 2, 3, 4, 5, 6, 7, 8, null]})").find("has no camera matrix"),
            std::string::npos);
  EXPECT_NE(fault(R"({"w": 4, "h": 3, "K": [0, 0, 0, 0, 5, 0, 2, 2, 1]})"), "") << "no focal length";
  // Times that do not go forward are none, poses that are none are missing.
  const Record3dMetadata metadata = parse_record3d_metadata(
      std::string("{") + kRecord3dCamera +
          R"(, "frameTimestamps": [0, 0], "poses": [3, [1], "x", [0, 0, 0, 1, 0, 0, 0]]})",
      "metadata.json");
  EXPECT_TRUE(metadata.times.empty());
  ASSERT_EQ(metadata.poses.size(), 4U);
  EXPECT_FALSE(metadata.poses[2]);
  EXPECT_TRUE(metadata.poses[3]);
}

}  // namespace
}  // namespace stdc
