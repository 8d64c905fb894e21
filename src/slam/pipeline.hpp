#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/camera.hpp"
#include "features/extractor.hpp"
#include "map/map.hpp"
#include "mapping/local_mapper.hpp"
#include "slam/semantic_thread.hpp"
#include "slam/settings.hpp"
#include "slam/slam.hpp"
#include "slam/worker.hpp"
#include "tracking/local_map.hpp"
#include "tracking/tracker.hpp"

namespace stdc {

/// The way of a frame through the system, and the logical time by which the mapper's work becomes visible:
/// the keyframe made at frame k is mapped beside the tracker, which works on a copy of the local map and
/// takes the result in at frame k + mapping_latency. So the map always belongs to one of the two, and threads
/// never decide a result.
class Pipeline {
 public:
  /// `segmenter`: null for none.
  Pipeline(const Camera& camera, const Settings& settings, std::unique_ptr<Segmenter> segmenter);

  TrackingResult track(const RgbdImage& image);
  TrackingResult skip(double timestamp);
  /// Waits for the mapper and takes its result in.
  void finish();
  std::vector<FramePose> trajectory() const;
  const Map& map() const { return map_; }

 private:
  struct PosedFrame {
    int frame = 0;
    double timestamp = 0;
    KeyframeId reference;
    Pose frame_from_reference;
  };
  struct MappingInFlight {
    int due = 0;  ///< frame at which it is taken in
    MappingOutcome outcome;
  };

  TrackedFrame extract(const RgbdImage& image, TrackingResult& result);
  void reject_dynamic(TrackingResult& result);
  void take_in(TrackingResult& result);
  TrackingStatus locate(TrackedFrame& frame);
  bool initialise(TrackedFrame& frame);
  bool relocalise(TrackedFrame& frame);
  bool wants_keyframe(const TrackedFrame& frame) const;
  void make_keyframe(TrackedFrame& frame);
  void refresh_local_map(const std::vector<LandmarkId>& seen);
  void record(const TrackedFrame& frame);
  void describe_keypoints(const TrackedFrame& frame, TrackingResult& result) const;
  void check(const RgbdImage& image) const;
  void check_time(double timestamp) const;

  Camera camera_;
  Settings settings_;
  FeatureExtractor extractor_;
  std::unique_ptr<SemanticThread> semantics_;  ///< null: everything counts as static
  Tracker tracker_;
  LocalMapper mapper_;
  Map map_;
  LocalMap local_map_;
  int next_frame_ = 0;
  std::optional<double> last_time_;
  int last_keyframe_frame_ = 0;
  KeyframeId last_keyframe_;
  std::vector<PosedFrame> posed_;
  std::optional<MappingInFlight> in_flight_;
  Worker worker_;  ///< last, so that it ends before what it works on
};

}  // namespace stdc
