#include "slam/slam.hpp"

#include <algorithm>
#include <utility>

#include "atlas/storage/map_file.hpp"
#include "core/error.hpp"
#include "dense/fusion/rectifier.hpp"
#include "dense/mesh/make_mesh.hpp"
#include "dense/mesh/simplify_mesh.hpp"
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
    : dense_(settings.dense),
      pipeline_(std::make_unique<Pipeline>(valid(camera), valid(settings), std::move(segmenter))) {}

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
  stdc::save_map(path, pipeline_->camera(), pipeline_->atlas(), pipeline_->dense_views());
}

std::vector<FramePose> Slam::trajectory() const { return pipeline_->trajectory(); }
std::vector<FramePose> Slam::latest_poses(int count) const {
  return pipeline_->trajectory(static_cast<std::size_t>(std::max(0, count)));
}

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

MapId Slam::active_map() const { return pipeline_->active_map(); }
AtlasSnapshot Slam::snapshot() const { return pipeline_->snapshot(); }
FrameView Slam::last_frame() const { return pipeline_->last_frame(); }

Slam::DenseSoFar Slam::dense_so_far() const {
  return {place_views(pipeline_->dense_views_so_far(), pipeline_->snapshot(), pipeline_->active_map()),
          pinhole_of(pipeline_->camera()), dense_};
}

TriangleMesh Slam::DenseSoFar::mesh(double voxel, int threads) const {
  DenseSettings chosen = settings;
  chosen.voxel = voxel;
  return make_mesh(views, pinhole, chosen, threads);
}

std::vector<PlacedView> Slam::dense_views(MapId map) const {
  return place_views(pipeline_->dense_views(), pipeline_->snapshot(), map);
}

TriangleMesh Slam::mesh(MapId map, double voxel) const {
  DenseSettings settings = dense_;
  if (voxel > 0) settings.voxel = voxel;
  TriangleMesh mesh = make_mesh(dense_views(map), pinhole_of(pipeline_->camera()), settings);
  simplify_mesh(mesh, simplification_of(settings));
  return mesh;
}

Slam::DenseUsage Slam::dense_usage() const {
  const DenseThread::Usage usage = pipeline_->dense_usage();
  return {usage.cpu_ms, usage.frames};
}

}  // namespace stdc
