#include "run/interrupt_watch.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <thread>

namespace stdc::app {
namespace {

/// As a library starts one when it is loaded: it holds no signal back. Idle while it lives.
class ForeignThread {
 public:
  ForeignThread() {
    std::unique_lock lock(mutex_);
    change_.wait(lock, [this] { return runs_; });
  }
  ~ForeignThread() {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    change_.notify_all();
    thread_.join();
  }

 private:
  void idle() {
    std::unique_lock lock(mutex_);
    runs_ = true;
    change_.notify_all();
    change_.wait(lock, [this] { return ends_; });
  }

  std::mutex mutex_;
  std::condition_variable change_;
  bool runs_ = false, ends_ = false;
  std::thread thread_{[this] { idle(); }};
};

/// Sent to the process; another thread may take a moment to note it.
bool is_seen(const InterruptWatch& watch, int signal) {
  kill(getpid(), signal);
  for (int i = 0; i < 500 && !watch.interrupted(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return watch.interrupted();
}

TEST(InterruptWatch, HoldsTheSignalBack) {
  const InterruptWatch watch;
  for (const int signal : {SIGTERM, SIGINT}) {
    EXPECT_FALSE(watch.interrupted());
    EXPECT_TRUE(is_seen(watch, signal));
    EXPECT_TRUE(watch.take());
    EXPECT_FALSE(watch.take());
  }
}

TEST(InterruptWatch, HoldsItBackWhereThreadsOfLibrariesDoNot) {
  const ForeignThread thread;
  const InterruptWatch watch;
  for (const int signal : {SIGINT, SIGTERM}) {
    EXPECT_TRUE(is_seen(watch, signal));
    EXPECT_TRUE(watch.take());
    EXPECT_FALSE(watch.interrupted());
  }
}

void end_by(int signal, bool with_thread) {
  std::signal(signal, SIG_DFL);  // a shell has what it starts in the background ignore interrupts
  const auto thread = with_thread ? std::make_unique<ForeignThread>() : nullptr;
  {
    const InterruptWatch watch;
    if (!is_seen(watch, signal)) std::abort();
  }
  std::exit(0);
}

TEST(InterruptWatchDeathTest, AfterThatTheSignalDoesWhatItAlwaysDoes) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  for (const int signal : {SIGINT, SIGTERM}) {
    EXPECT_EXIT(end_by(signal, false), ::testing::KilledBySignal(signal), "");
    EXPECT_EXIT(end_by(signal, true), ::testing::KilledBySignal(signal), "");
  }
}

}  // namespace
}  // namespace stdc::app
