#include "slam/slam.hpp"

#include <utility>

#include "atlas/map_bundle.hpp"
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

struct Slam::Implementation {
  Implementation(const Camera& camera, const Settings& settings, std::unique_ptr<Segmenter> segmenter)
      : pipeline(valid(camera), valid(settings), std::move(segmenter)) {}
  Pipeline pipeline;
};

Slam::Slam(const Camera& camera, const Settings& settings, std::unique_ptr<Segmenter> segmenter)
    : implementation_(std::make_unique<Implementation>(camera, settings, std::move(segmenter))) {}

Slam::~Slam() = default;

TrackingResult Slam::track(const RgbdImage& image) { return implementation_->pipeline.track(image); }
TrackingResult Slam::skip(double timestamp) { return implementation_->pipeline.skip(timestamp); }
std::vector<LoopReport> Slam::finish() { return implementation_->pipeline.finish(); }
void Slam::load_map(const std::filesystem::path& path) { implementation_->pipeline.load_map(path); }
void Slam::save_map(const std::filesystem::path& path) {
  implementation_->pipeline.finish();
  if (implementation_->pipeline.atlas().keyframe_count() == 0) {
    throw Error(path.string(), "is not written, the map is empty", "check that frames got a pose");
  }
  stdc::save_map(path, implementation_->pipeline.camera(), implementation_->pipeline.atlas());
}

std::vector<FramePose> Slam::trajectory() const {
  implementation_->pipeline.finish();
  return implementation_->pipeline.trajectory();
}

std::vector<FramePose> Slam::keyframe_trajectory() const {
  implementation_->pipeline.finish();
  const Atlas& atlas = implementation_->pipeline.atlas();
  std::vector<FramePose> poses;
  for (const KeyframeId id : atlas.keyframe_ids()) {
    if (id < implementation_->pipeline.first_own_keyframe()) continue;
    const Keyframe& keyframe = atlas.keyframe(id);
    poses.push_back({keyframe.frame, keyframe.timestamp, keyframe.cam_from_world.inverse(), keyframe.map});
  }
  return poses;
}

int Slam::maps() const {
  implementation_->pipeline.finish();
  const Atlas& atlas = implementation_->pipeline.atlas();
  int maps = 0;
  for (int number = 0; number < atlas.map_count(); ++number) maps += atlas.root(number).valid() ? 1 : 0;
  return maps;
}

int Slam::keyframes() const {
  implementation_->pipeline.finish();
  return implementation_->pipeline.atlas().keyframe_count();
}

int Slam::landmarks() const {
  implementation_->pipeline.finish();
  return implementation_->pipeline.atlas().landmark_count();
}

std::vector<Eigen::Vector3d> Slam::landmark_positions(int map_number) const {
  implementation_->pipeline.finish();
  const Atlas& atlas = implementation_->pipeline.atlas();
  std::vector<Eigen::Vector3d> positions;
  if (map_number >= atlas.map_count()) return positions;
  for (const LandmarkId id : landmarks_of(atlas, atlas.keyframe_ids(map_number)))
    positions.push_back(atlas.landmark(id).position);
  return positions;
}

}  // namespace stdc
