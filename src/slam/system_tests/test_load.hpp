#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace stdc::test {

/// Keeps the processor busy while it lives: four threads that compute and never sleep.
class Load {
 public:
  Load() {
    constexpr int kThreads = 4;
    threads_.reserve(kThreads);
    for (int i = 0; i < kThreads; ++i) threads_.emplace_back([this] { work(); });
  }
  Load(const Load&) = delete;
  Load& operator=(const Load&) = delete;
  ~Load() {
    stop_ = true;
    for (std::thread& thread : threads_) thread.join();
  }

 private:
  void work() const {
    double x = 1;
    while (!stop_) x = x * 1.0000001 + 1e-9;
    EXPECT_GT(x, 0);
  }

  std::atomic<bool> stop_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace stdc::test
