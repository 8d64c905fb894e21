#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>

#include "dense/fusion/view_collector.hpp"

namespace stdc {

/// Makes the views of the dense map beside the tracker. Frames wait in a queue of bounded length; when it is
/// full the tracker waits, so what becomes of a frame never depends on how fast the machine is.
class DenseThread {
 public:
  DenseThread(const Camera& camera, const DenseSettings& settings);
  ~DenseThread();
  DenseThread(const DenseThread&) = delete;
  DenseThread& operator=(const DenseThread&) = delete;

  /// The next frame; its images are not changed afterwards.
  void add(DenseFrame frame);
  /// All views so far, waiting for the frames in the queue.
  DenseViews views();
  /// Views that are done by now, without waiting: which ones depends on how fast the machine is, so they are
  /// for looking at only.
  DenseViews views_so_far();
  /// Views of a loaded map, before the first frame.
  void set_views(const std::vector<PlacedView>& views, MapId map) { collector_.set_views(views, map); }
  const Pinhole& pinhole() const { return collector_.pinhole(); }
  /// CPU milliseconds of the thread so far, and frames; waiting like views().
  struct Usage {
    double cpu_ms = 0;
    int frames = 0;
  };
  Usage usage();

 private:
  void run();
  void wait_until_idle(std::unique_lock<std::mutex>& lock);

  ViewCollector collector_;
  std::size_t capacity_;
  std::mutex mutex_;
  std::condition_variable changed_;
  DenseViews closed_;
  std::deque<DenseFrame> queue_;  ///< the first is being worked on, if `busy_`
  bool busy_ = false, stop_ = false;
  std::exception_ptr fault_;
  Usage usage_;
  std::thread thread_;  ///< last, so that it begins after what it works on
};

}  // namespace stdc
