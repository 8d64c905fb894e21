#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "atlas/atlas.hpp"
#include "core/camera.hpp"
#include "features/extractor.hpp"
#include "slam/frame_view.hpp"
#include "slam/relocaliser.hpp"
#include "slam/settings.hpp"
#include "slam/threads/back_end.hpp"
#include "slam/threads/dense_thread.hpp"
#include "slam/threads/motion_thread.hpp"
#include "slam/threads/semantic_thread.hpp"
#include "slam/tracking_result.hpp"
#include "tracking/local_map.hpp"
#include "tracking/tracker.hpp"

namespace stdc {

/// What happens to a frame, step by step. Beside it the back end works on the atlas; while it has the atlas
/// the tracker has a copy of what is around the camera.
class Pipeline {
 public:
  /// `segmenter`: null for none.
  Pipeline(const Camera& camera, const Settings& settings, std::unique_ptr<Segmenter> segmenter);

  TrackingResult track(const RgbdImage& given);
  TrackingResult skip(double timestamp);
  /// Waits for the back end and collects its results; returns the loops among them.
  std::vector<LoopReport> finish();
  /// Reads a map, before the first frame.
  void load_map(const std::filesystem::path& path);

  /// The last `count` frames.
  std::vector<FramePose> trajectory(std::size_t count = std::numeric_limits<std::size_t>::max()) const;
  const Camera& camera() const { return sensor_.camera; }
  /// As the tracking thread knows it, at any time.
  const AtlasSnapshot& snapshot() const { return back_end_.snapshot(); }
  /// After finish().
  const Atlas& atlas() const { return back_end_.atlas(); }
  KeyframeId first_own_keyframe() const { return first_own_keyframe_; }
  /// Views of the static scene, those of a loaded map included, by time; waits for the frames under way.
  DenseViews dense_views() const;
  /// Those of them that are done, without waiting; for looking at only.
  DenseViews dense_views_so_far() const { return dense_ ? dense_->views_so_far() : loaded_views_; }
  /// What was found in the last frame.
  FrameView last_frame() const;
  MapId active_map() const { return active_map_; }
  /// CPU time of the thread that makes them.
  DenseThread::Usage dense_usage() const { return dense_ ? dense_->usage() : DenseThread::Usage(); }

 private:
  struct PosedFrame {
    int frame = 0;
    double timestamp = 0;
    KeyframeId reference;
    Pose frame_from_reference;
  };

  struct SeenFrame {
    std::shared_ptr<const FrameFeatures> features;  ///< null: there was no frame
    std::vector<KeypointState> states;
  };

  RgbdImage with_lasting_depth(const RgbdImage& given) const;
  cv::Mat brightness(const RgbdImage& image) const;
  TrackedFrame extract(const RgbdImage& image, TrackingResult& result);
  void reject_dynamic(TrackingResult& result);
  void collect(TrackingResult& result);
  /// Where a tracked frame is relative to its reference keyframe.
  Pose from_reference(const TrackedFrame& frame) const {
    return frame.cam_from_world * local_map_.reference_from_world.inverse();
  }
  void judge(const TrackedFrame& frame, TrackingResult& result);
  bool is_wary() const;
  void note_gone();
  void observe_motion(const TrackedFrame& frame, const TrackingResult& result);
  void mark_dynamic(TrackedFrame& frame);
  cv::Mat dynamic_mask();
  void follow_atlas();
  TrackingStatus locate(TrackedFrame& frame, StageTimes& times);
  TrackingStatus track_from_last(TrackedFrame& frame, StageTimes& times);
  void extend_map(TrackedFrame& frame, TrackingResult& result);
  bool shows_enough(const TrackedFrame& frame) const;
  bool initialise(TrackedFrame& frame);
  bool start_over(TrackedFrame& frame);
  bool wants_keyframe(const TrackedFrame& frame) const;
  void make_keyframe(TrackedFrame& frame, MapId map);
  void refresh_local_map(const std::vector<LandmarkId>& seen);
  void record(const TrackedFrame& frame);
  void note_dense(const RgbdImage& image, const TrackedFrame& frame);
  void hand_over_dense();
  void describe(const TrackedFrame& frame, TrackingResult& result);

  SensorModel sensor_;
  Settings settings_;
  FeatureExtractor extractor_;
  std::unique_ptr<SemanticThread> semantics_;  ///< null: nothing is segmented
  std::unique_ptr<MotionThread> motion_;       ///< null: what moves is not looked for
  Tracker tracker_;
  Relocaliser relocaliser_;
  LocalMap local_map_;
  cv::Mat segmented_;    ///< the present frame's mask of the segmenter; empty: none
  cv::Mat moving_;       ///< what was expected to move in it; empty: nothing
  SeenFrame seen_;       ///< in the last frame, for drawing
  bool settled_ = true;  ///< false: most matches have contradicted the pose since the camera was found
  std::optional<double> last_mover_;      ///< [s] when something large moved that no segmenter knew
  std::optional<double> last_jerk_;       ///< [s] when a pose was no hand's motion away from the last
  double map_began_ = 0;                  ///< [s] the map that was begun last
  std::optional<double> last_cover_;      ///< [s] when most of the view moved
  bool covered_ = false;                  ///< it did so within the second before the camera was lost
  int unsupported_frames_ = 0;            ///< tracked in a row by temporary points alone
  bool extends_by_depth_ = false;         ///< a pose held by temporary points that a keyframe may be made of
  bool needs_keyframe_ = false;           ///< few landmarks are left to track, and nothing large moves
  bool landmarks_removed_ = false;        ///< since the snapshot was made
  std::map<LandmarkId, int> gone_votes_;  ///< frames that looked through a landmark
  int observed_frame_ = -1;               ///< the last one whose motion was looked for
  int next_frame_ = 0;
  std::optional<double> last_time_;
  int last_keyframe_frame_ = -1;
  KeyframeId last_keyframe_;  ///< or the one near which tracking was found again
  MapId active_map_;          ///< the map that is tracked in
  int unknown_frames_ = 0;    ///< since tracking was lost, that showed no known place
  KeyframeId first_own_keyframe_{0};
  std::vector<PosedFrame> posed_;
  BackEnd back_end_;
  DenseViews loaded_views_;             ///< of a loaded map, if nothing is added to them
  std::unique_ptr<DenseThread> dense_;  ///< null: no dense map is made
  ViewPlanner view_planner_;
  std::optional<DenseFrame> next_dense_;  ///< waits for what the motion thread finds in it
};

}  // namespace stdc
