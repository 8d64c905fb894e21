#include "calibration/scene_recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "atlas/map_bundle.hpp"
#include "core/error.hpp"
#include "slam/pipeline.hpp"

namespace stdc {
namespace {

constexpr std::size_t kMinKeyframes = 5;

Settings still_room(Settings settings) {
  settings.segmentation.source = SegmentationSource::off;
  settings.motion.method = MotionMethod::off;
  settings.dense.active = false;
  // Many views, and none given up because others show the same: each has its own motion.
  settings.tracking.tracked_ratio = 0.95;
  settings.tracking.parallax_ratio = 0.04;
  settings.tracking.max_keyframe_gap = 0.2;
  settings.mapping.redundant_share = 1;
  return settings;
}

std::vector<KeyframeId> largest_map(const Atlas& atlas) {
  std::vector<KeyframeId> largest;
  for (std::uint32_t map = 0; map < atlas.next_map().value; ++map) {
    std::vector<KeyframeId> keyframes = atlas.keyframe_ids(MapId{map});
    if (keyframes.size() > largest.size()) largest = std::move(keyframes);
  }
  return largest;
}

std::vector<StampedPose> trajectory_in(const std::vector<FramePose>& poses, MapId map) {
  std::vector<StampedPose> trajectory;
  for (const FramePose& pose : poses) {
    if (pose.map == map) trajectory.push_back({pose.timestamp, pose.world_from_cam});
  }
  return trajectory;
}

}  // namespace

SceneRecorder::SceneRecorder(const Camera& camera, Settings settings)
    : pipeline_(std::make_unique<Pipeline>(camera, still_room(std::move(settings)), nullptr)) {}

SceneRecorder::~SceneRecorder() = default;

TrackingStatus SceneRecorder::track(const RgbdImage& image, double depth_delay) {
  const TrackingResult result = pipeline_->track(image);
  if (result.is_keyframe) depths_[result.frame] = {depth_delay, image.depth.clone()};
  return result.status;
}

void SceneRecorder::skip(double timestamp) { pipeline_->skip(timestamp); }

CalibrationScene SceneRecorder::finish(const std::string& where) {
  pipeline_->finish();
  const Atlas& atlas = pipeline_->atlas();
  std::vector<KeyframeId> keyframes = largest_map(atlas);
  std::erase_if(keyframes, [&](KeyframeId id) { return !depths_.contains(atlas.keyframe(id).frame); });
  if (keyframes.size() < kMinKeyframes) {
    throw Error(
        where,
        fmt::format("gave a map of {} keyframes, too few to tell anything of its cameras", keyframes.size()),
        "move the camera about in a still room with many corners for half a minute");
  }
  CalibrationScene scene;
  scene.camera = pipeline_->camera();
  const MapId map = atlas.map_of(keyframes.front());
  scene.trajectory = trajectory_in(pipeline_->trajectory(), map);
  MapBundle bundle = make_map_bundle(atlas, keyframes, {});
  scene.problem = std::move(bundle.problem);
  for (std::size_t i = 0; i < scene.problem.observations.size(); ++i) {
    const auto pose = static_cast<std::size_t>(scene.problem.observations[i].pose);
    const Keyframe& keyframe = atlas.keyframe(bundle.keyframes[pose]);
    const Eigen::Vector2d seen =
        keyframe.measurements[static_cast<std::size_t>(bundle.keypoints[i])].seen.cast<double>();
    scene.raw.push_back(scene.camera.has_distortion() ? scene.camera.distort(seen) : seen);
  }
  for (const KeyframeId id : bundle.keyframes) {
    const Keyframe& keyframe = atlas.keyframe(id);
    const KeptDepth& kept = depths_.at(keyframe.frame);
    scene.views.push_back(
        {keyframe.timestamp, kept.delay, kept.depth, camera_twist(scene.trajectory, keyframe.timestamp)});
  }
  return scene;
}

}  // namespace stdc
