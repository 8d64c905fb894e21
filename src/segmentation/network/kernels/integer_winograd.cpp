#include "segmentation/network/kernels/integer_winograd.hpp"

#include <algorithm>
#include <array>

#include "segmentation/network/kernels/direct_convolution.hpp"
#include "segmentation/network/kernels/integer_winograd_kernel.hpp"
#include "segmentation/network/kernels/quantised_weights.hpp"

namespace stdc {
namespace {

constexpr int kInputStep = 16;  // input channels that are transformed together

/// 2 G of F(2, 3) applied to three numbers, `step` apart; four come out, `step` apart.
template <typename T>
void transform_three(const T* from, int step, int* to) {
  const int a = from[0], b = from[step], c = from[2 * step];
  to[0] = 2 * a, to[step] = a + b + c, to[2 * step] = a - b + c, to[3 * step] = 2 * c;
}

/// 4 G g G^T of F(2, 3) for one 3x3 filter: whole numbers of at most 9 * 127.
std::array<std::int16_t, kIntegerWinogradPoints> transform_integer_filter(const std::int8_t* filter) {
  std::array<int, 12> columns{};  // 4 x 3
  for (int x = 0; x < 3; ++x) transform_three(filter + x, 3, &columns[static_cast<std::size_t>(x)]);
  std::array<std::int16_t, kIntegerWinogradPoints> result{};
  for (std::size_t y = 0; y < 4; ++y) {
    std::array<int, 4> row{};
    transform_three(&columns[3 * y], 1, row.data());
    for (std::size_t x = 0; x < 4; ++x) result[4 * y + x] = static_cast<std::int16_t>(row[x]);
  }
  return result;
}

/// Tiles that are worked on together: their transformed inputs of one point should stay in the first cache,
/// all their sums in the second.
int integer_tiles_at_once(int inputs, int outputs, int tiles) {
  constexpr int kInputs = 12288, kOutputs = 16384, kRows = 6, kFewest = 2 * kRows;
  const int fit = std::min(kInputs / inputs, kOutputs / outputs);
  return std::min(tiles, std::max(fit / kRows * kRows, kFewest));
}

template <typename T>
T* take(std::byte*& from, std::size_t count) {
  T* const place = reinterpret_cast<T*>(from);
  from += (count * sizeof(T) + 63) / 64 * 64;
  return place;
}

}  // namespace

struct IntegerWinograd::Implementation {
  IntegerWinogradJob job;
  int tiles = 0, at_once = 0;
  std::shared_ptr<void> memory;  ///< of the weights
  std::shared_ptr<Scratch> scratch;

  void set_weights(const ConvolutionWeights& layer, const std::vector<std::int8_t>& levels,
                   std::int16_t* to) const {
    const auto inputs = static_cast<std::size_t>(layer.inputs),
               outputs = static_cast<std::size_t>(layer.outputs);
    constexpr std::size_t kStrip = kIntegerWinogradStrip;
    for (std::size_t o = 0; o < outputs; ++o) {
      for (std::size_t i = 0; i < inputs; ++i) {
        const auto points = transform_integer_filter(&levels[(o * inputs + i) * 9]);
        const std::size_t place = (o / kStrip * inputs + i / 2 * 2) * kStrip + o % kStrip * 2 + i % 2;
        for (std::size_t p = 0; p < points.size(); ++p) to[p * inputs * outputs + place] = points[p];
      }
    }
  }
};

bool IntegerWinograd::fits(const ConvolutionWeights& layer, const TensorView& source,
                           const TensorView& target) {
  // 4 * 255 * 127 * 9 * kMaxInputs < 2^31
  constexpr int kMaxInputs = 1840;
  return layer.kernel == 3 && layer.stride == 1 && source.type == ElementType::u8 && source.channels_last() &&
         target.channels_last() && layer.inputs <= kMaxInputs && layer.inputs % kInputStep == 0 &&
         layer.outputs % kIntegerWinogradStrip == 0;
}

bool IntegerWinograd::suits(const ConvolutionWeights& layer, const TensorView& source,
                            const TensorView& target) {
  constexpr int kAllLevels = 255;  // the processor has VNNI
  // The transformed weights have 3.6 times as many bytes: with fewer outputs it takes as long to fetch them.
  constexpr std::size_t kMinOutputs = 256;
  if (target.shape.pixels() < kMinOutputs) return false;
  if (DirectConvolution::has_dot_products(source) && !DnnlEngine::has_fast_kernels()) return false;
  return fits(layer, source, target) &&
         (DnnlEngine::activation_levels() < kAllLevels || !DnnlEngine::has_fast_kernels());
}

IntegerWinograd::IntegerWinograd(const ConvolutionWeights& layer, const TensorView& source,
                                 const TensorView& target, const ConvolutionOptions& options,
                                 std::shared_ptr<Scratch> scratch)
    : implementation_(std::make_unique<Implementation>()) {
  Implementation& own = *implementation_;
  const auto inputs = static_cast<std::size_t>(layer.inputs),
             outputs = static_cast<std::size_t>(layer.outputs);
  const auto count = [](int size) { return (size + kIntegerWinogradTile - 1) / kIntegerWinogradTile; };
  own.tiles = count(target.shape.height) * count(target.shape.width);
  own.at_once = integer_tiles_at_once(layer.inputs, layer.outputs, own.tiles);
  constexpr std::size_t kApart = 32, kRoom = 8 * 64;  // not all points in the same lines of the cache
  own.job.input_stride = static_cast<std::size_t>(own.at_once) * inputs + kApart;
  own.job.output_stride = static_cast<std::size_t>(own.at_once) * outputs + kApart;
  const std::size_t needed = kIntegerWinogradPoints * (own.job.input_stride * sizeof(std::int16_t) +
                                                       own.job.output_stride * sizeof(std::int32_t)) +
                             kRoom;
  own.scratch = std::move(scratch);
  if (needed > own.scratch->bytes) *own.scratch = {needed, aligned_memory(needed)};
  own.memory = aligned_memory(kIntegerWinogradPoints * inputs * outputs * sizeof(std::int16_t) + inputs +
                              kRoom + 2 * outputs * sizeof(float));
  std::byte* free = static_cast<std::byte*>(own.memory.get());
  auto* const weights = take<std::int16_t>(free, kIntegerWinogradPoints * inputs * outputs);
  auto* const zeros = take<std::uint8_t>(free, inputs);
  auto* const bias = take<float>(free, outputs);
  auto* const scale = take<float>(free, outputs);
  std::fill_n(zeros, inputs, std::uint8_t{0});
  const QuantisedWeights quantised = quantise(layer, options.weight_levels);
  own.set_weights(layer, quantised.levels, weights);
  const float target_scale = target.type == ElementType::u8 ? options.target_scale : 1;
  for (std::size_t o = 0; o < outputs; ++o) {
    scale[o] = options.source_scale * quantised.scales[o] / target_scale;
    bias[o] = layer.bias[o] / (scale[o] * target_scale);
  }
  own.job.source = source, own.job.target = target;
  own.job.weights = weights, own.job.zeros = zeros, own.job.bias = bias, own.job.scale = scale;
}

IntegerWinograd::~IntegerWinograd() = default;

void IntegerWinograd::run() {
  IntegerWinogradJob job = implementation_->job;
  // Looked up now: a later layer may have needed more.
  std::byte* free = static_cast<std::byte*>(implementation_->scratch->memory.get());
  job.inputs = take<std::int16_t>(free, kIntegerWinogradPoints * job.input_stride);
  job.outputs = take<std::int32_t>(free, kIntegerWinogradPoints * job.output_stride);
  for (int first = 0; first < implementation_->tiles; first += implementation_->at_once) {
    job.first_tile = first;
    job.tiles = std::min(implementation_->at_once, implementation_->tiles - first);
    run_integer_winograd(job);
  }
}

}  // namespace stdc
