#include "atlas/visibility.hpp"

#include <algorithm>
#include <cmath>

namespace stdc {

std::optional<Eigen::Vector2d> ViewingImage::project(const Eigen::Vector3d& position) const {
  constexpr double kMinDepth = 0.05;  // [m]
  const Eigen::Vector3d point = cam_from_world_ * position;
  if (!(point.z() > kMinDepth)) return {};
  const Eigen::Vector2d pixel = motion_.project(camera_, point);
  if (!camera_.shows(pixel)) return {};
  return pixel;
}

std::optional<ViewingImage::Expected> ViewingImage::expect(const LandmarkGeometry& landmark) const {
  constexpr float kMinCosine = 0.5F;  // 60 degrees
  // The range of scales is widened a little: the level of a keypoint is not exact.
  constexpr float kNearer = 0.8F, kFarther = 1.2F;
  const auto pixel = project(landmark.position);
  if (!pixel) return {};
  const Eigen::Vector3f ray = (landmark.position - centre_).cast<float>();
  const float distance = ray.norm();
  if (distance < kNearer * landmark.min_distance || distance > kFarther * landmark.max_distance) return {};
  const float cosine = ray.dot(landmark.direction) / distance;
  if (cosine < kMinCosine) return {};
  const int level =
      static_cast<int>(std::ceil(std::log(landmark.max_distance / distance) / features_.log_scale_factor()));
  return Expected{pixel->cast<float>(), cosine, std::clamp(level, 0, features_.levels() - 1)};
}

SearchWindow ViewingImage::window(const Expected& expected, double radius, int coarser) const {
  return {expected.pixel.x(), expected.pixel.y(),
          static_cast<float>(radius) * features_.scale(expected.level), std::max(expected.level - 1, 0),
          std::min(expected.level + coarser, features_.levels() - 1)};
}

}  // namespace stdc
