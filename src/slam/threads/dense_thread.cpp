#include "slam/threads/dense_thread.hpp"

#include <utility>

#include "core/give_way.hpp"
#include "core/stopwatch.hpp"

namespace stdc {

DenseThread::DenseThread(const Camera& camera, const DenseSettings& settings)
    : collector_(camera, settings),
      capacity_(static_cast<std::size_t>(settings.queue)),
      thread_([this] { run(); }) {}

DenseThread::~DenseThread() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void DenseThread::add(DenseFrame frame) {
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return queue_.size() < capacity_ || fault_; });
    if (fault_) std::rethrow_exception(fault_);
    queue_.push_back(std::move(frame));
  }
  changed_.notify_all();
}

void DenseThread::wait_until_idle(std::unique_lock<std::mutex>& lock) {
  changed_.wait(lock, [this] { return (queue_.empty() && !busy_) || fault_; });
  if (fault_) std::rethrow_exception(fault_);
}

DenseViews DenseThread::views() {
  std::unique_lock lock(mutex_);
  wait_until_idle(lock);
  return collector_.views();
}

DenseViews DenseThread::views_so_far() {
  const std::lock_guard lock(mutex_);
  return closed_;
}

DenseThread::Usage DenseThread::usage() {
  std::unique_lock lock(mutex_);
  wait_until_idle(lock);
  return usage_;
}

void DenseThread::run() {
  give_way();  // to the tracker
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stop_ || !queue_.empty(); });
    if (stop_) return;
    const DenseFrame frame = std::move(queue_.front());
    queue_.pop_front();
    busy_ = true;
    lock.unlock();
    std::exception_ptr fault;
    const int closed_before = collector_.closed();
    DenseViews closed;
    try {
      collector_.add(frame);
      if (collector_.closed() != closed_before) closed = collector_.closed_views();
    } catch (...) {
      fault = std::current_exception();
    }
    lock.lock();
    if (!closed.empty()) closed_ = std::move(closed);
    usage_ = {thread_cpu_ms(), usage_.frames + 1};
    busy_ = false;
    if (fault) fault_ = fault;
    changed_.notify_all();
    if (fault_) return;
  }
}

}  // namespace stdc
