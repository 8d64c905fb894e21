#pragma once

#include <csignal>

namespace stdc::app {

/// Holds back Ctrl-C and a polite kill while it lives, so that a run can stop between two frames and tidy up.
/// After that the signal does what it always does. To be made before the program starts threads: they inherit
/// what is held back. Threads that libraries start as they are loaded (OpenBLAS does) do not; a signal that
/// comes to one of those is noted and comes again at the end.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  /// Has one of the signals come?
  bool interrupted() const;
  /// The same, and takes it: the program goes on to its end by itself. The next one counts anew.
  bool take() const;

 private:
  sigset_t mask_before_{};
  struct sigaction interrupt_before_ = {};
  struct sigaction terminate_before_ = {};
};

}  // namespace stdc::app
