#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "atlas/atlas_snapshot.hpp"
#include "core/camera.hpp"
#include "core/rgbd_image.hpp"
#include "dense/dense_settings.hpp"
#include "dense/fusion/pinhole.hpp"
#include "dense/fusion/placed_view.hpp"
#include "dense/mesh/triangle_mesh.hpp"
#include "segmentation/segmenter.hpp"
#include "slam/frame_view.hpp"
#include "slam/settings.hpp"
#include "slam/tracking_result.hpp"

namespace stdc {

class Pipeline;

/// RGB-D SLAM: frames in, poses out.
///
///     Slam slam(camera, settings);
///     for (...) TrackingResult result = slam.track(image);
///     slam.finish();
///     auto trajectory = slam.trajectory();
///
/// The same frames and settings give the same results, however fast the machine is, whatever else it does,
/// and whatever is asked in between.
///
/// When tracking is lost for good another map is started; when they show the same place the two become one,
/// in the coordinates of the older. A map can be saved, and loaded by a later session, which goes on with it
/// or, with `system.localisation_only`, only finds itself in it.
///
/// All calls come from one thread.
class Slam {
 public:
  /// @param segmenter  finds what moves by itself; null: nothing does. See make_segmenter.hpp.
  /// Throws Error if the camera or a setting is invalid.
  Slam(const Camera& camera, const Settings& settings, std::unique_ptr<Segmenter> segmenter = nullptr);
  ~Slam();
  Slam(const Slam&) = delete;
  Slam& operator=(const Slam&) = delete;

  /// Reads a map, before the first frame. Throws Error if the file is none, or made with another camera.
  void load_map(const std::filesystem::path& path);
  /// Finishes, then writes the map, whole or not at all. track() may go on afterwards. Throws Error if it
  /// cannot be written.
  void save_map(const std::filesystem::path& path);

  /// Processes the next frame. Faults in the frame (black, no depth, blurred, a time that is not later than
  /// the last) end in a status, never in an exception. Throws Error only for what no camera gives: a wrong
  /// image size or type, or a time that is no number.
  TrackingResult track(const RgbdImage& image);
  /// Counts a frame that could not be read: its status is `skipped`.
  TrackingResult skip(double timestamp);
  /// Waits for the workers and collects what they still have. track() may go on afterwards.
  /// @returns the loops among that
  std::vector<LoopReport> finish();

  // The state as the tracking thread knows it: what was last collected from the workers, and the keyframes
  // made since. Cheap, at any time, and without any effect on the results. After finish(): the final state.

  /// Poses of all tracked frames in order of time, each relative to its reference keyframe as now optimised.
  /// With `system.localisation_only` there are none: those of the results are final, and a session may be
  /// long.
  std::vector<FramePose> trajectory() const;
  /// The last `count` of these, without going through all: where the latest frames are in the map as it is
  /// now.
  std::vector<FramePose> latest_poses(int count) const;
  /// trajectory() of the keyframes that this session has made.
  std::vector<FramePose> keyframe_trajectory() const;
  /// Maps that were not joined to others.
  int maps() const;
  int keyframes() const;
  int landmarks() const;
  /// Positions of the landmarks of a map [m, its world]; for drawing.
  std::vector<Eigen::Vector3d> landmark_positions(MapId map = {0}) const;

  // For a live view. As cheap and as harmless as what is above.

  /// The map that is tracked in; invalid: none yet.
  MapId active_map() const;
  /// Keyframes, edges between them and landmarks of all maps: a copy for another thread to look at.
  AtlasSnapshot snapshot() const;
  /// What was found in the last frame, and what kept keypoints out of it.
  FrameView last_frame() const;
  /// What a mesh is made of, for another thread to make it: the views that are done by now, without waiting
  /// for others. Which ones those are depends on how fast the machine is.
  struct DenseSoFar {
    std::vector<PlacedView> views;
    Pinhole pinhole;
    DenseSettings settings;
    bool empty() const { return views.empty(); }
    /// @param threads  0: one for each core
    TriangleMesh mesh(double voxel, int threads) const;
  };
  DenseSoFar dense_so_far() const;

  // The dense map, with `dense.active` or a loaded map that carries one. These wait for the frames that are
  // being fused; results do not change.

  /// Views of the static scene that belong to a map, where the map now has them: see dense/. By time.
  std::vector<PlacedView> dense_views(MapId map = {0}) const;
  /// The surface that they show, in the map's world; made anew each time, which takes about 20 ms of CPU time
  /// a view at 1 cm, then simplified as `dense.mesh_tolerance` and `dense.mesh_triangles` say. Empty if there
  /// is none.
  /// @param voxel  [m]; 0: `dense.voxel`
  TriangleMesh mesh(MapId map = {0}, double voxel = 0) const;
  /// CPU milliseconds that fusing frames has taken beside the tracker, and their number.
  struct DenseUsage {
    double cpu_ms = 0;
    int frames = 0;
  };
  DenseUsage dense_usage() const;

 private:
  DenseSettings dense_;
  std::unique_ptr<Pipeline> pipeline_;
};

}  // namespace stdc
