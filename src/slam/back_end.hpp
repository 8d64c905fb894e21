#pragma once

#include <memory>
#include <optional>

#include "atlas/atlas.hpp"
#include "core/camera.hpp"
#include "loop_closing/full_bundle.hpp"
#include "loop_closing/loop_closer.hpp"
#include "mapping/local_mapper.hpp"
#include "slam/settings.hpp"
#include "slam/slam.hpp"
#include "slam/worker.hpp"

namespace stdc {

/// What came of the back end's work at a frame.
struct BackEndUpdate {
  bool map_is_back = false;  ///< and has changed
  std::optional<MappingReport> mapping;
  std::optional<LoopReport> loop;
};

/// Owns the map and all that changes it beside the tracker: local mapping, loop closing, and the full bundle
/// adjustment that follows a loop. The map is either at home, for the tracking thread to read and to add
/// keyframes to, or away, with a job on the worker's thread. A job's result is taken in at a frame that was
/// fixed when it began, so that threads never decide a result:
///
///     keyframe at k:     mapping, place recognition        taken in at k + mapping_latency
///     then, if a loop:   correction                        loop_latency frames later
///     then:              full bundle adjustment on a copy, while mapping goes on, for a number of frames
///     that
///                        its size decides; its result is worked in as one more job
class BackEnd {
 public:
  BackEnd(const Camera& camera, const Settings& settings);

  /// The map and its places; only while they are at home.
  Atlas& atlas() { return atlas_; }
  const Atlas& atlas() const { return atlas_; }
  const LoopCloser& places() const { return closer_; }
  bool at_home() const { return job_ == Job::none; }
  /// Whether a job waits for the map to come home: then no keyframe is to be made.
  bool job_waits() const { return loop_.has_value() || (bundle_ && bundle_solved_); }

  /// A map from a file, before the first frame. Its places are learnt until then.
  void adopt(Atlas atlas);
  /// Gives the map away to have a keyframe worked into it.
  void map_keyframe(KeyframeId keyframe, int frame);
  /// Takes in what is due at a frame; waits for it if need be. `at_once`: whatever is on its way.
  BackEndUpdate take_in(int frame, bool at_once);
  /// Starts the job that waits, if the map is at home.
  void go_on(int frame);
  /// Whether anything is under way, or waits.
  bool busy() const { return !at_home() || loop_ || bundle_ || next_bundle_; }
  /// Takes in the full bundle adjustment before it is due: at the end.
  void hurry() { bundle_due_ = 0; }

 private:
  enum class Job { none, places, keyframe, loop, bundle };

  void start(Job job, int due, std::function<void()> work);
  void close_loop(int frame);
  void take_in_bundle(int frame);
  void collect(BackEndUpdate& news);

  Camera camera_;
  Settings settings_;
  Atlas atlas_;
  LocalMapper mapper_;
  LoopCloser closer_;

  Job job_ = Job::none;
  int due_ = 0;
  MappingOutcome mapped_;
  double detection_ms_ = 0, correction_ms_ = 0;
  std::optional<VerifiedLoop> loop_;
  LoopReport report_;

  std::unique_ptr<FullBundle> bundle_, next_bundle_;  ///< being solved; to be solved after it
  bool bundle_solved_ = false, bundle_void_ = false;  ///< void: another loop was closed since
  int bundle_due_ = 0;

  Worker worker_, bundle_worker_;  ///< last, so that they end before what they work on
};

}  // namespace stdc
