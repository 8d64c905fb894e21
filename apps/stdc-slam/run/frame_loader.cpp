#include "run/frame_loader.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace stdc::app {

FrameLoader::FrameLoader(const SequenceInput& input, ColourMode mode, int ahead)
    : source_(input.start()),
      decoder_(input.cameras),
      mode_(mode),
      ahead_(source_.is_live() ? 1 : static_cast<std::size_t>(std::max(1, ahead))),
      skip_(input.first_frame()),
      count_(input.frame_count()),
      thread_([this] { work(); }) {}

FrameLoader::~FrameLoader() {
  source_.stop();  // a live one: the thread may be waiting for its next frame
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

bool FrameLoader::wait(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, patience, [this] { return !ready_.empty() || done_; });
}

void FrameLoader::work() {
  LoadedFrame fault;
  try {
    while (const auto frame = step()) {
      if (!give(load(*frame))) return;
      ++index_;
    }
  } catch (const Error& error) {
    fault.error = error;
  } catch (const std::exception& error) {
    fault.error = Error(source_.where(), error.what(), "free memory and try again");
  }
  fault.index = index_;
  if (fault.error && !give(std::move(fault))) return;
  const std::lock_guard lock(mutex_);
  done_ = true;
  changed_.notify_all();
}

std::optional<SourceFrame> FrameLoader::step() {
  for (; skip_ > 0; --skip_) {
    if (!source_.next()) return std::nullopt;
  }
  if (count_ && index_ == *count_) return std::nullopt;
  return source_.next();
}

bool FrameLoader::give(LoadedFrame frame) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return ready_.size() < ahead_ || stop_; });
  if (stop_) return false;
  ready_.push_back(std::move(frame));
  lock.unlock();
  changed_.notify_all();
  return true;
}

LoadedFrame FrameLoader::load(const SourceFrame& source) const {
  LoadedFrame frame;
  frame.index = index_;
  frame.timestamp = source.timestamp;
  frame.depth_timestamp = source.depth_timestamp;
  frame.name = source.name;
  frame.imu = source.imu;
  frame.packed = source.images;
  try {
    frame.image = decoder_.decode(source, mode_);
    frame.image->may_be_kept = true;  // it is given away
    if (frame.image->colour.channels() == 3 &&
        frame.image->grey.empty()) {  // here, not on the tracker's time
      cv::cvtColor(frame.image->colour, frame.image->grey, cv::COLOR_BGR2GRAY);
    }
  } catch (const Error& error) {
    frame.error = error;
  } catch (const std::exception& error) {  // no memory, say: it must not end the program from a thread
    frame.error = Error(source.where, error.what(), "free memory and try again");
  }
  return frame;
}

}  // namespace stdc::app
