#include "segmentation/network/kernels/dnnl_convolution.hpp"

#include <oneapi/dnnl/dnnl.hpp>
#include <optional>
#include <unordered_map>

#include "segmentation/network/kernels/dnnl_kernels.hpp"
#include "segmentation/network/kernels/quantised_weights.hpp"

namespace stdc {
namespace {

using dnnl::memory;
using Primitive = dnnl::convolution_forward::primitive_desc;

DnnlRequest describe(const ConvolutionWeights& layer, const TensorView& source, const TensorView& target,
                     const ConvolutionOptions& options) {
  const auto weight_type = source.type == ElementType::f32 ? memory::data_type::f32 : memory::data_type::s8;
  DnnlRequest request;
  request.source = dnnl_layout(source);
  request.target = dnnl_layout(target);
  request.weights = memory::desc({layer.outputs, layer.inputs, layer.kernel, layer.kernel}, weight_type,
                                 memory::format_tag::any);
  request.bias = memory::desc({layer.outputs}, memory::data_type::f32, memory::format_tag::a);
  request.strides = {layer.stride, layer.stride};
  request.padding_before = {options.padding_before, options.padding_before};
  request.padding_after = {options.padding_after, options.padding_after};
  request.relu = options.relu;
  return request;
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
    memory outside(dnnl_layout(view), shared.engine, view.data);
    if (wanted == dnnl_layout(view)) return outside;
    memory inside(wanted, shared.engine);
    const memory& from = is_source ? outside : inside;
    const memory& to = is_source ? inside : outside;
    const dnnl::reorder::primitive_desc description(from, to);
    if (is_dnnl_reference(description.impl_info_str())) return {};
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
std::optional<Primitive> best_kernel(const dnnl::engine& engine, DnnlRequest request,
                                     const TensorView& source, const TensorView& target,
                                     const ConvolutionWeights& layer) {
  if (source.type == ElementType::f32 && layer.kernel == 3 && layer.stride == 1) {
    request.algorithm = dnnl::algorithm::convolution_winograd;
    if (auto kernel = find_dnnl_kernel(engine, request)) return kernel;
    request.algorithm = dnnl::algorithm::convolution_direct;
  }
  if (auto kernel = find_dnnl_kernel(engine, request)) return kernel;
  request.target = dnnl_any_layout(target);
  if (auto kernel = find_dnnl_kernel(engine, request)) return kernel;
  request.source = dnnl_any_layout(source);
  return find_dnnl_kernel(engine, request);
}

}  // namespace

DnnlConvolution::DnnlConvolution() = default;

std::unique_ptr<DnnlConvolution> DnnlConvolution::make(DnnlEngine& engine, const ConvolutionWeights& layer,
                                                       const TensorView& source, const TensorView& target,
                                                       const ConvolutionOptions& options) {
  std::unique_ptr<DnnlConvolution> made(new DnnlConvolution());
  made->implementation_ = std::make_unique<Implementation>(*engine.implementation_);
  Implementation& own = *made->implementation_;
  const dnnl::engine& dnnl_engine = own.shared.engine;
  DnnlRequest request = describe(layer, source, target, options);
  own.bias = layer.bias;
  QuantisedWeights quantised;
  if (source.type == ElementType::u8) {
    quantised = quantise(layer, options.weight_levels);
    const float target_scale = target.type == ElementType::u8 ? options.target_scale : 1;
    for (std::size_t o = 0; o < own.bias.size(); ++o) {
      own.scales.push_back(options.source_scale * quantised.scales[o] / target_scale);
      own.bias[o] /= dnnl_bias_unit(own.scales[o], target_scale);
    }
    request.scales = own.scales;
  }
  const auto kernel = best_kernel(dnnl_engine, request, source, target, layer);
  const memory inside = kernel ? own.bind(kernel->src_desc(), source, own.before, true) : memory();
  const memory outside = kernel ? own.bind(kernel->dst_desc(), target, own.after, false) : memory();
  if (!inside || !outside) return nullptr;
  made->kernel_ = kernel->impl_info_str();
  if (own.before || own.after) made->kernel_ += "+reorder";
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
  return made;
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

}  // namespace stdc
