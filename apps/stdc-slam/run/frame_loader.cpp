#include "run/frame_loader.hpp"

#include <algorithm>
#include <utility>

namespace stdc::app {

FrameLoader::FrameLoader(std::span<const SequenceFrame> frames, const Camera& camera, ColourMode mode,
                         int ahead)
    : frames_(frames),
      camera_(camera),
      mode_(mode),
      ahead_(static_cast<std::size_t>(std::max(1, ahead))),
      thread_([this] { work(); }) {}

FrameLoader::~FrameLoader() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

std::optional<LoadedFrame> FrameLoader::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !ready_.empty() || done_; });
  if (ready_.empty()) return std::nullopt;
  LoadedFrame frame = std::move(ready_.front());
  ready_.pop_front();
  lock.unlock();
  changed_.notify_all();
  return frame;
}

void FrameLoader::work() {
  for (int index = 0; index < static_cast<int>(frames_.size()); ++index) {
    LoadedFrame frame = load(index);
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return ready_.size() < ahead_ || stop_; });
    if (stop_) return;
    ready_.push_back(std::move(frame));
    lock.unlock();
    changed_.notify_all();
  }
  const std::lock_guard lock(mutex_);
  done_ = true;
  changed_.notify_all();
}

LoadedFrame FrameLoader::load(int index) const {
  const SequenceFrame& source = frames_[static_cast<std::size_t>(index)];
  LoadedFrame frame;
  frame.index = index;
  frame.timestamp = source.timestamp;
  try {
    frame.image = load_frame(source, camera_, mode_);
  } catch (const Error& error) {
    frame.error = error;
  } catch (const std::exception& error) {  // no memory, say: it must not end the program from a thread
    frame.error = Error(source.colour.string(), error.what(), "free memory and try again");
  }
  return frame;
}

}  // namespace stdc::app
