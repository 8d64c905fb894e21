#pragma once

#include <span>

namespace stdc {

/// Output of the network, one score per class and pixel, at an eighth of the input's size.
struct Logits {
  std::span<const float> planes;  ///< [class][y][x]
  int classes = 0, height = 0, width = 0;
};

}  // namespace stdc
