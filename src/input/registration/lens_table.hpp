#pragma once

#include <vector>

#include "core/camera.hpp"

namespace stdc {

/// How far the raw pixel of a camera lies from the ideal one, on a grid over its ideal pixels, for whoever
/// needs many of them: exact to about 0.01 px.
class LensTable {
 public:
  LensTable() = default;
  explicit LensTable(const Camera& camera);
  bool empty() const { return rows_ == 0; }
  /// Moves an ideal pixel to its raw one; false outside what the camera shows.
  bool distort(float& u, float& v) const;

 private:
  float left_ = 0, top_ = 0;
  int columns_ = 0, rows_ = 0;
  std::vector<float> shift_x_, shift_y_;
};

}  // namespace stdc
