// What oneDNN can do on this processor.
#include <fmt/format.h>

#include "segmentation/network/kernels/dnnl_convolution.hpp"
#include "segmentation/network/kernels/dnnl_kernels.hpp"
#include "segmentation/network/kernels/dot_kernel.hpp"

namespace stdc {

using dnnl::memory;

int DnnlEngine::activation_levels() {
  switch (dnnl::get_effective_cpu_isa()) {
    case dnnl::cpu_isa::sse41:
    case dnnl::cpu_isa::avx:
    case dnnl::cpu_isa::avx2:
    case dnnl::cpu_isa::avx2_vnni:  // version 2.6 has no such kernels for some layers: right for all
    case dnnl::cpu_isa::avx512_core:
      return 127;
    default:  // also processors that it has no kernels for: the sums of our own are exact
      return 255;
  }
}

namespace {

TensorView common_view() { return {{64, 32, 32}, ElementType::f32, 64, 64, nullptr}; }

/// oneDNN's kernel for a common layer in fp32, in layouts of its choice.
std::optional<dnnl::convolution_forward::primitive_desc> common_kernel(const dnnl::engine& engine) {
  const TensorView view = common_view();
  DnnlRequest request;
  request.source = request.target = dnnl_any_layout(view);
  request.weights = memory::desc({64, 64, 3, 3}, memory::data_type::f32, memory::format_tag::any);
  request.bias = memory::desc({64}, memory::data_type::f32, memory::format_tag::a);
  request.strides = request.padding_before = request.padding_after = {1, 1};
  return find_dnnl_kernel(engine, request);
}

}  // namespace

bool DnnlEngine::has_fast_kernels() {
  return common_kernel(dnnl::engine(dnnl::engine::kind::cpu, 0)).has_value();
}

int DnnlEngine::preferred_block() {
  constexpr int kOfOwnKernels = 8;
  const auto kernel = common_kernel(dnnl::engine(dnnl::engine::kind::cpu, 0));
  if (!kernel) return kOfOwnKernels;
  TensorView blocked = common_view();
  for (const int block : {16, 8}) {
    blocked.block = blocked.pixel_stride = block;
    if (kernel->dst_desc() == dnnl_layout(blocked)) return block;
  }
  return 0;
}

std::string DnnlEngine::description() {
  const dnnl_version_t* version = dnnl_version();
  if (!has_fast_kernels()) {
    return fmt::format("own kernels{} (oneDNN {}.{}.{} has none for this processor)",
                       has_dot_product() ? " with dot products" : "", version->major, version->minor,
                       version->patch);
  }
  const char* isa = "newer";
  switch (dnnl::get_effective_cpu_isa()) {
    case dnnl::cpu_isa::sse41:
      isa = "SSE4.1";
      break;
    case dnnl::cpu_isa::avx:
      isa = "AVX";
      break;
    case dnnl::cpu_isa::avx2:
      isa = "AVX2";
      break;
    case dnnl::cpu_isa::avx2_vnni:
      isa = "AVX2 VNNI";
      break;
    case dnnl::cpu_isa::avx512_core:
      isa = "AVX-512";
      break;
    case dnnl::cpu_isa::avx512_core_vnni:
      isa = "AVX-512 VNNI";
      break;
    case dnnl::cpu_isa::avx512_core_bf16:
      isa = "AVX-512 VNNI BF16";
      break;
    default:
      break;
  }
  return fmt::format("oneDNN {}.{}.{}, {}", version->major, version->minor, version->patch, isa);
}

}  // namespace stdc
