#include "dense/fusion/make_samples.hpp"

#include <algorithm>
#include <cstring>

#include "dense/fusion/depth_noise.hpp"
#include "dense/fusion/sample_kernel.hpp"

namespace stdc {
namespace {

constexpr int kBorder = SampleRow::kSlopeReach;
constexpr int kVector = 16;  ///< values that a kernel may read or write too many

void find_tile_maxima(const float* depths, ViewSamples& samples) {
  const int width = samples.pinhole.width, height = samples.pinhole.height;
  samples.tile_columns = (width + ViewSamples::kTile - 1) / ViewSamples::kTile;
  samples.tile_rows = (height + ViewSamples::kTile - 1) / ViewSamples::kTile;
  samples.tile_max.assign(static_cast<std::size_t>(samples.tile_columns * samples.tile_rows), 0);
  for (int y = 0; y < height; ++y) {
    const float* row = depths + static_cast<std::size_t>(y) * width;
    float* tiles =
        samples.tile_max.data() + static_cast<std::size_t>(y / ViewSamples::kTile * samples.tile_columns);
    for (int tile = 0; tile < samples.tile_columns; ++tile) {
      const int first = tile * ViewSamples::kTile;
      tiles[tile] = std::max(
          tiles[tile], *std::max_element(row + first, row + std::min(width, first + ViewSamples::kTile)));
    }
  }
}

}  // namespace

void make_samples(const FusedDepth& fused, const Pinhole& pinhole, int min_frames, SampleScratch& scratch,
                  ViewSamples& samples) {
  samples.pinhole = pinhole;
  const auto width = static_cast<std::size_t>(pinhole.width),
             height = static_cast<std::size_t>(pinhole.height);
  samples.depths.resize(width * height + kVector);
  samples.infos.resize(width * height + kVector);
  // With nothing all around, so that neighbours need no checks.
  const std::size_t stride = width + 2 * kBorder + kVector;
  std::vector<float>& padded = scratch.padded;
  std::vector<float>& rays = scratch.rays;
  std::vector<std::uint8_t>& support = scratch.support;
  padded.assign(stride * (height + 2 * kBorder) + kVector, 0.F);
  rays.assign(width + kVector, 0.F);
  support.assign(width + kVector, 0);
  const auto row = [&](std::size_t y) { return padded.data() + (y + kBorder) * stride + kBorder; };
  for (std::size_t y = 0; y < height; ++y) {
    std::memcpy(row(y), fused.depth.ptr<float>(static_cast<int>(y)), width * sizeof(float));
  }
  for (std::size_t x = 0; x < width; ++x) rays[x] = pinhole.ray_x(static_cast<float>(x));
  for (std::size_t y = 0; y < height; ++y) {
    std::memcpy(support.data(), fused.support.ptr<std::uint8_t>(static_cast<int>(y)), width);
    const float* middle = row(y);
    const auto by = [&](int rows) { return middle + rows * static_cast<std::ptrdiff_t>(stride); };
    sample_row({by(-kBorder), by(-1), middle, by(1), by(kBorder), support.data(), rays.data(),
                pinhole.ray_y(static_cast<float>(y)), pinhole.fx, pinhole.fy, pinhole.width, min_frames,
                samples.depths.data() + y * width, samples.infos.data() + y * width});
  }
  find_tile_maxima(samples.depths.data(), samples);
}

void make_depth_samples(const FusedDepth& fused, const Pinhole& pinhole, int min_frames,
                        SampleScratch& /*scratch*/, ViewSamples& samples) {
  samples.pinhole = pinhole;
  samples.depths.resize(fused.depth.total());
  const auto* z = fused.depth.ptr<float>();
  const auto* support = fused.support.ptr<std::uint8_t>();
  for (std::size_t i = 0; i < samples.depths.size(); ++i) {
    const int frames = support[i] & FusedDepth::kCount;
    samples.depths[i] = frames >= min_frames && is_known(z[i], frames) ? z[i] : 0;
  }
  find_tile_maxima(z, samples);
}

}  // namespace stdc
