#pragma once

#include <pthread.h>

#include <csignal>

namespace stdc {

/// civetweb has the process ignore SIGPIPE, which would change what `stdc-slam ... | head` does. Threads
/// that are started while this lives have it blocked, which serves them as well.
class SigpipeGuard {
 public:
  SigpipeGuard() {
    sigset_t pipe;
    sigemptyset(&pipe);
    sigaddset(&pipe, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe, &mask_);
    sigaction(SIGPIPE, nullptr, &action_);
  }
  ~SigpipeGuard() {
    sigaction(SIGPIPE, &action_, nullptr);
    pthread_sigmask(SIG_SETMASK, &mask_, nullptr);
  }
  SigpipeGuard(const SigpipeGuard&) = delete;
  SigpipeGuard& operator=(const SigpipeGuard&) = delete;

 private:
  sigset_t mask_{};
  struct sigaction action_ {};
};

}  // namespace stdc
