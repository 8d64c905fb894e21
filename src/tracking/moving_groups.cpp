#include "tracking/moving_groups.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace stdc {
namespace {

struct Residual {
  int match = 0;
  float x = 0, y = 0;  ///< measured minus projected [px]
};

float median(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Whether the residuals of a group are a shift rather than noise.
bool is_shifted(const std::vector<Residual>& group) {
  constexpr std::size_t kMinSize = 5;
  constexpr float kMinShift = 1.2F;  // [px] systematic errors of the map and of the lens are below that
  if (group.size() < kMinSize) return false;
  std::vector<float> x, y;
  for (const Residual& r : group) {
    x.push_back(r.x);
    y.push_back(r.y);
  }
  const float shift_x = median(x), shift_y = median(y);
  const float shift = std::hypot(shift_x, shift_y);
  if (shift < kMinShift) return false;
  std::vector<float> apart;
  for (const Residual& r : group) apart.push_back(std::hypot(r.x - shift_x, r.y - shift_y));
  return median(apart) < 0.6F * shift;
}

}  // namespace

std::vector<std::uint8_t> find_moving_groups(const Camera& camera, const TrackedFrame& frame,
                                             const std::vector<FrameMatch>& matches) {
  constexpr int kColumns = 8;
  constexpr double kDepthStep = 0.3;  // of the logarithm: a third
  const double side = static_cast<double>(camera.width) / kColumns;
  std::map<std::array<int, 3>, std::vector<Residual>> groups;
  for (int i = 0; i < static_cast<int>(matches.size()); ++i) {
    const Eigen::Vector3d point = frame.cam_from_world * matches[static_cast<std::size_t>(i)].position;
    if (!(point.z() > 0.05)) continue;
    const Measurement& measurement =
        frame.measurements[static_cast<std::size_t>(matches[static_cast<std::size_t>(i)].keypoint)];
    const Eigen::Vector2d pixel = camera.project(point);
    const Eigen::Vector2f residual = measurement.pixel - pixel.cast<float>();
    const std::array<int, 3> key{static_cast<int>(std::floor(pixel.x() / side)),
                                 static_cast<int>(std::floor(pixel.y() / side)),
                                 static_cast<int>(std::floor(std::log(point.z()) / kDepthStep))};
    groups[key].push_back({i, residual.x(), residual.y()});
  }
  std::vector<std::uint8_t> moving(matches.size(), 0);
  std::size_t count = 0;
  for (const auto& [key, group] : groups) {
    if (!is_shifted(group)) continue;
    for (const Residual& r : group) moving[static_cast<std::size_t>(r.match)] = 1;
    count += group.size();
  }
  if (2 * count > matches.size()) std::fill(moving.begin(), moving.end(), 0);
  return moving;
}

}  // namespace stdc
