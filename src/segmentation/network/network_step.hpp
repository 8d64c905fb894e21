#pragma once

#include <string>

namespace stdc {

/// One step of the network, for reports.
struct NetworkStep {
  std::string name;    ///< layer, or the operation between layers
  std::string kernel;  ///< the implementation, e.g. "jit:avx2"
  double multiplications = 0;
};

}  // namespace stdc
