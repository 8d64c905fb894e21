#include "slam/threads/back_end.hpp"

#include <cassert>
#include <utility>

#include "core/stopwatch.hpp"

namespace stdc {

BackEnd::BackEnd(const Camera& camera, const Settings& settings)
    : sensor_{camera, settings.noise},
      settings_(settings),
      mapper_(sensor_, settings.mapping, settings.bundle_adjustment, settings.tracking.close_depth),
      places_({sensor_, settings.pose_optimisation}, settings.place_recognition) {}

Atlas& BackEnd::atlas() {
  assert(idle());
  return atlas_;
}

const Atlas& BackEnd::atlas() const {
  assert(idle());
  return atlas_;
}

const PlaceRecogniser& BackEnd::places() const {
  assert(idle());
  return places_;
}

void BackEnd::set_atlas(Atlas atlas) {
  assert(idle() && atlas_.keyframe_id_limit() == 0);
  atlas_ = std::move(atlas);
  snapshot_ = AtlasSnapshot(atlas_);
  start(JobKind::learn_places, 0, [this] { places_.add_all(atlas_); });
}

/// The snapshot is made on the worker's thread, where it costs the tracker nothing. Learning places changes
/// nothing that it shows.
void BackEnd::start(JobKind kind, int due, std::function<void()> work) {
  assert(idle());
  job_ = Job{kind, due};
  worker_.start([this, kind, work = std::move(work)] {
    work();
    if (kind != JobKind::learn_places) changed_ = AtlasSnapshot(atlas_);
  });
}

void BackEnd::map_keyframe(KeyframeId keyframe, std::size_t first_landmark, int frame) {
  assert(!has_pending());
  snapshot_.add(atlas_, keyframe, first_landmark);
  start(JobKind::map_keyframe, frame + settings_.system.mapping_latency, [this, keyframe] {
    mapping_ = mapper_.process(atlas_, keyframe);
    Stopwatch watch;
    if (settings_.loop_closing.active) {
      const bool soon = last_loop_.valid() && static_cast<int>(keyframe.value - last_loop_.value) <
                                                  settings_.loop_closing.keyframes_between;
      loop_ = places_.find_loop(atlas_, keyframe, !soon);
    }
    places_.add(atlas_, keyframe);
    place_recognition_ms_ = watch.lap_ms();
  });
}

void BackEnd::close_loop(int frame) {
  // What is known of the bundle's map will not hold any more.
  if (bundle_state_ != BundleState::none) bundle_state_ = BundleState::obsolete;
  next_bundle_.reset();
  last_loop_ = loop_->current;
  const auto due = frame + settings_.system.loop_latency;
  start(JobKind::close_loop, due, [this, loop = *std::exchange(loop_, std::nullopt)] {
    Stopwatch watch;
    places_.reset_detection();
    loop_report_ = stdc::close_loop(
        {sensor_, settings_.bundle_adjustment, settings_.pose_graph, settings_.loop_closing}, atlas_, loop);
    loop_report_.detection_ms = place_recognition_ms_;
    next_bundle_ = std::make_unique<FullBundle>(atlas_, atlas_.keyframe(loop.current).map);
    loop_report_.correction_ms = watch.lap_ms();
  });
}

/// Lets the solution wait for the atlas, unless another loop has made it worthless.
void BackEnd::update_bundle(int frame) {
  const bool at_work = bundle_state_ == BundleState::solving || bundle_state_ == BundleState::obsolete;
  if (!at_work || frame < bundle_due_) return;
  bundle_worker_.wait();
  if (bundle_state_ == BundleState::solving) {
    bundle_state_ = BundleState::solved;
  } else {
    bundle_.reset();
    bundle_state_ = BundleState::none;
  }
}

void BackEnd::start_bundle(int frame) {
  assert(!bundle_ && bundle_state_ == BundleState::none);
  // As long as it takes on a slow machine, in frames: it must not depend on how long it takes on this one.
  constexpr int kMinFrames = 15, kKeyframesPerFrame = 4, kObservationsPerFrame = 4000;
  bundle_ = std::move(next_bundle_);
  bundle_state_ = BundleState::solving;
  bundle_due_ = frame + kMinFrames + bundle_->keyframes() / kKeyframesPerFrame +
                bundle_->observations() / kObservationsPerFrame;
  bundle_worker_.start([this] { bundle_->solve(sensor_, settings_.full_bundle_adjustment); });
}

void BackEnd::finish_job(BackEndUpdate& update) {
  worker_.wait();
  const JobKind done = job_->kind;
  job_.reset();
  if (done != JobKind::learn_places) snapshot_ = std::move(changed_);
  update.atlas_changed = true;
  if (done == JobKind::map_keyframe) {
    update.mapping = mapping_;
    update.place_recognition_ms = place_recognition_ms_;
  }
  if (done == JobKind::close_loop) update.loop = loop_report_;
  if (done == JobKind::apply_bundle) {
    bundle_.reset();
    bundle_state_ = BundleState::none;
  }
}

BackEndUpdate BackEnd::collect(int frame, bool now) {
  BackEndUpdate update;
  // While its solution is being applied the bundle belongs to the job.
  if (idle() || job_->kind != JobKind::apply_bundle) update_bundle(frame);
  if (!idle() && (frame >= job_->due || now)) finish_job(update);
  return update;
}

void BackEnd::start_pending(int frame) {
  if (!idle()) return;
  if (loop_) {
    close_loop(frame);
  } else if (bundle_state_ == BundleState::solved) {
    start(JobKind::apply_bundle, frame + settings_.system.mapping_latency,
          [this] { bundle_->apply(atlas_); });
  } else if (!bundle_ && next_bundle_) {
    start_bundle(frame);
  }
}

}  // namespace stdc
