#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "atlas/atlas.hpp"
#include "core/camera.hpp"
#include "features/extractor.hpp"
#include "slam/back_end.hpp"
#include "slam/relocaliser.hpp"
#include "slam/semantic_thread.hpp"
#include "slam/settings.hpp"
#include "slam/slam.hpp"
#include "tracking/local_map.hpp"
#include "tracking/tracker.hpp"

namespace stdc {

/// The way of a frame through the system. Beside it the back end works on the map; while the map is away the
/// tracker has a copy of what is around the camera.
class Pipeline {
 public:
  /// `segmenter`: null for none.
  Pipeline(const Camera& camera, const Settings& settings, std::unique_ptr<Segmenter> segmenter);

  TrackingResult track(const RgbdImage& image);
  TrackingResult skip(double timestamp);
  /// Waits for the back end and takes its results in; returns the loops among them.
  std::vector<LoopReport> finish();
  /// Reads a map, before the first frame.
  void load_map(const std::filesystem::path& path);

  std::vector<FramePose> trajectory() const;
  const Camera& camera() const { return camera_; }
  /// After finish().
  const Atlas& atlas() const { return back_end_.atlas(); }
  KeyframeId first_own_keyframe() const { return first_own_keyframe_; }

 private:
  struct PosedFrame {
    int frame = 0;
    double timestamp = 0;
    KeyframeId reference;
    Pose frame_from_reference;
  };

  TrackedFrame extract(const RgbdImage& image, TrackingResult& result);
  void reject_dynamic(TrackingResult& result);
  void take_in(TrackingResult& result);
  void follow_map();
  TrackingStatus locate(TrackedFrame& frame);
  bool shows_enough(const TrackedFrame& frame) const;
  bool initialise(TrackedFrame& frame);
  bool start_over(TrackedFrame& frame);
  bool wants_keyframe(const TrackedFrame& frame) const;
  void make_keyframe(TrackedFrame& frame, int map_number);
  void refresh_local_map(const std::vector<LandmarkId>& seen);
  void record(const TrackedFrame& frame);
  void describe_keypoints(const TrackedFrame& frame, TrackingResult& result) const;

  Camera camera_;
  Settings settings_;
  FeatureExtractor extractor_;
  std::unique_ptr<SemanticThread> semantics_;  ///< null: everything counts as static
  Tracker tracker_;
  Relocaliser relocaliser_;
  LocalMap local_map_;
  int next_frame_ = 0;
  std::optional<double> last_time_;
  int last_keyframe_frame_ = -1;
  KeyframeId last_keyframe_;  ///< or the one near which tracking was found again
  int active_map_ = -1;       ///< number of the map that is tracked in
  int unknown_frames_ = 0;    ///< since tracking was lost, that showed no known place
  KeyframeId first_own_keyframe_{0};
  std::vector<PosedFrame> posed_;
  BackEnd back_end_;
};

}  // namespace stdc
