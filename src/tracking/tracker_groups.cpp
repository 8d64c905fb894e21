// The part of Tracker that leaves out groups of matches that move.
#include <algorithm>
#include <limits>

#include "tracking/moving_groups.hpp"
#include "tracking/tracker.hpp"

namespace stdc {

namespace {

/// Tells matches to what entered the map last, by the keyframes since: while the pose is uncertain none are
/// made, and nothing grows older.
class YoungMatches {
 public:
  YoungMatches(const LocalMap& local_map, double now) : local_map_(local_map), now_(now) {
    double first = now;
    for (const LocalReferenceView& view : local_map.reference_views) {
      if (view.timestamp > now) continue;  // of an earlier run, by another clock
      first = std::min(first, view.timestamp);
      last_ = std::max(last_, view.timestamp);
    }
    constexpr double kYoung = 1;  // [s], or half as long as the map is known here
    young_ = std::min(kYoung, 0.5 * (last_ - first));
  }
  bool contains(const FrameMatch& match) const {
    if (match.landmark < 0) return true;
    const double born = local_map_.reference_views[local_map_.landmarks[match.landmark].view].timestamp;
    return born <= now_ && last_ - born < young_;
  }

 private:
  const LocalMap& local_map_;
  double now_, last_ = -std::numeric_limits<double>::infinity(), young_ = 0;
};

/// Distance of two cameras [m] if it is clearly more than the first one's sigma, else 0.
double clear_distance(const PoseOptimisationResult& result, const Pose& other,
                      const TrackingSettings& settings) {
  constexpr double kClearly = 5;  // [sigma]
  const double sigma = position_sigma(TrackedFrame::covariance(result.information, settings));
  const double distance = (result.cam_from_world.inverse().translation - other.inverse().translation).norm();
  return distance > kClearly * sigma ? distance : 0;
}

}  // namespace

/// Aligns those of the matches that are not among the inliers.
void Tracker::align_refused(const LocalMap& local_map, const std::vector<FrameMatch>& matches,
                            const std::vector<FrameMatch>& inliers, TrackedFrame& frame) const {
  std::vector<std::uint8_t> agrees(static_cast<std::size_t>(frame.features->size()), 0);
  for (const FrameMatch& match : inliers) agrees[static_cast<std::size_t>(match.keypoint)] = 1;
  std::vector<FrameMatch> refused;
  for (const FrameMatch& match : matches) {
    if (agrees[static_cast<std::size_t>(match.keypoint)] == 0) refused.push_back(match);
  }
  align_matches(estimator_.sensor, local_map, refused, frame);
}

/// What has just entered the map has not proved to rest, however large it is: the pose that older landmarks
/// give decides whether it does. Else a thing that came in with the view that the camera turned to, and moves
/// slowly, takes the pose along as soon as it is in the map.
std::vector<FrameMatch> Tracker::drop_young_groups(TrackedFrame& frame, const LocalMap& local_map,
                                                   const std::vector<FrameMatch>& matches,
                                                   std::vector<FrameMatch> inliers) const {
  constexpr int kMinOld = 30;
  const YoungMatches young_ones(local_map, frame.timestamp);
  std::vector<FrameMatch> old, young;
  for (const FrameMatch& match : matches) (young_ones.contains(match) ? young : old).push_back(match);
  if (young.empty()) return inliers;
  frame.old_information = Matrix6d::Zero();
  frame.old_offset = 0;
  if (static_cast<int>(old.size()) < settings_.min_inliers) return inliers;
  align_refused(local_map, old, inliers, frame);
  const PoseOptimisationResult result =
      estimator_.estimate(make_observations(frame, old), frame.cam_from_world, motion_prior(frame));
  if (!result.usable || result.inliers < settings_.min_inliers) return inliers;
  frame.old_information = result.information;
  frame.old_offset = clear_distance(result, frame.cam_from_world, settings_);
  if (static_cast<int>(old.size()) < kMinOld || 2 * result.inliers < static_cast<int>(old.size()))
    return inliers;
  TrackedFrame alone = frame;
  alone.cam_from_world = result.cam_from_world;
  alone.information = result.information;
  const std::vector<Contradiction> found =
      find_contradicting_groups(estimator_.sensor, alone, alone.covariance(settings_), young);
  if (std::all_of(found.begin(), found.end(), [](Contradiction c) { return c == Contradiction::none; }))
    return inliers;
  for (std::size_t i = 0; i < young.size(); ++i) {
    if (found[i] == Contradiction::none) old.push_back(young[i]);
    if (found[i] == Contradiction::sure) frame.dynamic[young[i].keypoint] = 1;
  }
  frame.cam_from_world = result.cam_from_world;
  inliers = optimise(frame, std::move(old));
  frame.old_offset = clear_distance(result, frame.cam_from_world, settings_);
  return inliers;
}

/// Takes out what moves, and finds the pose again without it.
std::vector<FrameMatch> Tracker::drop_moving_groups(TrackedFrame& frame, std::vector<FrameMatch> inliers) {
  constexpr int kRounds = 2;  // a better pose may show more
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<std::uint8_t> moving =
        find_moving_groups(estimator_.sensor, frame, inliers, group_noise_);
    std::vector<FrameMatch> resting;
    for (std::size_t i = 0; i < inliers.size(); ++i) {
      if (moving[i] == 0) resting.push_back(inliers[i]);
      frame.dynamic[inliers[i].keypoint] |= moving[i];
    }
    if (resting.size() == inliers.size()) break;
    inliers = optimise(frame, std::move(resting));
  }
  return inliers;
}

}  // namespace stdc
