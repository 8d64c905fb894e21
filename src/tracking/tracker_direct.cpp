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

std::vector<float> Tracker::sample_depth(const cv::Mat& depth, std::initializer_list<cv::Mat> masks) const {
  if (!settings_.direct_alignment) return {};
  std::vector<float> depths = aligner_.sample(depth);
  for (const cv::Mat& mask : masks) aligner_.forget(mask, depths);
  return depths;
}

}  // namespace stdc
