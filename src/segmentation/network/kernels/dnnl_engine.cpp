// What oneDNN can do on this processor.
#include <fmt/format.h>

#include "segmentation/network/kernels/dnnl_convolution.hpp"
#include "segmentation/network/kernels/dnnl_kernels.hpp"

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
    default:
      return 255;
  }
}

int DnnlEngine::preferred_block() {
  const dnnl::engine engine(dnnl::engine::kind::cpu, 0);
  const TensorView view{{64, 32, 32}, ElementType::f32, 64, 64, nullptr};
  DnnlRequest request;
  request.source = request.target = dnnl_any_layout(view);
  request.weights = memory::desc({64, 64, 3, 3}, memory::data_type::f32, memory::format_tag::any);
  request.bias = memory::desc({64}, memory::data_type::f32, memory::format_tag::a);
  request.strides = request.padding_before = request.padding_after = {1, 1};
  const auto kernel = find_dnnl_kernel(engine, request);
  TensorView blocked = view;
  for (const int block : {16, 8}) {
    blocked.block = blocked.pixel_stride = block;
    if (kernel && kernel->dst_desc() == dnnl_layout(blocked)) return block;
  }
  return 0;
}

std::string DnnlEngine::description() {
  const dnnl_version_t* version = dnnl_version();
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
