#pragma once

namespace stdc {

/// While it lives, the calling thread is set up for inference: numbers too small for full precision count as
/// zero (FTZ and DAZ: they would cost a hundred cycles each), and oneDNN's loops started from this thread use
/// `threads` threads. What was before comes back at the end. Other threads are not touched.
class InferenceThread {
 public:
  explicit InferenceThread(int threads);
  ~InferenceThread();
  InferenceThread(const InferenceThread&) = delete;
  InferenceThread& operator=(const InferenceThread&) = delete;

  /// Throws Error if more than one thread is asked for while OpenMP's threads would spin between loops:
  /// beside a busy tracker that made inference twenty times slower. libgomp reads OMP_WAIT_POLICY (or
  /// GOMP_SPINCOUNT) when the program starts, so it cannot be mended from inside.
  static void check(int threads);

 private:
  unsigned control_ = 0;  ///< the SSE control and status register
  int threads_before_ = 1;
};

}  // namespace stdc
