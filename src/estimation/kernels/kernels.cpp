#include "estimation/kernels/kernels.hpp"

namespace stdc::kernels {

namespace for_baseline {
extern const Table table;
}
#if defined(__x86_64__)
namespace for_avx2 {
extern const Table table;
}
#endif

const Table& baseline() { return for_baseline::table; }

const Table& best() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return for_avx2::table;
#endif
  return baseline();
}

}  // namespace stdc::kernels
