#include "motion/flow/followed_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "features/description/matching.hpp"

namespace stdc {
namespace {

constexpr std::array<double, 3> kLags = {0.06, 0.13, 0.33};  // [s] between frames that are compared
constexpr int kMaxDistance = 64;                             // [bits] of the descriptors

/// A keypoint that was found again elsewhere than a thing at rest would be.
struct Step {
  int keypoint = 0;
  Eigen::Vector2f pixel;
  Eigen::Vector3f point, step;  ///< in the camera now [m]
};

struct Comparison {
  std::vector<Step> steps;
  std::vector<int> resting;  ///< keypoints
};

/// How far off a thing at rest may be found: blur and the rolling shutter count while the camera turns.
double tolerance_px(const Camera& camera, const Pose& now_from_earlier, double elapsed) {
  constexpr double kStill = 2.5;                                 // [px]
  const double time_error = 0.003 + 0.45 * camera.readout_time;  // [s]
  const double rate = now_from_earlier.log().tail<3>().norm() / elapsed;
  return kStill * camera.width / 640 + 0.5 + camera.fx * time_error * rate;
}

void compare_point(const Camera& camera, const PointFrame& earlier, int i, const PointFrame& now,
                   const Pose& now_from_earlier, double tolerated, Comparison& found) {
  const Measurement& before = earlier.measurements[static_cast<std::size_t>(i)];
  if (!(before.depth > 0)) return;
  const Eigen::Vector3d expected =
      now_from_earlier * camera.unproject(before.pixel.cast<double>(), before.depth);
  if (expected.z() < 0.1) return;
  const Eigen::Vector2f pixel = camera.project(expected).cast<float>();
  const int level = earlier.features->keypoint(i).level;
  constexpr float kFarReach = 0.09F;  // of the image's width
  const float scale = earlier.features->scale(level);
  const SearchWindow near{pixel.x(), pixel.y(), static_cast<float>(tolerated) * scale, level - 1, level + 1};
  const SearchWindow wide{pixel.x(), pixel.y(), kFarReach * static_cast<float>(camera.width), level - 1,
                          level + 1};
  const Descriptor& descriptor = earlier.features->descriptor(i);
  const BestMatch here = match_in_window(*now.features, descriptor, near, {});
  const BestMatch best = match_in_window(*now.features, descriptor, wide, {});
  if (here.index >= 0 && here.distance <= kMaxDistance && here.distance <= best.distance + 10) {
    found.resting.push_back(here.index);
    return;
  }
  constexpr int kSure = 48;
  if (best.index < 0 || best.distance > kSure || best.distance > 0.8 * best.second) return;
  if (here.index >= 0 && best.distance > 0.7 * here.distance) return;
  const Measurement& after = now.measurements[static_cast<std::size_t>(best.index)];
  if (!(after.depth > 0)) return;
  const Eigen::Vector3d point = camera.unproject(after.pixel.cast<double>(), after.depth);
  constexpr double kMaxStep = 0.2, kMinStep = 0.01;  // [m]
  const double moved = (point - expected).norm();
  if (moved > kMaxStep || moved < kMinStep * expected.z()) return;
  found.steps.push_back({best.index, after.pixel, point.cast<float>(), (point - expected).cast<float>()});
}

/// Steps that neighbours on the same surface have taken too, where few rest.
void judge_steps(const Camera& camera, const Comparison& found, const PointFrame& now,
                 std::vector<PointMotion>& motion) {
  constexpr int kMinSupport = 5;
  const float reach = 0.12F * static_cast<float>(camera.width);
  const auto beside = [&](const Step& step, const Eigen::Vector2f& pixel, float depth) {
    return (pixel - step.pixel).lpNorm<Eigen::Infinity>() < reach &&
           std::abs(depth - step.point.z()) < 0.03F + 0.05F * step.point.z();
  };
  for (const Step& step : found.steps) {
    int support = 0, against = 0;
    for (const Step& other : found.steps) {
      if (!beside(step, other.pixel, other.point.z())) continue;
      const float apart = (other.step - step.step).head<2>().norm();
      (apart < 0.005F * step.point.z() + 0.3F * step.step.norm() ? support : against) += 1;
    }
    for (const int keypoint : found.resting) {
      const Measurement& there = now.measurements[static_cast<std::size_t>(keypoint)];
      against += beside(step, there.pixel, there.depth) ? 1 : 0;
    }
    if (support > kMinSupport && support > 2 * against)
      motion[static_cast<std::size_t>(step.keypoint)] = PointMotion::moves;
  }
}

}  // namespace

void FollowedPoints::follow(const AtlasSnapshot& snapshot) {
  for (PointFrame& frame : frames_) {
    frame.cam_from_world = snapshot.cam_from_world(frame.reference, frame.frame_from_reference);
    frame.map = snapshot.keyframes()[frame.reference.value].map;
  }
}

std::vector<PointMotion> FollowedPoints::add(PointFrame frame, bool compare) {
  std::vector<PointMotion> motion(frame.measurements.size(), PointMotion::unknown);
  if (!frames_.empty() && frames_.back().map != frame.map) frames_.clear();
  std::size_t last = frames_.size();
  for (const double lag : kLags) {
    std::size_t i = frames_.size();
    while (i > 0 && frame.timestamp - frames_[i - 1].timestamp < lag - 1e-3) --i;
    if (i == 0 || i == last || !compare) continue;
    last = i;
    const PointFrame& earlier = frames_[i - 1];
    const Pose now_from_earlier = frame.cam_from_world * earlier.cam_from_world.inverse();
    const double tolerated = tolerance_px(camera_, now_from_earlier, frame.timestamp - earlier.timestamp);
    Comparison found;
    for (int k = 0; k < earlier.features->size(); ++k)
      compare_point(camera_, earlier, k, frame, now_from_earlier, tolerated, found);
    for (const int keypoint : found.resting) {
      PointMotion& state = motion[static_cast<std::size_t>(keypoint)];
      if (state == PointMotion::unknown) state = PointMotion::rests;
    }
    judge_steps(camera_, found, frame, motion);
  }
  const auto moving = std::count(motion.begin(), motion.end(), PointMotion::moves);
  const auto resting = std::count(motion.begin(), motion.end(), PointMotion::rests);
  if (moving > resting) std::fill(motion.begin(), motion.end(), PointMotion::unknown);
  frames_.push_back(std::move(frame));
  while (frames_.size() > 1 && frames_.back().timestamp - frames_[1].timestamp > kLags.back())
    frames_.pop_front();
  return motion;
}

}  // namespace stdc
