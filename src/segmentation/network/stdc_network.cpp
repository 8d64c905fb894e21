#include "segmentation/network/stdc_network.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/stopwatch.hpp"
#include "segmentation/network/network_builder.hpp"
#include "segmentation/network/network_input.hpp"
#include "segmentation/network/thread_state_guard.hpp"

namespace stdc {
namespace {

float rectified(float value) { return std::max(value, 0.0F); }
float sigmoid(float value) { return 1 / (1 + std::exp(-value)); }
float one_plus_sigmoid(float value) { return 1 + sigmoid(value); }

/// True if the outputs of all convolutions, which is also where concatenations are cut, fill whole blocks.
bool fills_blocks(const NetworkWeights& weights, int block) {
  const auto fills = [&](const ConvolutionWeights& layer) { return layer.outputs % block == 0; };
  for (const auto& stage : weights.stages) {
    for (const ModuleWeights& module : stage) {
      if (!std::all_of(module.blocks.begin(), module.blocks.end(), fills)) return false;
    }
  }
  return fills(weights.stage1) && fills(weights.stage2) && fills(weights.refinement4.convolution) &&
         fills(weights.refinement5.convolution) && fills(weights.head4) && fills(weights.head5) &&
         fills(weights.fusion) && fills(weights.head);
}

int choose_block(const NetworkWeights& weights, NetworkPrecision precision) {
  if (precision == NetworkPrecision::int8) return 0;  // all int8 kernels have channels last
  const int block = DnnlEngine::preferred_block();
  return block > 0 && fills_blocks(weights, block) ? block : 0;
}

NetworkPrecision choose_precision(const NetworkWeights& weights, NetworkPrecision wanted) {
  if (wanted == NetworkPrecision::automatic) {
    return weights.calibrated() ? NetworkPrecision::int8 : NetworkPrecision::fp32;
  }
  if (wanted == NetworkPrecision::int8 && !weights.calibrated()) {
    throw Error(weights.file, "has no activation ranges for all layers, which int8 needs",
                "calibrate the weights, or choose fp32");
  }
  return wanted;
}

}  // namespace

struct StdcNetwork::Implementation {
  Implementation(const NetworkWeights& weights, cv::Size size, NetworkPrecision wanted, int thread_count)
      : precision(choose_precision(weights, wanted)),
        threads(thread_count),
        classes(weights.classify.outputs),
        builder(precision, choose_block(weights, precision), thread_count),
        input(weights, size, precision) {
    const Activation stage2 = add_stem(weights);
    add_stages(weights, stage2);
  }

  Activation add_stem(const NetworkWeights& weights) {
    ConvolutionOptions options;
    options.padding_before = input.padding();
    options.weight_levels = input.weight_levels(builder.levels());
    const ConvolutionWeights first = input.adapt(weights.stage1);
    const bool levels = builder.is_int8();
    const Activation stage1 = builder.make({first.outputs, input.size().height / 2, input.size().width / 2},
                                           levels ? ElementType::u8 : ElementType::f32,
                                           levels ? builder.input_scale(weights.stage2) : 1);
    builder.convolution_into(first, {{input.view(), nullptr}, 1}, stage1, options);
    return builder.convolution(weights.stage2, stage1, builder.input_scale(weights.stages[0][0].blocks[0]));
  }

  /// An STDC module whose output goes into `target`, which it is concatenated in.
  void add_module(const ModuleWeights& module, const Activation& source, const Activation& target) {
    Activation before = source;
    int first = 0;
    for (std::size_t i = 0; i < module.blocks.size(); ++i) {
      const ConvolutionWeights& layer = module.blocks[i];
      const Activation place = NetworkBuilder::slice(target, first, layer.outputs);
      first += layer.outputs;
      const bool shrinks = i == 0 && module.stride() == 2;
      if (!builder.is_int8() && !shrinks) {
        builder.convolution_into(layer, before, place);
        before = place;
        continue;
      }
      const float scale =
          i + 1 < module.blocks.size() ? builder.input_scale(module.blocks[i + 1]) : place.scale;
      before = builder.convolution(layer, before, scale);
      if (shrinks) {
        builder.average_pool(layer.name + " average pooling", before, place);
      } else {
        builder.rescale(layer.name + " concatenation", before, place);
      }
    }
  }

  Activation make_output(const ModuleWeights& module, const Activation& source, float scale) {
    const TensorShape& from = source.view().shape;
    return builder.make({module.outputs(), from.height / module.stride(), from.width / module.stride()},
                        source.view().type, scale);
  }

  /// Runs a stage's modules; the last one writes to `last` if it has a place.
  Activation add_stage(const std::vector<ModuleWeights>& modules, Activation source, float scale_after,
                       const Activation* last = nullptr) {
    for (std::size_t i = 0; i < modules.size(); ++i) {
      const bool is_last = i + 1 == modules.size();
      const float scale = is_last ? scale_after : builder.input_scale(modules[i + 1].blocks[0]);
      const Activation target = is_last && last != nullptr ? *last : make_output(modules[i], source, scale);
      add_module(modules[i], source, target);
      source = target;
    }
    return source;
  }

  void add_stages(const NetworkWeights& weights, const Activation& stage2) {
    const TensorShape from = stage2.view().shape;
    const int channels3 = weights.stages[0].back().outputs(), channels4 = weights.head4.outputs;
    const float fusion_scale = builder.input_scale(weights.fusion);
    // What the fusion reads: stage 3 and the context, concatenated. With fp32 both are made in their places.
    const Activation joined = builder.make({channels3 + channels4, from.height / 2, from.width / 2},
                                           stage2.view().type, fusion_scale);
    const Activation place3 = NetworkBuilder::slice(joined, 0, channels3);
    const Activation stage3 =
        add_stage(weights.stages[0], stage2, builder.input_scale(weights.stages[1][0].blocks[0]),
                  builder.is_int8() ? nullptr : &place3);
    if (builder.is_int8()) builder.rescale("ffm concatenation", stage3, place3);
    const float scale4 = std::max(builder.input_scale(weights.stages[2][0].blocks[0]),
                                  builder.input_scale(weights.refinement4.convolution));
    const Activation stage4 = add_stage(weights.stages[1], stage3, scale4);
    const Activation stage5 =
        add_stage(weights.stages[2], stage4, builder.input_scale(weights.refinement5.convolution));
    add_context(weights, stage4, stage5, NetworkBuilder::slice(joined, channels3, channels4));
    add_head(weights, joined);
  }

  /// Attention refinement: the convolution's output and the gain of each channel.
  std::pair<Activation, ChannelVector> add_refinement(const AttentionRefinementWeights& layers,
                                                      const Activation& source) {
    const Activation feature = builder.convolution(layers.convolution, source, 0);
    const ChannelVector average = builder.global_average(layers.convolution.name + " average", feature);
    return {feature, builder.dense(layers.attention, average, sigmoid)};
  }

  /// The input of a head: the refined feature, upsampled twice, in the head's scale.
  Activation add_upsampled(const std::string& name, const Activation& feature, ChannelVector gain,
                           ChannelVector offset, const Activation* addend, const ConvolutionWeights& head) {
    const TensorShape& shape = feature.view().shape;
    const Activation target =
        builder.make({shape.channels, 2 * shape.height, 2 * shape.width},
                     builder.is_int8() ? ElementType::u8 : ElementType::f32, builder.input_scale(head));
    builder.combine(name, feature, gain, offset, addend, target);
    return target;
  }

  void add_context(const NetworkWeights& weights, const Activation& stage4, const Activation& stage5,
                   const Activation& target) {
    const ChannelVector average = builder.global_average("context average", stage5);
    const ChannelVector pool = builder.dense(weights.context_pool, average, rectified);
    const auto [feature5, gain5] = add_refinement(weights.refinement5, stage5);
    const Activation up5 = add_upsampled("context.up5", feature5, gain5, pool, nullptr, weights.head5);
    const Activation context5 = builder.convolution(weights.head5, up5, 0);
    const auto [feature4, gain4] = add_refinement(weights.refinement4, stage4);
    const ChannelVector nothing = builder.make_vector(weights.head5.outputs);
    const Activation up4 = add_upsampled("context.up4", feature4, gain4, nothing, &context5, weights.head4);
    if (builder.is_int8()) {
      builder.rescale("context concatenation", builder.convolution(weights.head4, up4, target.scale), target);
    } else {
      builder.convolution_into(weights.head4, up4, target);
    }
  }

  void add_head(const NetworkWeights& weights, const Activation& joined) {
    const Activation feature = builder.convolution(weights.fusion, joined, 0);
    const ChannelVector average = builder.global_average("ffm average", feature);
    const ChannelVector squeezed = builder.dense(weights.squeeze, average, rectified);
    const ChannelVector gain = builder.dense(weights.excite, squeezed, one_plus_sigmoid);
    const Activation refined =
        builder.make(feature.view().shape, joined.view().type, builder.input_scale(weights.head));
    builder.combine("ffm attention", feature, gain, builder.make_vector(weights.fusion.outputs), nullptr,
                    refined);
    const Activation head = builder.convolution(weights.head, refined, 0);
    logits = {builder.classify(weights.classify, head), classes, head.view().shape.height,
              head.view().shape.width};
  }

  Logits run() {
    const ThreadStateGuard scope(threads);
    for (const PlannedStep& step : builder.steps()) step.run();
    return logits;
  }

  NetworkPrecision precision;
  int threads, classes;
  NetworkBuilder builder;
  NetworkInput input;
  Logits logits;
  std::vector<NetworkStep> about;
};

StdcNetwork::StdcNetwork(const NetworkWeights& weights, cv::Size input, NetworkPrecision precision,
                         int threads) {
  check_input_size(input, "size of the network's input");
  ThreadStateGuard::check(threads);
  const ThreadStateGuard scope(threads);  // kernels are made for this number of threads
  implementation_ = std::make_unique<Implementation>(weights, input, precision, threads);
  for (const PlannedStep& step : implementation_->builder.steps()) {
    implementation_->about.push_back(step.about);
  }
}

StdcNetwork::~StdcNetwork() = default;

cv::Size StdcNetwork::input_size() const { return implementation_->input.size(); }
NetworkPrecision StdcNetwork::precision() const { return implementation_->precision; }
const std::vector<NetworkStep>& StdcNetwork::steps() const { return implementation_->about; }
std::size_t StdcNetwork::activation_bytes() const { return implementation_->builder.activation_bytes(); }

Logits StdcNetwork::run(const cv::Mat& bgr) {
  implementation_->input.set(bgr);
  return implementation_->run();
}

Logits StdcNetwork::run(std::span<const float> normalised) {
  implementation_->input.set(normalised);
  return implementation_->run();
}

std::vector<double> StdcNetwork::profile() {
  const ThreadStateGuard scope(implementation_->threads);
  std::vector<double> milliseconds;
  for (const PlannedStep& step : implementation_->builder.steps()) {
    const double before = thread_cpu_ms();
    step.run();
    milliseconds.push_back(thread_cpu_ms() - before);
  }
  return milliseconds;
}

}  // namespace stdc
