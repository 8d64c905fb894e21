#include "run/interrupt_watch.hpp"

#include <pthread.h>

#include <atomic>

namespace stdc::app {
namespace {

/// The signal that a thread which does not hold it back has taken, or 0. A handler reaches nothing else.
std::atomic<int> noted = 0;
static_assert(std::atomic<int>::is_always_lock_free);

void note(int signal) { noted = signal; }

sigset_t held_signals() {
  sigset_t held;
  sigemptyset(&held);
  sigaddset(&held, SIGINT);
  sigaddset(&held, SIGTERM);
  return held;
}

}  // namespace

InterruptWatch::InterruptWatch() {
  const sigset_t held = held_signals();
  pthread_sigmask(SIG_BLOCK, &held, &mask_before_);
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, &interrupt_before_);
  sigaction(SIGTERM, &action, &terminate_before_);
}

InterruptWatch::~InterruptWatch() {
  sigaction(SIGINT, &interrupt_before_, nullptr);
  sigaction(SIGTERM, &terminate_before_, nullptr);
  if (const int signal = noted.exchange(0); signal != 0) raise(signal);
  pthread_sigmask(SIG_SETMASK, &mask_before_, nullptr);
}

bool InterruptWatch::interrupted() const {
  sigset_t pending;
  sigpending(&pending);
  return noted != 0 || sigismember(&pending, SIGINT) == 1 || sigismember(&pending, SIGTERM) == 1;
}

bool InterruptWatch::take() const {
  const sigset_t awaited = held_signals();
  const timespec at_once{};
  bool taken = noted.exchange(0) != 0;
  while (sigtimedwait(&awaited, nullptr, &at_once) > 0) taken = true;
  return taken;
}

}  // namespace stdc::app
