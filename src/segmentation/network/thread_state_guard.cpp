#include "segmentation/network/thread_state_guard.hpp"

#include <fmt/format.h>
#include <oneapi/dnnl/dnnl_config.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "core/error.hpp"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#if DNNL_CPU_THREADING_RUNTIME == DNNL_RUNTIME_OMP
// Declared here because <omp.h> comes with each compiler, and Debian's clang has none.
extern "C" {
int omp_get_max_threads();
void omp_set_num_threads(int threads);
}
#else
static int omp_get_max_threads() { return 1; }
static void omp_set_num_threads(int) {}
#endif

namespace stdc {
namespace {

bool variable_is(const char* name, std::string_view wanted) {
  const char* value = std::getenv(name);
  return value != nullptr && strncasecmp(value, wanted.data(), wanted.size() + 1) == 0;
}

#if defined(__SSE2__)
constexpr unsigned kDenormalsAreZero = 0x8040;  // as results and as operands
unsigned float_control() { return _mm_getcsr(); }
void set_float_control(unsigned control) { _mm_setcsr(control); }
#elif defined(__aarch64__)
constexpr unsigned kDenormalsAreZero = 1U << 24;  // FZ
unsigned float_control() {
  std::uint64_t control = 0;
  __asm__ volatile("mrs %0, fpcr" : "=r"(control));
  return static_cast<unsigned>(control);
}
void set_float_control(unsigned control) { __asm__ volatile("msr fpcr, %0" : : "r"(std::uint64_t{control})); }
#else
constexpr unsigned kDenormalsAreZero = 0;
unsigned float_control() { return 0; }
void set_float_control(unsigned) {}
#endif

}  // namespace

ThreadStateGuard::ThreadStateGuard(int threads) : threads_before_(omp_get_max_threads()) {
  control_ = float_control();
  set_float_control(control_ | kDenormalsAreZero);
  omp_set_num_threads(threads);
}

ThreadStateGuard::~ThreadStateGuard() {
  omp_set_num_threads(threads_before_);
  set_float_control(control_);
}

void ThreadStateGuard::check(int threads) {
  if (threads <= 1 || variable_is("OMP_WAIT_POLICY", "passive") || variable_is("GOMP_SPINCOUNT", "0")) return;
  throw Error(
      "segmentation.threads",
      fmt::format("with {} threads OpenMP would spin beside the other threads of the program", threads),
      "start the program with OMP_WAIT_POLICY=PASSIVE in its environment, or use one thread");
}

}  // namespace stdc
