#include "run/interrupt_watch.hpp"

#include <pthread.h>

namespace stdc::app {

InterruptWatch::InterruptWatch() {
  sigset_t held;
  sigemptyset(&held);
  sigaddset(&held, SIGINT);
  sigaddset(&held, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &held, &before_);
}

InterruptWatch::~InterruptWatch() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

bool InterruptWatch::interrupted() const {
  sigset_t pending;
  sigpending(&pending);
  return sigismember(&pending, SIGINT) == 1 || sigismember(&pending, SIGTERM) == 1;
}

bool InterruptWatch::take() const {
  sigset_t awaited;
  sigemptyset(&awaited);
  sigaddset(&awaited, SIGINT);
  sigaddset(&awaited, SIGTERM);
  const timespec at_once{};
  bool taken = false;
  while (sigtimedwait(&awaited, nullptr, &at_once) > 0) taken = true;
  return taken;
}

}  // namespace stdc::app
