#pragma once

#include <cstddef>

#include "core/camera.hpp"
#include "input/registration/lens_table.hpp"
#include "input/registration/registration_kernel.hpp"

namespace stdc {

/// Moves many ideal pixels of a camera to their raw ones. Brown-Conrady by its polynomial in single precision
/// (to about 0.001 px), a fisheye by a table.
class LensRows {
 public:
  explicit LensRows(const Camera& camera);
  /// Moves `count` pixels; those that lie outside what the camera shows become NaN. The rows have room for
  /// kRegistrationPadding more.
  void distort(float* u, float* v, std::size_t count) const;

 private:
  bool brown_ = false;
  BrownLens lens_;   ///< if `brown_`
  LensTable table_;  ///< of a fisheye; else empty
};

}  // namespace stdc
