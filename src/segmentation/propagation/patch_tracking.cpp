#include "segmentation/propagation/patch_tracking.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace stdc {
namespace {

using Eigen::Vector2f;

constexpr int kPatchSide = 8, kHalf = 4, kPixels = kPatchSide * kPatchSide;
constexpr float kFine = 0.04F, kCoarse = 0.15F;  // steps that end a search [px]
using Patch = std::array<float, kPixels>;

/// Sums eight columns, then the eight sums: the order that a compiler can vectorise without changing it.
template <typename Term>
float sum_of(Term&& term) {
  std::array<float, kPatchSide> columns{};
  for (int row = 0; row < kPixels; row += kPatchSide) {
    for (int i = 0; i < kPatchSide; ++i) columns[i] += term(row + i);
  }
  float sum = 0;
  for (const float column : columns) sum += column;
  return sum;
}

/// How much each pixel of a patch counts: 1 where the depth is that of the middle, little where it is
/// missing, 0 on other surfaces and outside the image.
void weigh(const SmallFrame& frame, cv::Point at, int level, float same_surface, Patch& weights) {
  constexpr float kUnknown = 0.3F;
  const float middle = frame.depth_at(at.x, at.y);
  const int step = 1 << level;
  for (int row = 0; row < kPatchSide; ++row) {
    const int y = at.y + (row - kHalf) * step;
    float* out = weights.data() + row * kPatchSide;
    for (int i = 0; i < kPatchSide; ++i) {
      const int x = at.x + (i - kHalf) * step;
      if (!frame.contains(x, y)) {
        out[i] = 0;
        continue;
      }
      const float depth = frame.depth_at(x, y);
      out[i] = depth == 0 || middle == 0 ? kUnknown : (std::abs(depth - middle) < same_surface ? 1.0F : 0.0F);
    }
  }
}

/// A patch of one level, prepared for the search.
class PatchSearch {
 public:
  /// False if it has too little texture in some direction.
  bool make(const SmallImage& image, cv::Point at, const Patch& weights) {
    for (int row = 0; row < kPatchSide; ++row) {
      const std::uint8_t* from = image.row(at.y + row - kHalf) + at.x - kHalf;
      const std::uint8_t *above = from - image.stride(), *below = from + image.stride();
      for (int i = 0; i < kPatchSide; ++i) {
        values_[row * kPatchSide + i] = from[i];
        x_[row * kPatchSide + i] = 0.5F * static_cast<float>(from[i + 1] - from[i - 1]);
        y_[row * kPatchSide + i] = 0.5F * static_cast<float>(below[i] - above[i]);
      }
    }
    const float total = sum_of([&](int i) { return weights[i]; });
    const Patch& w = weights;
    constexpr float kMinTotal = 8;
    if (total < kMinTotal) return false;
    const float mean = sum_of([&](int i) { return w[i] * values_[i]; }) / total;
    const float mean_x = sum_of([&](int i) { return w[i] * x_[i]; }) / total;
    const float mean_y = sum_of([&](int i) { return w[i] * y_[i]; }) / total;
    // Without their means the gradients are blind to a change of brightness; the weights go into them.
    for (int i = 0; i < kPixels; ++i) {
      values_[i] -= mean;
      x_[i] -= mean_x;
      y_[i] -= mean_y;
    }
    const float xx = sum_of([&](int i) { return w[i] * x_[i] * x_[i]; });
    const float xy = sum_of([&](int i) { return w[i] * x_[i] * y_[i]; });
    const float yy = sum_of([&](int i) { return w[i] * y_[i] * y_[i]; });
    for (int i = 0; i < kPixels; ++i) {
      x_[i] *= w[i];
      y_[i] *= w[i];
    }
    const float difference = 0.5F * (xx - yy);
    const float smaller = 0.5F * (xx + yy) - std::sqrt(difference * difference + xy * xy);
    constexpr float kMinInformation = 2;  // smaller eigenvalue per pixel (Shi and Tomasi, CVPR 1994)
    if (!(smaller > kMinInformation * total)) return false;
    const float determinant = xx * yy - xy * xy;
    inverse_ = {yy / determinant, -xy / determinant, xx / determinant};
    weights_ = &weights;
    total_ = total;
    return true;
  }

  /// Moves `flow` [px of the level] to where `image` looks like the patch at `at`, in steps until they are
  /// small. False if it diverges.
  bool find(const SmallImage& image, cv::Point at, float reach, float small_step, Vector2f& flow) {
    constexpr int kMaxSteps = 6;
    Vector2f now = flow;
    for (int i = 0; i < kMaxSteps; ++i) {
      if (!look(image, at, now)) return false;
      const float x = sum_of([&](int k) { return x_[k] * seen_[k]; });
      const float y = sum_of([&](int k) { return y_[k] * seen_[k]; });
      const Vector2f step(inverse_[0] * x + inverse_[1] * y, inverse_[1] * x + inverse_[2] * y);
      now -= step;
      if (!((now - flow).squaredNorm() <= reach * reach)) return false;
      if (step.squaredNorm() < small_step * small_step) break;
    }
    flow = now;
    return true;
  }

  /// Whether the image looks like the patch there: what is left is noise or a small part of its contrast.
  bool looks_alike(const SmallImage& image, cv::Point at, const Vector2f& flow) {
    constexpr float kNoise = 30, kShare = 0.3F;  // variances [grey levels squared]; share
    if (!look(image, at, flow)) return false;
    const Patch& w = *weights_;
    const float mean = sum_of([&](int i) { return w[i] * seen_[i]; }) / total_;
    const float left = sum_of([&](int i) { return w[i] * (seen_[i] - mean) * (seen_[i] - mean); }) / total_;
    const float contrast = sum_of([&](int i) { return w[i] * values_[i] * values_[i]; }) / total_;
    return left < std::max(kNoise, kShare * contrast);
  }

 private:
  /// Differences of the image there to the patch; false if the patch's middle is outside.
  bool look(const SmallImage& image, cv::Point at, const Vector2f& flow) {
    const float x = static_cast<float>(at.x) + flow.x(), y = static_cast<float>(at.y) + flow.y();
    if (!(x >= 0 && y >= 0 && x <= static_cast<float>(image.width() - 1) &&
          y <= static_cast<float>(image.height() - 1))) {
      return false;
    }
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    const float w00 = (1 - fx) * (1 - fy), w01 = fx * (1 - fy), w10 = (1 - fx) * fy, w11 = fx * fy;
    for (int row = 0; row < kPatchSide; ++row) {
      const std::uint8_t* upper = image.row(y0 + row - kHalf) + x0 - kHalf;
      const std::uint8_t* lower = upper + image.stride();
      float* out = seen_.data() + row * kPatchSide;
      const float* values = values_.data() + row * kPatchSide;
      for (int i = 0; i < kPatchSide; ++i) {
        out[i] = w00 * static_cast<float>(upper[i]) + w01 * static_cast<float>(upper[i + 1]) +
                 w10 * static_cast<float>(lower[i]) + w11 * static_cast<float>(lower[i + 1]) - values[i];
      }
    }
    return true;
  }

  Patch values_, x_, y_, seen_;
  std::array<float, 3> inverse_{};  ///< of the information: xx, xy, yy
  const Patch* weights_ = nullptr;
  float total_ = 0;
};

bool follow_back(const SmallFrame& from, const SmallFrame& to, cv::Point at, const Vector2f& flow,
                 float same_surface) {
  constexpr float kReach = 2, kClose = 0.7F;  // [cells]
  const cv::Point there(static_cast<int>(std::lround(static_cast<float>(at.x) + flow.x())),
                        static_cast<int>(std::lround(static_cast<float>(at.y) + flow.y())));
  if (!to.contains(there.x, there.y)) return false;
  Patch weights;
  weigh(to, there, 0, same_surface, weights);
  PatchSearch search;
  Vector2f back = -flow;
  return search.make(to.levels[0], there, weights) &&
         search.find(from.levels[0], there, kReach, kFine, back) &&
         (back + flow).squaredNorm() < kClose * kClose;
}

}  // namespace

bool follow_patch(const SmallFrame& from, const SmallFrame& to, cv::Point at, Vector2f& flow,
                  float same_surface) {
  constexpr float kReach = 4;  // [px of the level]
  Patch weights;
  PatchSearch search;
  Vector2f now = flow;
  // With a guess the coarsest level is not needed.
  const int coarsest = flow.isZero() ? SmallFrame::kLevels - 1 : SmallFrame::kLevels - 2;
  for (int level = coarsest; level >= 0; --level) {
    const auto size = static_cast<float>(1 << level);
    const cv::Point there(at.x >> level, at.y >> level);
    const SmallImage &image = from.levels[static_cast<std::size_t>(level)],
                     &other = to.levels[static_cast<std::size_t>(level)];
    if (there.x >= image.width() || there.y >= image.height()) continue;
    weigh(from, at, level, same_surface, weights);
    Vector2f scaled = now / size;
    const bool found = search.make(image, there, weights) &&
                       search.find(other, there, kReach, level == 0 ? kFine : kCoarse, scaled);
    if (found) now = scaled * size;
    if (!found && level == 0) return false;
  }
  if (!search.looks_alike(to.levels[0], at, now) || !follow_back(from, to, at, now, same_surface))
    return false;
  flow = now;
  return true;
}

}  // namespace stdc
