#include "viewer/server/thread_stacks.hpp"

#include <dlfcn.h>
#include <pthread.h>

#include <algorithm>

// CivetWeb's size is fixed when it is compiled. Its call finds this definition in place of glibc's, since a
// program and what it is linked to are searched before the C library. Memory is taken only as a stack grows.
#ifdef __GLIBC__
extern "C" __attribute__((visibility("default"))) int pthread_attr_setstacksize(pthread_attr_t* attributes,
                                                                                std::size_t size) noexcept {
  using Function = int (*)(pthread_attr_t*, std::size_t);
  static const auto of_glibc = reinterpret_cast<Function>(
      dlsym(RTLD_NEXT, "pthread_attr_setstacksize"));  // NOLINT(*-reinterpret-cast)
  constexpr std::size_t kLeast = std::size_t{1} << 20U;
  return of_glibc(attributes, std::max(size, kLeast));
}
#endif

namespace stdc {

/// The definition above is linked with this one.
void have_large_thread_stacks() {}

}  // namespace stdc
