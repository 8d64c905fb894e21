#include "segmentation/network/onnx_segmenter.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

#ifdef STDC_HAVE_DNN
#include <algorithm>
#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include "segmentation/network/kernels/class_map.hpp"
#endif

namespace stdc {

#ifdef STDC_HAVE_DNN

namespace {

/// The first line of what OpenCV says, for a message of one line.
std::string first_line(const std::string& text) {
  return text.substr(0, std::min(text.find('\n'), std::size_t{200}));
}

}  // namespace

struct OnnxSegmenter::Implementation {
  std::string file;
  OnnxModel model;
  cv::dnn::Net net;

  /// The normalised RGB image as [1, 3, height, width].
  cv::Mat prepare(const cv::Mat& image) const {
    cv::Mat colour = image, small, floats;
    if (image.channels() == 1) cv::cvtColor(image, colour, cv::COLOR_GRAY2BGR);
    const bool shrinks = colour.cols > model.input_size.width || colour.rows > model.input_size.height;
    cv::resize(colour, small, model.input_size, 0, 0, shrinks ? cv::INTER_AREA : cv::INTER_LINEAR);
    cv::cvtColor(small, small, cv::COLOR_BGR2RGB);
    constexpr double kWhite = 255;
    small.convertTo(floats, CV_32FC3, 1 / kWhite);
    const auto &m = model.mean, &d = model.deviation;
    cv::subtract(floats, cv::Scalar(m[0], m[1], m[2]), floats);
    cv::divide(floats, cv::Scalar(d[0], d[1], d[2]), floats);
    return cv::dnn::blobFromImage(floats);
  }
  cv::Mat compute(const cv::Mat& image) {
    try {
      net.setInput(prepare(image));
      return net.forward();
    } catch (const cv::Exception& fault) {
      throw Error(file, "OpenCV cannot run it: " + first_line(fault.err),
                  "give a model for one RGB image, and its input size in the JSON file beside it");
    }
  }
  [[noreturn]] void refuse(const std::string& problem) const {
    throw Error(file, problem,
                "give a model for semantic segmentation, and its classes in the JSON file beside it");
  }
  /// Logits [1, classes, h, w].
  cv::Mat draw_logits(const cv::Mat& output, cv::Size size) const {
    const int classes = output.size[1];
    std::vector<bool> dynamic(static_cast<std::size_t>(classes), false);
    for (const int channel : model.dynamic_classes) {
      if (channel >= classes)
        refuse(fmt::format("has {} classes, not the one of number {}", classes, channel));
      dynamic[static_cast<std::size_t>(channel)] = true;
    }
    const Logits logits{{output.ptr<float>(), output.total()}, classes, output.size[2], output.size[3]};
    return ClassMap({logits.width, logits.height}, size, dynamic).draw(logits);
  }
  /// Class numbers [1, h, w] or [1, 1, h, w].
  cv::Mat draw_classes(const cv::Mat& output, cv::Size size) const {
    const int height = output.size[output.dims - 2], width = output.size[output.dims - 1];
    cv::Mat numbers;
    cv::Mat(height, width, output.type(), output.data).convertTo(numbers, CV_32F);
    cv::Mat small = cv::Mat::zeros(height, width, CV_8UC1), mask;
    for (const int channel : model.dynamic_classes) small |= numbers == channel;
    cv::resize(small, mask, size, 0, 0, cv::INTER_NEAREST);
    return mask;
  }
};

OnnxSegmenter::OnnxSegmenter(const std::filesystem::path& file, const OnnxModel& model)
    : implementation_(std::make_unique<Implementation>()) {
  implementation_->file = file.string();
  implementation_->model = model;
  std::error_code fault;
  if (!std::filesystem::is_regular_file(file, fault)) {
    throw Error(file.string(), "cannot be opened", "give the path of an ONNX model");
  }
  try {
    implementation_->net = cv::dnn::readNetFromONNX(file.string());
  } catch (const cv::Exception& problem) {
    throw Error(file.string(), "OpenCV cannot read it: " + first_line(problem.err),
                "export the model again with plain operators (opset 11 to 13)");
  }
  implementation_->net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
}

OnnxSegmenter::~OnnxSegmenter() = default;

cv::Mat OnnxSegmenter::segment(const SegmenterInput& input) {
  const cv::Mat& image = input.colour;
  if (image.empty() || (image.type() != CV_8UC3 && image.type() != CV_8UC1)) {
    throw Error(fmt::format("image of frame {}", input.frame), "is not an 8-bit colour or grey image",
                "give CV_8UC3 (BGR) or CV_8UC1");
  }
  const cv::Mat output = implementation_->compute(image);
  if (output.dims == 4 && output.size[0] == 1 && output.size[1] > 1 && output.type() == CV_32F) {
    return implementation_->draw_logits(output, image.size());
  }
  if ((output.dims == 3 && output.size[0] == 1) ||
      (output.dims == 4 && output.size[0] == 1 && output.size[1] == 1)) {
    return implementation_->draw_classes(output, image.size());
  }
  implementation_->refuse("gives neither class logits nor class numbers");
}

bool OnnxSegmenter::available() { return true; }

#else

struct OnnxSegmenter::Implementation {};

OnnxSegmenter::OnnxSegmenter(const std::filesystem::path& file, const OnnxModel&) {
  throw Error(file.string(), "this program was built without OpenCV's dnn module, which reads ONNX models",
              "install libopencv-dnn-dev and build with cmake -DSTDC_ONNX=ON, or give .safetensors weights");
}

OnnxSegmenter::~OnnxSegmenter() = default;

cv::Mat OnnxSegmenter::segment(const SegmenterInput&) { return {}; }

bool OnnxSegmenter::available() { return false; }

#endif

}  // namespace stdc
