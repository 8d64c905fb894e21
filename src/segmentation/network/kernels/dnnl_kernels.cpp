#include "segmentation/network/kernels/dnnl_kernels.hpp"

namespace stdc {

using dnnl::memory;
using Primitive = dnnl::convolution_forward::primitive_desc;

namespace {

memory::data_type type_of(ElementType type) {
  return type == ElementType::f32 ? memory::data_type::f32 : memory::data_type::u8;
}

memory::dims dims_of(const TensorShape& shape) { return {1, shape.channels, shape.height, shape.width}; }

dnnl::primitive_attr attributes(const DnnlRequest& request) {
  dnnl::primitive_attr attr;
  attr.set_scratchpad_mode(dnnl::scratchpad_mode::user);
  constexpr int kPerOutput = 1;
  dnnl::post_ops after;
#if DNNL_VERSION_MAJOR >= 3
  if (!request.scales.empty()) attr.set_scales_mask(DNNL_ARG_WEIGHTS, kPerOutput);
  if (request.relu) after.append_eltwise(dnnl::algorithm::eltwise_relu, 0, 0);
#else
  if (!request.scales.empty()) attr.set_output_scales(kPerOutput << 1, request.scales);
  if (request.relu) after.append_eltwise(1, dnnl::algorithm::eltwise_relu, 0, 0);
#endif
  attr.set_post_ops(after);
  return attr;
}

}  // namespace

memory::desc dnnl_layout(const TensorView& view) {
  const memory::dims dims = dims_of(view.shape);
  if (view.channels_last()) {
    const auto pixel = static_cast<memory::dim>(view.pixel_stride), row = pixel * view.shape.width;
    return {dims, type_of(view.type), {row * view.shape.height, 1, row, pixel}};
  }
  using tag = memory::format_tag;
  const tag layout = view.block == 16 ? tag::nChw16c : view.block == 8 ? tag::nChw8c : tag::nchw;
  return {dims, type_of(view.type), layout};
}

memory::desc dnnl_any_layout(const TensorView& view) {
  return {dims_of(view.shape), type_of(view.type), memory::format_tag::any};
}

bool is_dnnl_reference(const std::string& kernel) {
  return kernel.empty() || kernel.rfind("ref", 0) == 0 || kernel.find(":ref") != std::string::npos;
}

std::optional<Primitive> find_dnnl_kernel(const dnnl::engine& engine, const DnnlRequest& request) {
  constexpr auto kind = dnnl::prop_kind::forward_inference;
  try {
    const dnnl::primitive_attr attr = attributes(request);
#if DNNL_VERSION_MAJOR >= 3
    Primitive found(engine, kind, request.algorithm, request.source, request.weights, request.bias,
                    request.target, request.strides, request.padding_before, request.padding_after, attr);
#else
    const dnnl::convolution_forward::desc description(
        kind, request.algorithm, request.source, request.weights, request.bias, request.target,
        request.strides, request.padding_before, request.padding_after);
    Primitive found(description, attr, engine);
#endif
    if (is_dnnl_reference(found.impl_info_str())) return std::nullopt;
    return found;
  } catch (const dnnl::error&) {
    return std::nullopt;
  }
}

float dnnl_bias_unit([[maybe_unused]] float scale, [[maybe_unused]] float target_scale) {
#if DNNL_VERSION_MAJOR >= 3
  return target_scale;
#else
  return scale * target_scale;
#endif
}

}  // namespace stdc
