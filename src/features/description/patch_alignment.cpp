#include "features/description/patch_alignment.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace stdc {
namespace {

constexpr int kBordered = PatchTemplate::kSide + 2;  // one pixel around for the gradients
constexpr float kHalf = 0.5F * (PatchTemplate::kSide - 1);

/// Sums eight columns, then the eight sums: the order that a compiler can vectorise without changing it.
template <typename Term>
float sum_of(Term&& term) {
  std::array<float, PatchTemplate::kSide> columns{};
  for (int row = 0; row < PatchTemplate::kPixels; row += PatchTemplate::kSide) {
    for (int i = 0; i < PatchTemplate::kSide; ++i) columns[i] += term(row + i);
  }
  float sum = 0;
  for (const float column : columns) sum += column;
  return sum;
}

float bilinear(const Patch& patch, float x, float y) {
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  const std::uint8_t* p = patch.pixels.data() + y0 * Patch::kSide + x0;
  const float top = static_cast<float>(p[0]) + fx * static_cast<float>(p[1] - p[0]);
  const float bottom =
      static_cast<float>(p[Patch::kSide]) + fx * static_cast<float>(p[Patch::kSide + 1] - p[Patch::kSide]);
  return top + fy * (bottom - top);
}

}  // namespace

Patch cut_patch(const ImageView& level, int x, int y) {
  Patch patch;
  for (int row = 0; row < Patch::kSide; ++row) {
    const std::uint8_t* from = level.row(y - Patch::kCentre + row) + x - Patch::kCentre;
    std::copy(from, from + Patch::kSide, patch.pixels.begin() + row * Patch::kSide);
  }
  return patch;
}

bool PatchTemplate::make(const Patch& patch, const Eigen::Matrix2f& view_from_patch) {
  const float determinant = view_from_patch.determinant();
  if (!(std::abs(determinant) > 1e-3F)) return false;
  const Eigen::Matrix2f patch_from_view = view_from_patch.inverse();
  // The corners of the bordered square reach furthest.
  constexpr float kReach = kHalf + 1;
  const Eigen::Vector2f reach = patch_from_view.cwiseAbs() * Eigen::Vector2f(kReach, kReach);
  constexpr float kRoom = Patch::kSide - 1.001F - Patch::kCentre;
  if (!(reach.x() < kRoom && reach.y() < kRoom)) return false;

  std::array<float, kBordered * kBordered> bordered;
  for (int row = 0; row < kBordered; ++row) {
    for (int column = 0; column < kBordered; ++column) {
      const Eigen::Vector2f offset(static_cast<float>(column) - kReach, static_cast<float>(row) - kReach);
      const Eigen::Vector2f at = patch_from_view * offset;
      bordered[row * kBordered + column] = bilinear(patch, at.x() + Patch::kCentre, at.y() + Patch::kCentre);
    }
  }
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const float* centre = bordered.data() + (row + 1) * kBordered + column + 1;
      values_[row * kSide + column] = *centre;
      gradient_x_[row * kSide + column] = 0.5F * (centre[1] - centre[-1]);
      gradient_y_[row * kSide + column] = 0.5F * (centre[kBordered] - centre[-kBordered]);
    }
  }
  return derive();
}

bool PatchTemplate::derive() {
  const float mean = sum_of([&](int i) { return values_[i]; }) / kPixels;
  for (float& value : values_) value -= mean;
  const Row &x = gradient_x_, &y = gradient_y_, &v = values_;
  Eigen::Matrix4f hessian;
  hessian(0, 0) = sum_of([&](int i) { return x[i] * x[i]; });
  hessian(0, 1) = sum_of([&](int i) { return x[i] * y[i]; });
  hessian(0, 2) = sum_of([&](int i) { return x[i] * v[i]; });
  hessian(0, 3) = sum_of([&](int i) { return x[i]; });
  hessian(1, 1) = sum_of([&](int i) { return y[i] * y[i]; });
  hessian(1, 2) = sum_of([&](int i) { return y[i] * v[i]; });
  hessian(1, 3) = sum_of([&](int i) { return y[i]; });
  hessian(2, 2) = sum_of([&](int i) { return v[i] * v[i]; });
  hessian(2, 3) = 0;
  hessian(3, 3) = kPixels;
  hessian.triangularView<Eigen::StrictlyLower>() = hessian.transpose();
  variance_ = hessian(2, 2) / kPixels;
  // Least information about a shift, in any direction (the smaller eigenvalue; Shi and Tomasi, CVPR 1994):
  // below this noise of a few grey levels moves the template by a good part of a pixel.
  constexpr float kMinInformation = 8 * kPixels;
  const float half_trace = 0.5F * (hessian(0, 0) + hessian(1, 1));
  const float half_difference = 0.5F * (hessian(0, 0) - hessian(1, 1));
  const float smaller =
      half_trace - std::sqrt(half_difference * half_difference + hessian(0, 1) * hessian(0, 1));
  if (!(smaller > kMinInformation)) return false;
  bool invertible = false;
  hessian.computeInverseWithCheck(inverse_hessian_, invertible, 1e-3F);
  return invertible;
}

bool PatchTemplate::sample(const ImageView& level, const Eigen::Vector2f& position, Row& values) const {
  const float left = position.x() - kHalf, top = position.y() - kHalf;
  if (!(left >= 0 && top >= 0 && left + kSide < static_cast<float>(level.width - 1) &&
        top + kSide < static_cast<float>(level.height - 1))) {
    return false;
  }
  const int x0 = static_cast<int>(left), y0 = static_cast<int>(top);
  const float fx = left - static_cast<float>(x0), fy = top - static_cast<float>(y0);
  const float w00 = (1 - fx) * (1 - fy), w01 = fx * (1 - fy), w10 = (1 - fx) * fy, w11 = fx * fy;
  for (int row = 0; row < kSide; ++row) {
    const std::uint8_t* upper = level.row(y0 + row) + x0;
    const std::uint8_t* lower = upper + level.stride;
    float* out = values.data() + row * kSide;
    for (int i = 0; i < kSide; ++i) {
      out[i] = w00 * static_cast<float>(upper[i]) + w01 * static_cast<float>(upper[i + 1]) +
               w10 * static_cast<float>(lower[i]) + w11 * static_cast<float>(lower[i + 1]);
    }
  }
  return true;
}

bool PatchTemplate::align(const ImageView& level, float reach, Eigen::Vector2f& position) const {
  constexpr int kMaxIterations = 12;
  constexpr float kConverged = 0.02F;   // [px]
  constexpr float kMaxResidual = 0.3F;  // of the template's variance: a correlation of about 0.85
  Eigen::Vector2f at = position;
  Row seen;
  float gain = 1, offset = 0;
  bool first = true;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    if (!sample(level, at, seen)) return false;
    if (first) offset = sum_of([&](int i) { return seen[i]; }) / kPixels;
    first = false;
    for (int i = 0; i < kPixels; ++i) seen[i] -= gain * values_[i] + offset;
    const Eigen::Vector4f gradient(sum_of([&](int i) { return gradient_x_[i] * seen[i]; }),
                                   sum_of([&](int i) { return gradient_y_[i] * seen[i]; }),
                                   sum_of([&](int i) { return values_[i] * seen[i]; }),
                                   sum_of([&](int i) { return seen[i]; }));
    const Eigen::Vector4f step = inverse_hessian_ * gradient;
    at -= step.head<2>() / std::max(gain, 0.3F);
    gain += step[2];
    offset += step[3];
    if (!((at - position).squaredNorm() <= reach * reach) || !(gain > 0.3F && gain < 3)) return false;
    if (step.head<2>().squaredNorm() > kConverged * kConverged) continue;
    const float residual = sum_of([&](int i) { return seen[i] * seen[i]; }) / kPixels;
    if (residual > kMaxResidual * variance_ * gain * gain) return false;
    position = at;
    return true;
  }
  return false;
}

}  // namespace stdc
