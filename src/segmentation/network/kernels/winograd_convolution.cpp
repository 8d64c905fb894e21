#include "segmentation/network/kernels/winograd_convolution.hpp"

#include <algorithm>
#include <array>

#include "segmentation/network/kernels/winograd_kernel.hpp"

namespace stdc {
namespace {

/// G g G^T of F(4, 3) for one 3x3 filter.
std::array<double, kWinogradPoints> transform_filter(const float* filter) {
  constexpr double g[6][3] = {{1.0 / 4, 0, 0},
                              {-1.0 / 6, -1.0 / 6, -1.0 / 6},
                              {-1.0 / 6, 1.0 / 6, -1.0 / 6},
                              {1.0 / 24, 1.0 / 12, 1.0 / 6},
                              {1.0 / 24, -1.0 / 12, 1.0 / 6},
                              {0, 0, 1}};
  std::array<double, kWinogradPoints> result{};
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      for (std::size_t tap = 0; tap < 9; ++tap) {
        result[6 * i + j] += g[i][tap / 3] * static_cast<double>(filter[tap]) * g[j][tap % 3];
      }
    }
  }
  return result;
}

/// Tiles that are worked on together: their transformed inputs of one point should stay in the first cache.
int tiles_at_once(int inputs, int tiles) {
  constexpr int kFloats = 6144, kRows = 6, kFewest = 2 * kRows, kMax = 32 * kRows;
  return std::min(tiles, std::clamp(kFloats / inputs / kRows * kRows, kFewest, kMax));
}

}  // namespace

struct WinogradConvolution::Implementation {
  WinogradJob job;
  int tiles = 0, at_once = 0;
  std::shared_ptr<void> memory;
};

bool WinogradConvolution::suits(const ConvolutionWeights& layer, const TensorView& source,
                                const TensorView& target) {
  const auto fits = [](const TensorView& view) {
    return view.type == ElementType::f32 && view.block == kWinogradStrip;
  };
  return layer.kernel == 3 && layer.stride == 1 && fits(source) && fits(target);
}

WinogradConvolution::WinogradConvolution(const ConvolutionWeights& layer, const TensorView& source,
                                         const TensorView& target)
    : implementation_(std::make_unique<Implementation>()) {
  Implementation& own = *implementation_;
  const auto inputs = static_cast<std::size_t>(layer.inputs),
             outputs = static_cast<std::size_t>(layer.outputs);
  const auto count = [](int size) { return (size + kWinogradTile - 1) / kWinogradTile; };
  own.tiles = count(target.shape.height) * count(target.shape.width);
  own.at_once = tiles_at_once(layer.inputs, own.tiles);

  constexpr std::size_t kApart = 16;  // so that the points do not all fall into the same lines of the cache
  own.job.input_stride = static_cast<std::size_t>(own.at_once) * inputs + kApart;
  own.job.output_stride = static_cast<std::size_t>(own.at_once) * outputs + kApart;
  const std::size_t weights_size = kWinogradPoints * inputs * outputs;
  own.memory = aligned_memory(
      (weights_size + outputs + kWinogradPoints * (own.job.input_stride + own.job.output_stride)) *
      sizeof(float));
  float* const weights = static_cast<float*>(own.memory.get());
  float* const bias = weights + weights_size;
  std::copy(layer.bias.begin(), layer.bias.end(), bias);
  for (std::size_t o = 0; o < outputs; ++o) {
    for (std::size_t i = 0; i < inputs; ++i) {
      const auto points = transform_filter(&layer.weights[(o * inputs + i) * 9]);
      for (std::size_t p = 0; p < points.size(); ++p) {
        const std::size_t strip = p * (outputs / kWinogradStrip) + o / kWinogradStrip;
        weights[(strip * inputs + i) * kWinogradStrip + o % kWinogradStrip] = static_cast<float>(points[p]);
      }
    }
  }
  own.job.source = source;
  own.job.target = target;
  own.job.weights = weights;
  own.job.bias = bias;
  own.job.inputs = bias + outputs;
  own.job.outputs = own.job.inputs + kWinogradPoints * own.job.input_stride;
}

WinogradConvolution::~WinogradConvolution() = default;

void WinogradConvolution::run() {
  WinogradJob job = implementation_->job;
  for (int first = 0; first < implementation_->tiles; first += implementation_->at_once) {
    job.first_tile = first;
    job.tiles = std::min(implementation_->at_once, implementation_->tiles - first);
    run_winograd(job);
  }
}

}  // namespace stdc
