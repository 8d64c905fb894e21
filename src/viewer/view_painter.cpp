#include "viewer/view_painter.hpp"

#include <utility>

#include "core/give_way.hpp"

namespace stdc {

ViewPainter::ViewPainter(ViewSubject subject, ViewBoard& board, KeyframeImages& keyframes)
    : subject_(std::move(subject)), board_(board), keyframes_(keyframes), thread_([this] { run(); }) {}

ViewPainter::~ViewPainter() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void ViewPainter::touch(bool urgent) {
  inbox_.state = true;
  inbox_.urgent = inbox_.urgent || urgent;
}

void ViewPainter::add(const TrackingResult& result) {
  {
    const std::lock_guard lock(mutex_);
    inbox_.records.push_back(make_frame_record(result));
    events_.add(result);
    touch(false);
  }
  changed_.notify_all();
}

void ViewPainter::add(const LoopReport& loop) {
  const std::lock_guard lock(mutex_);
  events_.add(loop);
  touch(false);
}

bool ViewPainter::free_for_image() const {
  const std::lock_guard lock(mutex_);
  return !inbox_.image && !busy_;
}

bool ViewPainter::free_for_map() const {
  const std::lock_guard lock(mutex_);
  return !inbox_.map && !busy_;
}

void ViewPainter::give(ViewImage image, std::uint32_t wanted) {
  const std::lock_guard lock(mutex_);
  inbox_.image = std::move(image);
  inbox_.wanted = wanted;
  changed_.notify_all();
}

void ViewPainter::give(ViewMap map) {
  const std::lock_guard lock(mutex_);
  state_.maps = map.snapshot.map_count();
  state_.keyframes = map.snapshot.keyframe_count();
  state_.landmarks = map.snapshot.landmark_count();
  inbox_.map = std::move(map);
  touch(false);
  changed_.notify_all();
}

void ViewPainter::give_keyframe(int frame, ViewColour colour) {
  constexpr std::size_t kMaxWaiting = 8;
  const std::lock_guard lock(mutex_);
  if (inbox_.keyframes.size() == kMaxWaiting) inbox_.keyframes.pop_front();
  inbox_.keyframes.emplace_back(frame, std::move(colour));
  changed_.notify_all();
}

void ViewPainter::set_truth(Trajectory truth) {
  const std::lock_guard lock(mutex_);
  inbox_.truth = std::move(truth);
  state_.has_truth = true;
  changed_.notify_all();
}

void ViewPainter::set_paused(bool paused) {
  const std::lock_guard lock(mutex_);
  if (state_.paused == paused) return;
  state_.paused = paused;
  touch(true);
  changed_.notify_all();
}

void ViewPainter::finish() {
  const std::lock_guard lock(mutex_);
  state_.finished = true;
  state_.paused = false;
  touch(true);
  changed_.notify_all();
}

void ViewPainter::set_mesh(std::size_t triangles, double voxel) {
  const std::lock_guard lock(mutex_);
  state_.mesh_triangles = triangles;
  state_.mesh_voxel = voxel;
  touch(false);
  changed_.notify_all();
}

void ViewPainter::drain(std::chrono::milliseconds max) {
  std::unique_lock lock(mutex_);
  inbox_.urgent = true;
  changed_.notify_all();
  changed_.wait_for(lock, max, [this] { return inbox_.empty() && !busy_; });
}

void ViewPainter::run() {
  constexpr auto kStateInterval = std::chrono::milliseconds(200);
  give_way();
  auto last_state = std::chrono::steady_clock::now() - kStateInterval;
  std::unique_lock lock(mutex_);
  while (!stop_) {
    const auto state_due = [&] {
      return inbox_.state &&
             (inbox_.urgent || std::chrono::steady_clock::now() - last_state >= kStateInterval);
    };
    const auto has_work = [&] {
      return stop_ || !inbox_.records.empty() || inbox_.image || inbox_.map || inbox_.truth ||
             !inbox_.keyframes.empty() || state_due();
    };
    if (inbox_.state) {
      changed_.wait_for(lock, kStateInterval, has_work);
    } else {
      changed_.wait(lock, has_work);
    }
    if (stop_) return;
    const bool post = state_due();
    Inbox inbox = std::exchange(inbox_, Inbox());
    inbox_.state = inbox.state && !post;
    inbox_.urgent = false;
    busy_ = true;
    lock.unlock();
    paint(inbox);
    if (post) {
      last_state = std::chrono::steady_clock::now();
      post_state();
    }
    lock.lock();
    busy_ = false;
    changed_.notify_all();
  }
}

void ViewPainter::paint(Inbox& inbox) {
  for (const FrameRecord& record : inbox.records) board_.add(record);
  if (inbox.truth) truth_.emplace(*std::move(inbox.truth));
  if (inbox.image) board_.post(ViewTopic::image, encode_image(*inbox.image, inbox.wanted));
  for (const auto& [frame, colour] : inbox.keyframes) keyframes_.add(frame, colour.image());
  if (inbox.map) paint_map(*inbox.map);
}

void ViewPainter::paint_map(ViewMap& map) {
  if (truth_) {
    Trajectory estimate;
    for (const FramePose& pose : map.trajectory) {
      if (pose.map == map.map) estimate.push_back({pose.timestamp, pose.world_from_cam});
    }
    AlignedTruth::Fit fit = truth_->fit(estimate);
    map.truth = std::move(fit.positions);
    const std::lock_guard lock(mutex_);
    state_.ate = fit.ate;
    touch(false);
  }
  board_.post(ViewTopic::map, encode_map(map));
}

void ViewPainter::post_state() {
  ViewState state;
  {
    const std::lock_guard lock(mutex_);
    state = state_;
    state.events = events_.latest();
    state.loops = events_.loops();
  }
  board_.post(ViewTopic::state, encode_state(subject_, state));
}

}  // namespace stdc
