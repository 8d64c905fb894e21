#include "dense/fusion/rectifier.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace stdc {
namespace {

constexpr double kMaxTangent = 1.7320508;  // 60 degrees off the axis: beyond, a pinhole wastes its pixels
constexpr double kMaxGrowth = 1.5;         // of the image's sides by the lens

/// Bounds of the rays x / z, y / z that the border of the image shows.
struct RayBounds {
  double left = 0, right = 0, top = 0, bottom = 0;

  void add(const Camera& camera, double x, double y) {
    Eigen::Vector2d ideal = camera.undistort({x, y});
    const double u = std::clamp((ideal.x() - camera.cx) / camera.fx, -kMaxTangent, kMaxTangent);
    const double v = std::clamp((ideal.y() - camera.cy) / camera.fy, -kMaxTangent, kMaxTangent);
    left = std::min(left, u), right = std::max(right, u);
    top = std::min(top, v), bottom = std::max(bottom, v);
  }
};

template <typename T, typename Convert>
void gather(const cv::Mat& from, const std::vector<int>& source, cv::Mat& to, const Convert& convert) {
  const auto* in = from.ptr<T>();
  auto* out = to.ptr<float>();
  for (std::size_t i = 0; i < source.size(); ++i) out[i] = source[i] < 0 ? 0.F : convert(in[source[i]]);
}

}  // namespace

Pinhole pinhole_of(const Camera& camera) {
  Pinhole pinhole{camera.width,
                  camera.height,
                  static_cast<float>(camera.fx),
                  static_cast<float>(camera.fy),
                  static_cast<float>(camera.cx),
                  static_cast<float>(camera.cy)};
  if (!camera.has_distortion()) return pinhole;
  RayBounds bounds;
  for (int x = 0; x < camera.width; ++x) {
    bounds.add(camera, x, 0);
    bounds.add(camera, x, camera.height - 1);
  }
  for (int y = 0; y < camera.height; ++y) {
    bounds.add(camera, 0, y);
    bounds.add(camera, camera.width - 1, y);
  }
  const double across = (bounds.right - bounds.left) * camera.fx,
               down = (bounds.bottom - bounds.top) * camera.fy;
  const double scale = std::min({1.0, kMaxGrowth * camera.width / across, kMaxGrowth * camera.height / down});
  pinhole.fx = static_cast<float>(camera.fx * scale);
  pinhole.fy = static_cast<float>(camera.fy * scale);
  pinhole.width = static_cast<int>(std::ceil(across * scale)) + 1;
  pinhole.height = static_cast<int>(std::ceil(down * scale)) + 1;
  pinhole.cx = static_cast<float>(-bounds.left * camera.fx * scale);
  pinhole.cy = static_cast<float>(-bounds.top * camera.fy * scale);
  return pinhole;
}

Rectifier::Rectifier(const Camera& camera)
    : units_(static_cast<float>(1 / camera.depth_units_per_metre)),
      raw_(camera.width, camera.height),
      pinhole_(pinhole_of(camera)),
      identity_(!camera.has_distortion()) {
  if (identity_) return;
  const cv::Size size(pinhole_.width, pinhole_.height);
  source_.reserve(static_cast<std::size_t>(size.area()));
  smooth_x_.create(size, CV_32FC1), smooth_y_.create(size, CV_32FC1);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const Eigen::Vector2d ideal(pinhole_.ray_x(static_cast<float>(x)) * camera.fx + camera.cx,
                                  pinhole_.ray_y(static_cast<float>(y)) * camera.fy + camera.cy);
      Eigen::Vector2d raw(-1, -1);
      // Far outside a lens model may fold back into the image.
      if (camera.shows(ideal)) raw = camera.distort(ideal);
      const int column = static_cast<int>(std::lround(raw.x())), row = static_cast<int>(std::lround(raw.y()));
      const bool seen = column >= 0 && row >= 0 && column < raw_.width && row < raw_.height;
      source_.push_back(seen ? row * raw_.width + column : -1);
      smooth_x_.at<float>(y, x) = seen ? static_cast<float>(raw.x()) : -10;
      smooth_y_.at<float>(y, x) = seen ? static_cast<float>(raw.y()) : -10;
    }
  }
}

cv::Mat Rectifier::depth(const cv::Mat& depth, float max_depth) const {
  cv::Mat z(pinhole_.height, pinhole_.width, CV_32FC1);
  if (depth.empty()) return z.setTo(0);
  const cv::Mat flat = depth.isContinuous() ? depth : depth.clone();
  const auto from_units = [this, max_depth](std::uint16_t value) {
    const float metres = static_cast<float>(value) * units_;
    return metres <= max_depth ? metres : 0.F;
  };
  const auto from_metres = [max_depth](float metres) {
    return metres > 0 && metres <= max_depth ? metres : 0.F;
  };
  if (!identity_) {
    if (depth.type() == CV_16UC1) {
      gather<std::uint16_t>(flat, source_, z, from_units);
    } else {
      gather<float>(flat, source_, z, from_metres);
    }
    return z;
  }
  auto* out = z.ptr<float>();
  const std::size_t count = z.total();
  if (depth.type() == CV_16UC1) {
    const auto* in = flat.ptr<std::uint16_t>();
    for (std::size_t i = 0; i < count; ++i) out[i] = from_units(in[i]);
  } else {
    const auto* in = flat.ptr<float>();
    for (std::size_t i = 0; i < count; ++i) out[i] = from_metres(in[i]);
  }
  return z;
}

cv::Mat Rectifier::mask(const cv::Mat& mask, std::uint8_t outside) const {
  if (identity_) return mask;
  cv::Mat result(pinhole_.height, pinhole_.width, CV_8UC1);
  const cv::Mat flat = mask.isContinuous() ? mask : mask.clone();
  for (std::size_t i = 0; i < source_.size(); ++i) {
    result.data[i] = source_[i] < 0 ? outside : flat.data[source_[i]];
  }
  return result;
}

cv::Mat Rectifier::colour(const cv::Mat& image) const {
  if (identity_) return image.clone();
  cv::Mat result;
  cv::remap(image, result, smooth_x_, smooth_y_, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  return result;
}

}  // namespace stdc
