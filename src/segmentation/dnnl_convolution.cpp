#include "segmentation/dnnl_convolution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <oneapi/dnnl/dnnl.hpp>
#include <optional>
#include <unordered_map>

#include "core/error.hpp"

namespace stdc {
namespace {

using dnnl::memory;
using Primitive = dnnl::convolution_forward::primitive_desc;

memory::data_type type_of(ElementType type) {
  return type == ElementType::f32 ? memory::data_type::f32 : memory::data_type::u8;
}

memory::dims dims_of(const TensorShape& shape) { return {1, shape.channels, shape.height, shape.width}; }

memory::desc layout_of(const TensorView& view) {
  const memory::dims dims = dims_of(view.shape);
  if (view.channels_last()) {
    const auto pixel = static_cast<memory::dim>(view.pixel_stride), row = pixel * view.shape.width;
    return {dims, type_of(view.type), {row * view.shape.height, 1, row, pixel}};
  }
  using tag = memory::format_tag;
  const tag layout = view.block == 16 ? tag::nChw16c : view.block == 8 ? tag::nChw8c : tag::nchw;
  return {dims, type_of(view.type), layout};
}

memory::desc any_layout(const TensorView& view) {
  return {dims_of(view.shape), type_of(view.type), memory::format_tag::any};
}

bool is_reference(const std::string& kernel) {
  return kernel.empty() || kernel.rfind("ref", 0) == 0 || kernel.find(":ref") != std::string::npos;
}

/// What the version-specific functions below need to know of a convolution.
struct Request {
  dnnl::algorithm algorithm = dnnl::algorithm::convolution_direct;
  memory::desc source, weights, bias, target;
  memory::dims strides, padding_before, padding_after;
  bool relu = true;
  std::vector<float> scales;  ///< [output] real target levels per unit of the sums; empty: fp32
};

dnnl::primitive_attr attributes(const Request& request) {
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

/// Nothing if oneDNN has no kernel at all or only a reference kernel.
std::optional<Primitive> find_kernel(const dnnl::engine& engine, const Request& request) {
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
    if (is_reference(found.impl_info_str())) return std::nullopt;
    return found;
  } catch (const dnnl::error&) {
    return std::nullopt;
  }
}

/// The factor by which oneDNN multiplies the bias together with the sums. Version 3 adds the bias after that.
float bias_unit([[maybe_unused]] float scale, [[maybe_unused]] float target_scale) {
#if DNNL_VERSION_MAJOR >= 3
  return target_scale;
#else
  return scale * target_scale;
#endif
}

Request describe(const ConvolutionWeights& layer, const TensorView& source, const TensorView& target,
                 const ConvolutionOptions& options) {
  const auto weight_type = source.type == ElementType::f32 ? memory::data_type::f32 : memory::data_type::s8;
  Request request;
  request.source = layout_of(source);
  request.target = layout_of(target);
  request.weights = memory::desc({layer.outputs, layer.inputs, layer.kernel, layer.kernel}, weight_type,
                                 memory::format_tag::any);
  request.bias = memory::desc({layer.outputs}, memory::data_type::f32, memory::format_tag::a);
  request.strides = {layer.stride, layer.stride};
  request.padding_before = {options.padding_before, options.padding_before};
  request.padding_after = {options.padding_after, options.padding_after};
  request.relu = options.relu;
  return request;
}

/// Weights as 8-bit numbers, and for each output the real number that one of them stands for.
struct QuantisedWeights {
  std::vector<std::int8_t> levels;
  std::vector<float> scales;
};

QuantisedWeights quantise(const ConvolutionWeights& layer, int levels) {
  QuantisedWeights result;
  const std::size_t count = layer.weights_per_output();
  result.levels.resize(layer.weights.size());
  for (std::size_t o = 0; o < layer.bias.size(); ++o) {
    const float* weights = &layer.weights[o * count];
    float largest = 0;
    for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, std::abs(weights[i]));
    const float scale = largest > 0 ? largest / static_cast<float>(levels) : 1;
    result.scales.push_back(scale);
    for (std::size_t i = 0; i < count; ++i) {
      const auto level =
          std::clamp(std::lround(weights[i] / scale), -static_cast<long>(levels), static_cast<long>(levels));
      result.levels[o * count + i] = static_cast<std::int8_t>(level);
    }
  }
  return result;
}

}  // namespace

struct DnnlEngine::Implementation {
  dnnl::engine engine{dnnl::engine::kind::cpu, 0};
  dnnl::stream stream{engine};
  std::size_t scratch_bytes = 0;
  std::shared_ptr<void> scratch;

  void need_scratch(std::size_t bytes) {
    if (bytes <= scratch_bytes) return;
    scratch_bytes = bytes;
    scratch = aligned_memory(bytes);
  }
};

DnnlEngine::DnnlEngine() : implementation_(std::make_unique<Implementation>()) {}
DnnlEngine::~DnnlEngine() = default;

struct DnnlConvolution::Implementation {
  explicit Implementation(DnnlEngine::Implementation& shared_with) : shared(shared_with) {}

  /// A memory that is the view itself or, if the kernel wants another layout, a private one.
  memory bind(const memory::desc& wanted, const TensorView& view, std::optional<dnnl::reorder>& reorder,
              bool is_source) {
    memory outside(layout_of(view), shared.engine, view.data);
    if (wanted == layout_of(view)) return outside;
    memory inside(wanted, shared.engine);
    const memory& from = is_source ? outside : inside;
    const memory& to = is_source ? inside : outside;
    const dnnl::reorder::primitive_desc description(from, to);
    if (is_reference(description.impl_info_str())) return {};
    reorder = dnnl::reorder(description);
    (is_source ? before_arguments : after_arguments) = {{DNNL_ARG_FROM, from}, {DNNL_ARG_TO, to}};
    return inside;
  }

  DnnlEngine::Implementation& shared;
  dnnl::convolution_forward primitive;
  std::unordered_map<int, memory> arguments, before_arguments, after_arguments;
  std::optional<dnnl::reorder> before, after;
  std::vector<float> bias, scales;  // arguments point to them
};

namespace {

/// The first kernel that is not a reference one: Winograd where oneDNN has it for these layouts, direct,
/// direct with layouts of its own choice.
std::optional<Primitive> best_kernel(const dnnl::engine& engine, Request request, const TensorView& source,
                                     const TensorView& target, const ConvolutionWeights& layer) {
  if (source.type == ElementType::f32 && layer.kernel == 3 && layer.stride == 1) {
    request.algorithm = dnnl::algorithm::convolution_winograd;
    if (auto kernel = find_kernel(engine, request)) return kernel;
    request.algorithm = dnnl::algorithm::convolution_direct;
  }
  if (auto kernel = find_kernel(engine, request)) return kernel;
  request.target = any_layout(target);
  if (auto kernel = find_kernel(engine, request)) return kernel;
  request.source = any_layout(source);
  return find_kernel(engine, request);
}

}  // namespace

DnnlConvolution::DnnlConvolution(DnnlEngine& engine, const ConvolutionWeights& layer,
                                 const TensorView& source, const TensorView& target,
                                 const ConvolutionOptions& options)
    : implementation_(std::make_unique<Implementation>(*engine.implementation_)) {
  Implementation& own = *implementation_;
  const dnnl::engine& dnnl_engine = own.shared.engine;
  Request request = describe(layer, source, target, options);
  own.bias = layer.bias;
  QuantisedWeights quantised;
  if (source.type == ElementType::u8) {
    quantised = quantise(layer, options.weight_levels);
    const float target_scale = target.type == ElementType::u8 ? options.target_scale : 1;
    for (std::size_t o = 0; o < own.bias.size(); ++o) {
      own.scales.push_back(options.source_scale * quantised.scales[o] / target_scale);
      own.bias[o] /= bias_unit(own.scales[o], target_scale);
    }
    request.scales = own.scales;
  }
  const auto kernel = best_kernel(dnnl_engine, request, source, target, layer);
  const memory inside = kernel ? own.bind(kernel->src_desc(), source, own.before, true) : memory();
  const memory outside = kernel ? own.bind(kernel->dst_desc(), target, own.after, false) : memory();
  if (!inside || !outside) {
    throw Error(fmt::format("layer '{}'", layer.name),
                "oneDNN has only a slow reference kernel for it on this processor",
                "use the other precision or a network whose channels are multiples of 16");
  }
  kernel_ = kernel->impl_info_str();
  if (own.before || own.after) kernel_ += "+reorder";
  own.primitive = dnnl::convolution_forward(*kernel);

  const bool is_f32 = source.type == ElementType::f32;
  const memory::desc plain({layer.outputs, layer.inputs, layer.kernel, layer.kernel},
                           is_f32 ? memory::data_type::f32 : memory::data_type::s8, memory::format_tag::oihw);
  memory given(
      plain, dnnl_engine,
      is_f32 ? static_cast<void*>(const_cast<float*>(layer.weights.data())) : quantised.levels.data());
  memory weights(kernel->weights_desc(), dnnl_engine);
  dnnl::reorder(given, weights).execute(own.shared.stream, given, weights);
  own.shared.stream.wait();

  own.shared.need_scratch(kernel->scratchpad_desc().get_size());
  own.arguments = {{DNNL_ARG_SRC, inside},
                   {DNNL_ARG_WEIGHTS, weights},
                   {DNNL_ARG_BIAS, memory(request.bias, dnnl_engine, own.bias.data())},
                   {DNNL_ARG_DST, outside},
                   {DNNL_ARG_SCRATCHPAD, memory(kernel->scratchpad_desc(), dnnl_engine, nullptr)}};
#if DNNL_VERSION_MAJOR >= 3
  if (!own.scales.empty()) {
    const memory::desc scales({layer.outputs}, memory::data_type::f32, memory::format_tag::a);
    own.arguments.emplace(DNNL_ARG_ATTR_SCALES | DNNL_ARG_WEIGHTS,
                          memory(scales, dnnl_engine, own.scales.data()));
  }
#endif
}

DnnlConvolution::~DnnlConvolution() = default;
DnnlConvolution::DnnlConvolution(DnnlConvolution&&) noexcept = default;

void DnnlConvolution::run() {
  Implementation& own = *implementation_;
  memory& scratch = own.arguments.at(DNNL_ARG_SCRATCHPAD);
  if (scratch.get_data_handle() != own.shared.scratch.get())
    scratch.set_data_handle(own.shared.scratch.get());
  if (own.before) own.before->execute(own.shared.stream, own.before_arguments);
  own.primitive.execute(own.shared.stream, own.arguments);
  if (own.after) own.after->execute(own.shared.stream, own.after_arguments);
}

bool DnnlEngine::has_fast_int8() {
  switch (dnnl::get_effective_cpu_isa()) {
    case dnnl::cpu_isa::sse41:
    case dnnl::cpu_isa::avx:
    case dnnl::cpu_isa::avx2:
    case dnnl::cpu_isa::avx512_core:
      return false;
    default:
      return true;
  }
}

int DnnlEngine::activation_levels() {
  // Kernels for AVX-VNNI do not exist for all layers in version 2.6: the 7-bit levels are right for all.
  return has_fast_int8() && dnnl::get_effective_cpu_isa() != dnnl::cpu_isa::avx2_vnni ? 255 : 127;
}

int DnnlEngine::preferred_block() {
  const dnnl::engine engine(dnnl::engine::kind::cpu, 0);
  const TensorView view{{64, 32, 32}, ElementType::f32, 64, 64, nullptr};
  Request request;
  request.source = request.target = any_layout(view);
  request.weights = memory::desc({64, 64, 3, 3}, memory::data_type::f32, memory::format_tag::any);
  request.bias = memory::desc({64}, memory::data_type::f32, memory::format_tag::a);
  request.strides = request.padding_before = request.padding_after = {1, 1};
  const auto kernel = find_kernel(engine, request);
  TensorView blocked = view;
  for (const int block : {16, 8}) {
    blocked.block = blocked.pixel_stride = block;
    if (kernel && kernel->dst_desc() == layout_of(blocked)) return block;
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
