#include "viewer/messages/image_message.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/images/image_codec.hpp"
#include "viewer/messages/byte_writer.hpp"
#include "viewer/server/view_request.hpp"

namespace stdc {
namespace {

constexpr int kWidth = 640, kMaskWidth = 320;  // [px] at most
constexpr int kQuality = 80;

std::string text_of(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

cv::Size size_within(cv::Size size, int width) {
  if (size.width <= width) return size;
  return {width, std::max(1, size.height * width / size.width)};
}

cv::Mat resized(const cv::Mat& image, int width, int interpolation) {
  const cv::Size size = size_within(image.size(), width);
  if (size == image.size()) return image;
  cv::Mat small;
  cv::resize(image, small, size, 0, 0, interpolation);
  return small;
}

struct DrawnDepth {
  std::string png;
  float near = 0, far = 0;  // [m]
};

/// What nine tenths of the depths lie below, in whole metres: a scale that changes seldom.
float far_of(const cv::Mat& metres) {
  std::vector<float> depths;
  depths.reserve(metres.total());
  for (int y = 0; y < metres.rows; y += 4) {
    for (int x = 0; x < metres.cols; x += 4) {
      if (metres.at<float>(y, x) > 0) depths.push_back(metres.at<float>(y, x));
    }
  }
  constexpr float kMin = 2, kMax = 20, kShare = 0.95F;
  if (depths.empty()) return kMin;
  const auto nth =
      depths.begin() + static_cast<std::ptrdiff_t>(kShare * static_cast<float>(depths.size() - 1));
  std::nth_element(depths.begin(), nth, depths.end());
  return std::clamp(std::ceil(*nth), kMin, kMax);
}

DrawnDepth draw_depth(const cv::Mat& depth, double units_per_metre) {
  const cv::Mat small = resized(depth, kMaskWidth, cv::INTER_NEAREST);
  cv::Mat metres;
  small.convertTo(metres, CV_32F, depth.type() == CV_16UC1 ? 1 / units_per_metre : 1);
  cv::patchNaNs(metres, 0);
  DrawnDepth drawn;
  drawn.far = far_of(metres);
  cv::Mat grey(metres.size(), CV_8UC1, cv::Scalar(0));
  for (int y = 0; y < metres.rows; ++y) {
    for (int x = 0; x < metres.cols; ++x) {
      const float z = metres.at<float>(y, x);
      if (z <= 0) continue;
      constexpr float kSteps = 254;
      const float step = std::clamp((z - drawn.near) / (drawn.far - drawn.near), 0.0F, 1.0F) * kSteps;
      grey.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(1 + std::lround(step));
    }
  }
  drawn.png = text_of(encode_png(grey, PngEffort::fast));
  return drawn;
}

std::string draw_masks(const cv::Mat& network, const cv::Mat& motion) {
  if (network.empty() && motion.empty()) return {};
  cv::Mat causes(network.empty() ? motion.size() : network.size(), CV_8UC1, cv::Scalar(0));
  constexpr int kNetwork = 1, kMotion = 2;
  if (!network.empty()) causes.setTo(kNetwork, network);
  if (!motion.empty()) cv::bitwise_or(causes, kMotion, causes, motion);
  return text_of(encode_png(resized(causes, kMaskWidth, cv::INTER_NEAREST), PngEffort::fast));
}

std::uint16_t eighths(float pixel) {
  constexpr float kEighths = 8, kMax = 65535;
  return static_cast<std::uint16_t>(std::clamp(pixel * kEighths, 0.0F, kMax));
}

}  // namespace

std::string encode_small_jpeg(const cv::Mat& colour, int width, int quality) {
  return text_of(encode_jpeg(resized(colour, width, cv::INTER_AREA), quality));
}

cv::Mat ViewColour::image() const {
  if (!in_colour) return seen;
  try {
    cv::Mat coloured = in_colour();
    return coloured.size() == seen.size() ? coloured : seen;
  } catch (const std::exception&) {  // grey will do
    return seen;
  }
}

std::string encode_image(const ViewImage& image, std::uint32_t wanted) {
  const std::string colour = encode_small_jpeg(image.colour.image(), kWidth, kQuality);
  DrawnDepth depth;
  if ((wanted & kWantDepth) != 0 && !image.depth.empty()) {
    depth = draw_depth(image.depth, image.depth_units_per_metre);
  }
  std::string masks;
  if ((wanted & kWantMasks) != 0) masks = draw_masks(image.found.segmented, image.found.moving);
  const std::vector<Keypoint>& keypoints = image.found.keypoints;
  ByteWriter bytes;
  bytes.put(static_cast<std::uint32_t>(image.frame));
  bytes.put(static_cast<std::uint16_t>(image.colour.seen.cols));
  bytes.put(static_cast<std::uint16_t>(image.colour.seen.rows));
  bytes.put(depth.near);
  bytes.put(depth.far);
  for (const std::size_t size : {colour.size(), depth.png.size(), masks.size(), keypoints.size()}) {
    bytes.put(static_cast<std::uint32_t>(size));
  }
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    bytes.put(eighths(keypoints[i].x));
    bytes.put(eighths(keypoints[i].y));
    bytes.put(static_cast<std::uint8_t>(image.found.states[i]));
    bytes.put(static_cast<std::uint8_t>(keypoints[i].quality == KeypointQuality::high));
  }
  for (const std::string& part : {colour, depth.png, masks}) bytes.put_bytes(part);
  return bytes.take();
}

}  // namespace stdc
