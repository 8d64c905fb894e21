#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "atlas/atlas.hpp"
#include "atlas/atlas_snapshot.hpp"
#include "loop_closing/full_bundle.hpp"
#include "loop_closing/loop_correction.hpp"
#include "mapping/local_mapper.hpp"
#include "place_recognition/place_recogniser.hpp"
#include "slam/settings.hpp"
#include "slam/threads/worker.hpp"

namespace stdc {

/// What came of the back end's work at a frame.
struct BackEndUpdate {
  bool atlas_changed = false;  ///< a job was collected
  std::optional<MappingReport> mapping;
  std::optional<double> place_recognition_ms;
  std::optional<LoopReport> loop;
};

/// Owns the atlas and all that changes it beside the tracker: local mapping, loop closing, and the global
/// bundle adjustment that follows a loop. A state machine: it is idle, and then the tracking thread may read
/// the atlas and add keyframes, or a job has the atlas on the worker's thread. A job's result is collected at
/// the frame that was fixed when it began, so that threads never decide a result:
///
///     keyframe at k:     mapping, place recognition        collected at k + mapping_latency
///     then, if a loop:   correction                        loop_latency frames later
///     then:              global bundle adjustment on a copy, while mapping goes on, for as many frames as
///                        its size says; its solution is applied by one more job
class BackEnd {
 public:
  BackEnd(const Camera& camera, const Settings& settings);

  /// No job has the atlas.
  bool idle() const { return !job_; }
  /// A loop's correction has the atlas, for longer than any other job.
  bool is_closing_loop() const { return job_ && job_->kind == JobKind::close_loop; }
  /// A job waits for the atlas: no keyframe is to be made before it.
  bool has_pending() const { return loop_.has_value() || bundle_state_ == BundleState::solved; }
  /// A job is under way, or waits.
  bool busy() const { return !idle() || loop_ || bundle_ || next_bundle_; }

  /// The atlas and its places; only while idle.
  Atlas& atlas();
  const Atlas& atlas() const;
  const PlaceRecogniser& places() const;
  /// The atlas as it was last collected, with the keyframes inserted since; at any time.
  const AtlasSnapshot& snapshot() const { return snapshot_; }

  /// Takes the snapshot anew, for what the tracking thread has changed; only while idle.
  void refresh_snapshot() { snapshot_ = AtlasSnapshot(atlas()); }
  /// An atlas from a file, before the first frame. Its places are learnt until then.
  void set_atlas(Atlas atlas);
  /// Notes a keyframe and its landmarks, those from `first_landmark` on, that were just put into the atlas,
  /// and starts to map it.
  void map_keyframe(KeyframeId keyframe, std::size_t first_landmark, int frame);
  /// Collects what is due at a frame; waits for it if need be. `now`: whatever is under way.
  BackEndUpdate collect(int frame, bool now);
  /// Starts the job that waits, if idle.
  void start_pending(int frame);
  /// Makes the global bundle adjustment due: at the end.
  void flush() { bundle_due_ = 0; }

 private:
  enum class JobKind { learn_places, map_keyframe, close_loop, apply_bundle };
  /// What has the atlas.
  struct Job {
    JobKind kind;
    int due = 0;  ///< frame at which it is collected
  };
  /// The global bundle adjustment, which works on a copy.
  enum class BundleState {
    none,
    solving,
    obsolete,  ///< solving, or solved, but another loop has been closed since
    solved,    ///< to be applied
  };

  void start(JobKind kind, int due, std::function<void()> work);
  void finish_job(BackEndUpdate& update);
  void close_loop(int frame);
  void update_bundle(int frame);
  void start_bundle(int frame);

  SensorModel sensor_;
  Settings settings_;
  Atlas atlas_;
  AtlasSnapshot snapshot_;
  LocalMapper mapper_;
  PlaceRecogniser places_;

  std::optional<Job> job_;
  // What a job leaves behind; the worker's until it is collected.
  AtlasSnapshot changed_;
  MappingReport mapping_;
  double place_recognition_ms_ = 0;
  std::optional<VerifiedLoop> loop_;  ///< found, not closed yet
  KeyframeId last_loop_;              ///< current keyframe of the last one closed
  LoopReport loop_report_;

  std::unique_ptr<FullBundle> bundle_, next_bundle_;  ///< the present one; to be solved after it
  BundleState bundle_state_ = BundleState::none;
  int bundle_due_ = 0;

  Worker worker_, bundle_worker_;  ///< last, so that they end before what they work on
};

}  // namespace stdc
