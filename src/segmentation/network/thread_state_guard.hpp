#pragma once

namespace stdc {

/// Sets the calling thread up for inference and restores its state at the end: denormal numbers count as zero
/// (FTZ and DAZ; they would cost a hundred cycles each), and oneDNN's loops started from this thread use
/// `threads` threads. Other threads are not touched.
class ThreadStateGuard {
 public:
  explicit ThreadStateGuard(int threads);
  ~ThreadStateGuard();
  ThreadStateGuard(const ThreadStateGuard&) = delete;
  ThreadStateGuard& operator=(const ThreadStateGuard&) = delete;

  /// Throws Error if more than one thread is asked for while OpenMP's threads would spin between loops:
  /// beside a busy tracker that made inference twenty times slower. libgomp reads OMP_WAIT_POLICY (or
  /// GOMP_SPINCOUNT) when the program starts, so the program cannot change it itself.
  static void check(int threads);

 private:
  unsigned control_ = 0;  ///< of the floating point unit
  int threads_before_ = 1;
};

}  // namespace stdc
