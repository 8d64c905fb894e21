#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace stdc {

/// A thread that does one job at a time.
class Worker {
 public:
  Worker();
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Starts a job; the one before must have been waited for.
  void start(std::function<void()> job);
  /// Returns when the job is done, at once if there is none. What the job threw is thrown here.
  void wait();

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> job_;
  std::exception_ptr fault_;
  bool busy_ = false, stop_ = false;
  std::thread thread_;
};

}  // namespace stdc
