#include "slam/slam.hpp"

#include <utility>

#include "atlas/map_file.hpp"
#include "core/error.hpp"
#include "slam/pipeline.hpp"

namespace stdc {
namespace {

Camera valid(const Camera& camera) {
  camera.validate("camera");
  return camera;
}

Settings valid(const Settings& settings) {
  settings.validate();
  return settings;
}

}  // namespace

Slam::Slam(const Camera& camera, const Settings& settings, std::unique_ptr<Segmenter> segmenter)
    : pipeline_(std::make_unique<Pipeline>(valid(camera), valid(settings), std::move(segmenter))) {}

Slam::~Slam() = default;

TrackingResult Slam::track(const RgbdImage& image) { return pipeline_->track(image); }
TrackingResult Slam::skip(double timestamp) { return pipeline_->skip(timestamp); }
std::vector<LoopReport> Slam::finish() { return pipeline_->finish(); }
void Slam::load_map(const std::filesystem::path& path) { pipeline_->load_map(path); }
void Slam::save_map(const std::filesystem::path& path) {
  pipeline_->finish();
  if (pipeline_->snapshot().keyframe_count() == 0) {
    throw Error(path.string(), "the map is empty, so it was not written",
                "give frames that show enough with depth; a file that was there is left as it is");
  }
  stdc::save_map(path, pipeline_->camera(), pipeline_->atlas());
}

std::vector<FramePose> Slam::trajectory() const { return pipeline_->trajectory(); }

std::vector<FramePose> Slam::keyframe_trajectory() const {
  const AtlasSnapshot& snapshot = pipeline_->snapshot();
  std::vector<FramePose> poses;
  for (KeyframeId id = pipeline_->first_own_keyframe(); id.value < snapshot.keyframes().size(); ++id.value) {
    if (!snapshot.is_kept(id)) continue;
    const AtlasSnapshot::KeyframeState& keyframe = snapshot.keyframes()[id.value];
    poses.push_back({keyframe.frame, keyframe.timestamp, keyframe.cam_from_world.inverse(), keyframe.map});
  }
  return poses;
}

int Slam::maps() const { return pipeline_->snapshot().map_count(); }
int Slam::keyframes() const { return pipeline_->snapshot().keyframe_count(); }
int Slam::landmarks() const { return pipeline_->snapshot().landmark_count(); }
std::vector<Eigen::Vector3d> Slam::landmark_positions(MapId map) const {
  return pipeline_->snapshot().landmark_positions(map);
}

}  // namespace stdc
