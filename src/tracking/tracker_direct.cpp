// The part of Tracker that finds a pose where features fail.
#include <algorithm>

#include "tracking/tracker.hpp"

namespace stdc {

/// Where a fast turn blurs the image: the images' brightness as a whole gives the pose, and features are
/// looked for from there. If there are still too few, the pose goes without landmarks.
bool Tracker::track_directly(TrackedFrame& frame, const LocalMap& local_map) {
  const auto aligned =
      aligner_.align({last_->pyramid, last_->grid_depths}, {frame.pyramid, frame.grid_depths},
                     predict(frame.timestamp) * last_->cam_from_world.inverse());
  if (!aligned) return false;
  const Pose cam_from_world = aligned->frame_from_last * last_->cam_from_world;
  frame.aligned = PosePrior{cam_from_world, aligned->information};
  frame.cam_from_world = cam_from_world;
  frame.set_motion(camera(), velocity_to(frame));
  std::vector<FrameMatch> matches = optimise(
      frame, match_last_frame(camera(), local_map, *last_, frame, settings_.search_radius, settings_));
  if (static_cast<int>(matches.size()) < settings_.min_inliers_motion) frame.cam_from_world = cam_from_world;
  const std::size_t counted = counts_.size();
  if (refine(frame, local_map, std::move(matches), settings_.local_map_radius, settings_.min_inliers))
    return true;
  counts_.resize(counted);
  missing_.clear();
  frame.cam_from_world = cam_from_world;
  frame.information = aligned->information;
  frame.set_motion(camera(), velocity_to(frame));
  std::fill(frame.landmarks.begin(), frame.landmarks.end(), LandmarkId());
  std::fill(frame.outlier.begin(), frame.outlier.end(), 0);
  std::fill(frame.dynamic.begin(), frame.dynamic.end(), 0);
  frame.inliers = frame.temporary_inliers = 0;
  return true;
}

/// A few matches that agree can agree on a wrong pose, centimetres off, when the prediction was too far away
/// for the right ones to be looked at. A pose from the whole images is taken if clearly more landmarks agree
/// with it: chance makes a few more or less. Temporary points do not count: like the images, they know the
/// last frame only.
void Tracker::prefer_direct(TrackedFrame& frame, const LocalMap& local_map, std::size_t counted) {
  constexpr double kClearly = 1.5;
  const std::vector<Count> counts(counts_.begin() + static_cast<std::ptrdiff_t>(counted), counts_.end());
  const std::vector<MissingLandmark> missing = missing_;
  TrackedFrame direct = frame;
  counts_.resize(counted);
  if (track_directly(direct, local_map) && direct.inliers >= kClearly * frame.inliers) {
    frame = std::move(direct);
    return;
  }
  counts_.resize(counted);
  counts_.insert(counts_.end(), counts.begin(), counts.end());
  missing_ = missing;
}

std::vector<float> Tracker::sample_depth(const cv::Mat& depth, std::initializer_list<cv::Mat> masks) const {
  if (!settings_.direct_alignment) return {};
  std::vector<float> depths = aligner_.sample(depth);
  for (const cv::Mat& mask : masks) aligner_.forget(mask, depths);
  return depths;
}

}  // namespace stdc
