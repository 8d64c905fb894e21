#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "calibration/calibration_scene.hpp"
#include "estimation/noise_settings.hpp"

namespace stdc {

/// What can be calibrated besides the scale of depth.
enum class CalibrationParameter : std::uint8_t { depth_time_offset, readout_time, focal_length, cx, cy };
inline constexpr int kCalibrationParameters = 5;

/// By CalibrationParameter: [s], [s], factor of fx and fy, [px], [px].
using CalibrationValues = std::array<double, kCalibrationParameters>;

inline double& value_of(CalibrationValues& values, CalibrationParameter parameter) {
  return values[static_cast<std::size_t>(parameter)];
}
inline double value_of(const CalibrationValues& values, CalibrationParameter parameter) {
  return values[static_cast<std::size_t>(parameter)];
}

/// The values of a camera, as they are given.
CalibrationValues calibration_values(const Camera& camera, double depth_time_offset);
/// The camera with these values. `given`: whose focal lengths the factor multiplies.
Camera calibrated_camera(const Camera& given, const CalibrationValues& values);

/// How well a scene fits together if the camera has certain values: the cost of its bundle adjustment, in
/// which the values change the pixels (lens, rolling shutter) and the depths (taken at another time). Which
/// observations count is fixed beforehand, so that costs of different values can be compared.
class CalibrationProblem {
 public:
  /// Keeps what is an inlier of a bundle adjustment at `values`, with noise as large as the residuals say.
  CalibrationProblem(const CalibrationScene& scene, const CalibrationValues& values);

  /// From now on only those depths count that there are at each of these values; keeps them, so that the cost
  /// at such values is had sooner.
  void choose_common_depths(std::span<const CalibrationValues> compared);
  /// A part of the observations: those of every so many points, or of a stretch of views in order of time.
  struct Part {
    int group = 0, groups = 0;  ///< groups 0: nothing
    bool of_views = false;
  };
  void leave_out(const Part& part) { left_out_ = part; }

  /// Half of the sum of robust, normalised squares at the best poses and points; nothing if the scene falls
  /// apart.
  std::optional<double> cost(const CalibrationValues& values) const;
  /// Goes on from the best poses and points at `values`.
  void settle(const CalibrationValues& values);

  int observations() const { return static_cast<int>(problem_.observations.size()); }
  int depths() const;  ///< that count
  const NoiseSettings& noise() const { return noise_; }

 private:
  BundleProblem posed(const CalibrationValues& values) const;
  void measure(const CalibrationValues& values, BundleProblem& problem) const;
  Eigen::Vector2f ideal_pixel(std::size_t i, const Camera& camera) const;
  std::vector<float> depths_at(const CalibrationValues& values) const;
  void keep_inliers(const BundleProblem& solved, const std::vector<std::uint8_t>& inlier);
  void estimate_noise(const BundleProblem& solved, const Camera& camera);

  const CalibrationScene& scene_;
  BundleProblem problem_;            ///< at the values settled last
  std::vector<std::size_t> source_;  ///< per observation: index into the scene's
  std::vector<std::uint8_t> chosen_depths_;
  std::map<CalibrationValues, std::vector<float>> depths_;  ///< at the values compared: depth, 0: none [m]
  Part left_out_;
  NoiseSettings noise_;
};

}  // namespace stdc
