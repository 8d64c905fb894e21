#include "calibration/calibration_problem.hpp"

#include <algorithm>
#include <cmath>

#include "atlas/keyframe.hpp"
#include "calibration/surface_depth.hpp"
#include "estimation/bundle_adjustment.hpp"

namespace stdc {
namespace {

/// To the minimum: costs of values that differ little are compared.
constexpr BundleSettings kExact{
    .robust_iterations = 30, .final_iterations = 0, .min_relative_decrease = 1e-7};

/// 1.4826 times the median of the magnitudes: the sigma of a normal distribution with some outliers.
double robust_sigma(std::vector<double> residuals) {
  if (residuals.empty()) return 0;
  for (double& r : residuals) r = std::abs(r);
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  return 1.4826 * *middle;
}

/// A depth image that was taken elsewhere than the colour image.
struct DisplacedDepth {
  const Camera& camera;
  const cv::Mat& depth;
  const Pose& step;  ///< camera at the time of the depth image from camera at that of the colour image
};

/// How far from the colour camera the surface is that it sees at a pixel (`raw` as it is stored, `ideal`
/// without the lens's distortion) [m]; 0: not known.
float depth_behind(const DisplacedDepth& displaced, Eigen::Vector2d raw, Eigen::Vector2f ideal) {
  const Camera& camera = displaced.camera;
  // Where the point is seen in the depth image depends on its depth; two rounds are exact to a tenth of a
  // pixel.
  double z = 0;
  for (int round = 0; round < 3; ++round) {
    const double measured = plane_depth_at(displaced.depth, camera.depth_units_per_metre, raw);
    if (measured <= 0) return 0;
    const double assumed = round == 0 ? measured : z;
    const Eigen::Vector3d here = camera.unproject(ideal.cast<double>(), assumed),
                          there = displaced.step * here;
    if (!(there.z() > 0)) return 0;
    z = measured - (there.z() - here.z());
    const Eigen::Vector2d seen = camera.project(there);
    raw = camera.has_distortion() ? camera.distort(seen) : seen;
  }
  return static_cast<float>(std::max(z, 0.0));
}

}  // namespace

CalibrationValues calibration_values(const Camera& camera, double depth_time_offset) {
  return {depth_time_offset, camera.readout_time, 1, camera.cx, camera.cy};
}

Camera calibrated_camera(const Camera& given, const CalibrationValues& values) {
  Camera camera = given;
  camera.readout_time = value_of(values, CalibrationParameter::readout_time);
  camera.fx = given.fx * value_of(values, CalibrationParameter::focal_length);
  camera.fy = given.fy * value_of(values, CalibrationParameter::focal_length);
  camera.cx = value_of(values, CalibrationParameter::cx);
  camera.cy = value_of(values, CalibrationParameter::cy);
  return camera;
}

CalibrationProblem::CalibrationProblem(const CalibrationScene& scene, const CalibrationValues& values)
    : scene_(scene), problem_(scene.problem) {
  source_.resize(problem_.observations.size());
  for (std::size_t i = 0; i < source_.size(); ++i) source_[i] = i;
  chosen_depths_.assign(source_.size(), 1);
  // Twice: with the noise of the first round outliers are told better.
  for (int round = 0; round < 2; ++round) {
    BundleProblem solved = posed(values);
    const Camera camera = calibrated_camera(scene_.camera, values);
    constexpr BundleSettings kTwoStages{
        .robust_iterations = 15, .final_iterations = 10, .min_relative_decrease = 1e-5, .loss_width = 0};
    const BundleResult result = bundle_adjust(camera, solved, noise_, kTwoStages);
    if (!result.usable) return;
    estimate_noise(solved, camera);
    keep_inliers(solved, result.inlier);
  }
}

void CalibrationProblem::keep_inliers(const BundleProblem& solved, const std::vector<std::uint8_t>& inlier) {
  problem_.cam_from_world = solved.cam_from_world;
  problem_.points = solved.points;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < inlier.size(); ++i) {
    if (inlier[i] == 0) continue;
    problem_.observations[kept] = problem_.observations[i];
    source_[kept++] = source_[i];
  }
  problem_.observations.resize(kept);
  source_.resize(kept);
  chosen_depths_.assign(kept, 1);
}

/// Depth is not trusted beyond what a depth camera keeps to over its whole range, however little a pixel
/// scatters: errors of the lens and of the disparity are not noise.
void CalibrationProblem::estimate_noise(const BundleProblem& solved, const Camera& camera) {
  constexpr double kMinPixel = 0.02, kMaxPixel = 5, kMinDepth = 0.002, kMaxDepth = 0.05;
  std::vector<double> pixels, depths;
  for (const BundleObservation& o : solved.observations) {
    const Eigen::Vector3d point = solved.cam_from_world[static_cast<std::size_t>(o.pose)] *
                                  solved.points[static_cast<std::size_t>(o.point)];
    if (!(point.z() > 0)) continue;
    const Eigen::Vector2d residual = (camera.project(point) - o.pixel.cast<double>()) / o.scale;
    pixels.push_back(residual.x());
    pixels.push_back(residual.y());
    if (o.depth > 0) depths.push_back(1 / point.z() - 1 / o.depth);
  }
  if (!pixels.empty()) noise_.pixel_sigma = std::clamp(robust_sigma(std::move(pixels)), kMinPixel, kMaxPixel);
  if (!depths.empty())
    noise_.inverse_depth_sigma = std::clamp(robust_sigma(std::move(depths)), kMinDepth, kMaxDepth);
}

Eigen::Vector2f CalibrationProblem::ideal_pixel(std::size_t i, const Camera& camera) const {
  const Eigen::Vector2d& raw = scene_.raw[source_[i]];
  return (camera.has_distortion() ? camera.undistort(raw) : raw).cast<float>();
}

std::vector<float> CalibrationProblem::depths_at(const CalibrationValues& values) const {
  const Camera camera = calibrated_camera(scene_.camera, values);
  std::vector<std::optional<Pose>> steps;
  for (const CalibrationView& view : scene_.views) {
    const double delay = view.depth_delay + value_of(values, CalibrationParameter::depth_time_offset);
    steps.push_back(camera_step(scene_.trajectory, view.timestamp, delay));
  }
  std::vector<float> depths(source_.size(), 0.0f);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const auto view = static_cast<std::size_t>(problem_.observations[i].pose);
    if (!steps[view]) continue;
    depths[i] = depth_behind({camera, scene_.views[view].depth, *steps[view]}, scene_.raw[source_[i]],
                             ideal_pixel(i, camera));
  }
  return depths;
}

void CalibrationProblem::choose_common_depths(std::span<const CalibrationValues> compared) {
  depths_.clear();
  chosen_depths_.assign(source_.size(), 1);
  for (const CalibrationValues& values : compared) {
    const std::vector<float>& there = depths_.try_emplace(values, depths_at(values)).first->second;
    for (std::size_t i = 0; i < there.size(); ++i) {
      if (there[i] <= 0) chosen_depths_[i] = 0;
    }
  }
}

void CalibrationProblem::measure(const CalibrationValues& values, BundleProblem& problem) const {
  const Camera camera = calibrated_camera(scene_.camera, values);
  const auto kept = depths_.find(values);
  const std::vector<float> depths = kept != depths_.end() ? kept->second : depths_at(values);
  for (std::size_t i = 0; i < problem.observations.size(); ++i) {
    BundleObservation& o = problem.observations[i];
    const CameraMotion motion(camera, scene_.views[static_cast<std::size_t>(o.pose)].twist);
    const Eigen::Vector3d point = problem.cam_from_world[static_cast<std::size_t>(o.pose)] *
                                  problem.points[static_cast<std::size_t>(o.point)];
    const Measurement m = stdc::measure(camera, motion, ideal_pixel(i, camera), static_cast<float>(point.z()),
                                        chosen_depths_[i] != 0 ? depths[i] : 0, o.scale);
    o.pixel = m.pixel;
    o.depth = m.depth;
  }
}

BundleProblem CalibrationProblem::posed(const CalibrationValues& values) const {
  BundleProblem problem = problem_;
  measure(values, problem);
  const auto views = static_cast<int>(problem.cam_from_world.size());
  if (left_out_.groups > 0) {
    std::erase_if(problem.observations, [&](const BundleObservation& o) {
      const int group = left_out_.of_views ? o.pose * left_out_.groups / views : o.point % left_out_.groups;
      return group == left_out_.group;
    });
  }
  return problem;
}

int CalibrationProblem::depths() const {
  return static_cast<int>(std::count(chosen_depths_.begin(), chosen_depths_.end(), 1));
}

std::optional<double> CalibrationProblem::cost(const CalibrationValues& values) const {
  BundleProblem problem = posed(values);
  const BundleResult result =
      bundle_adjust(calibrated_camera(scene_.camera, values), problem, noise_, kExact);
  if (!result.usable) return std::nullopt;
  return result.final_cost;
}

void CalibrationProblem::settle(const CalibrationValues& values) {
  BundleProblem problem = posed(values);
  const Camera camera = calibrated_camera(scene_.camera, values);
  if (!bundle_adjust(camera, problem, noise_, kExact).usable) return;
  problem_.cam_from_world = problem.cam_from_world;
  problem_.points = problem.points;
  estimate_noise(problem, camera);
}

}  // namespace stdc
