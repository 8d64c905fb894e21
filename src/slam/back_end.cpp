#include "slam/back_end.hpp"

#include <utility>

#include "core/stopwatch.hpp"

namespace stdc {

BackEnd::BackEnd(const Camera& camera, const Settings& settings)
    : camera_(camera),
      settings_(settings),
      mapper_(camera, settings.mapping, settings.noise, settings.bundle_adjustment,
              settings.tracking.close_depth),
      closer_(
          {camera, settings.noise, settings.bundle_adjustment, settings.pose_graph, settings.loop_closing},
          settings.pose_optimisation) {}

void BackEnd::adopt(Atlas atlas) {
  atlas_ = std::move(atlas);
  start(Job::places, 0, [this] { closer_.enter_all(atlas_); });
}

void BackEnd::start(Job job, int due, std::function<void()> work) {
  job_ = job;
  due_ = due;
  worker_.start(std::move(work));
}

void BackEnd::map_keyframe(KeyframeId keyframe, int frame) {
  start(Job::keyframe, frame + settings_.system.mapping_latency, [this, keyframe] {
    mapped_ = mapper_.process(atlas_, keyframe);
    Stopwatch watch;
    loop_ = closer_.find(atlas_, keyframe);
    detection_ms_ = watch.lap_ms();
  });
}

void BackEnd::close_loop(int frame) {
  if (bundle_) bundle_void_ = true;
  next_bundle_.reset();
  start(Job::loop, frame + settings_.system.loop_latency, [this, loop = *std::exchange(loop_, std::nullopt)] {
    Stopwatch watch;
    const LoopCorrection done = closer_.close(atlas_, loop);
    const Keyframe& current = atlas_.keyframe(loop.current);
    report_ = {done.merged,
               current.frame,
               atlas_.keyframe(loop.matched).frame,
               done.keyframes,
               done.fused,
               done.drift,
               detection_ms_,
               0};
    next_bundle_ = std::make_unique<FullBundle>(atlas_, current.map);
    report_.correction_ms = watch.lap_ms();
  });
}

void BackEnd::collect(BackEndUpdate& news) {
  news.map_is_back = true;
  const Job done = std::exchange(job_, Job::none);
  if (done == Job::keyframe) {
    news.mapping = MappingReport{mapped_.total_ms,
                                 mapped_.bundle_ms,
                                 mapped_.bundle.keyframes + mapped_.bundle.fixed_keyframes,
                                 mapped_.bundle.landmarks,
                                 mapped_.bundle.observations,
                                 detection_ms_};
  }
  if (done == Job::loop) news.loop = report_;
  if (done == Job::bundle) bundle_.reset();
}

/// The solution waits for the map, unless another loop has made it worthless.
void BackEnd::take_in_bundle(int frame) {
  if (!bundle_) return;
  if (!bundle_solved_ && frame >= bundle_due_) {
    bundle_worker_.wait();
    bundle_solved_ = true;
  }
  if (bundle_solved_ && bundle_void_) bundle_.reset();
}

BackEndUpdate BackEnd::take_in(int frame, bool at_once) {
  BackEndUpdate news;
  if (job_ != Job::bundle) take_in_bundle(frame);
  if (job_ == Job::none || (frame < due_ && !at_once)) return news;
  worker_.wait();
  collect(news);
  return news;
}

void BackEnd::go_on(int frame) {
  if (job_ != Job::none) return;
  if (loop_) {
    close_loop(frame);
    return;
  }
  if (bundle_ && bundle_solved_) {
    start(Job::bundle, frame + settings_.system.mapping_latency, [this] { bundle_->apply(atlas_); });
    return;
  }
  if (bundle_ || !next_bundle_) return;
  // As long as it takes on a slow machine, in frames: it must not depend on how long it takes on this one.
  constexpr int kMin = 15, kKeyframesPerFrame = 4, kObservationsPerFrame = 4000;
  bundle_ = std::move(next_bundle_);
  bundle_solved_ = bundle_void_ = false;
  bundle_due_ = frame + kMin + bundle_->keyframes() / kKeyframesPerFrame +
                bundle_->observations() / kObservationsPerFrame;
  bundle_worker_.start(
      [this] { bundle_->solve(camera_, settings_.noise, settings_.full_bundle_adjustment); });
}

}  // namespace stdc
