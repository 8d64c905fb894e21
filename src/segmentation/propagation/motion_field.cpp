#include "segmentation/propagation/motion_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "segmentation/propagation/patch_tracking.hpp"

namespace stdc {
namespace {

using Eigen::Vector2f;

constexpr float kSameBody = 0.4F;      // [m] two depths that may belong to one body
constexpr float kMaxApproach = 0.15F;  // [m] in a frame: 4.5 m/s

bool same_body(float a, float b) { return a == 0 || b == 0 || std::abs(a - b) < kSameBody; }

/// The pixel of the square with most contrast whose depth fits; false if none does.
bool choose_point(const SmallFrame& frame, cv::Rect square, float depth, cv::Point& chosen) {
  constexpr float kSameSurface = 0.3F;  // [m]
  int best = -1;
  for (int y = square.y; y < square.br().y; ++y) {
    const std::uint8_t* row = frame.levels[0].row(y);
    for (int x = square.x; x < square.br().x; ++x) {
      const float here = frame.depth_at(x, y);
      if (depth != 0 && !(here != 0 && std::abs(here - depth) < kSameSurface)) continue;
      const int stride = frame.levels[0].stride();
      const int contrast = std::abs(row[x + 1] - row[x - 1]) + std::abs(row[x + stride] - row[x - stride]);
      if (contrast <= best) continue;
      best = contrast;
      chosen = {x, y};
    }
  }
  return best >= 0;
}

/// The middle one of the values (the upper one of two).
float median(float* values, int count) {
  std::nth_element(values, values + count / 2, values + count);
  return values[count / 2];
}

}  // namespace

void MotionField::reset(int width, int height) {
  columns_ = (width + kBin - 1) / kBin;
  rows_ = (height + kBin - 1) / kBin;
  points_.assign(static_cast<std::size_t>(columns_ * rows_), Point());
  tried_.assign(points_.size(), 0);
}

void MotionField::cover(const std::vector<MaskTile>& tiles, const SmallFrame& from, const SmallFrame& to) {
  std::vector<Wish> wishes(points_.size());
  for (const MaskTile& tile : tiles) {
    const Vector2f middle = tile.middle();
    const int x = static_cast<int>(std::floor(middle.x())), y = static_cast<int>(std::floor(middle.y()));
    if (!from.contains(x, y)) continue;
    Wish& wish = wishes[static_cast<std::size_t>(y / kBin * columns_ + x / kBin)];
    // Where bodies overlap, the near one is what is seen.
    if (wish.wanted && (tile.depth == 0 || (wish.depth != 0 && wish.depth <= tile.depth))) continue;
    wish = {tile.depth, tile.velocity, true};
  }
  std::vector<std::size_t> fresh;
  for (std::size_t bin = 0; bin < wishes.size(); ++bin) {
    if (!wishes[bin].wanted || tried_[bin] != 0) continue;
    tried_[bin] = 1;
    follow(bin, wishes[bin], from, to);
    if (points_[bin].good) fresh.push_back(bin);
  }
  std::vector<std::size_t> wrong;
  for (const std::size_t bin : fresh) {
    if (!agrees(bin)) wrong.push_back(bin);
  }
  for (const std::size_t bin : wrong) points_[bin].good = false;
}

void MotionField::follow(std::size_t bin, const Wish& wish, const SmallFrame& from, const SmallFrame& to) {
  const int column = static_cast<int>(bin) % columns_, row = static_cast<int>(bin) / columns_;
  const cv::Rect square =
      cv::Rect(column * kBin, row * kBin, kBin, kBin) & cv::Rect(0, 0, from.width(), from.height());
  cv::Point at;
  if (!choose_point(from, square, wish.depth, at)) return;
  Point point;
  point.flow = wish.velocity;
  if (!follow_patch(from, to, at, point.flow)) return;
  point.good = true;
  point.position = Vector2f(static_cast<float>(at.x), static_cast<float>(at.y));
  point.depth = from.depth_at(at.x, at.y);
  const Vector2f end = point.position + point.flow;
  const int x = static_cast<int>(std::lround(end.x())), y = static_cast<int>(std::lround(end.y()));
  if (to.contains(x, y) && point.depth != 0) {
    const float there = to.depth_at(x, y);
    point.approach = there - point.depth;
    point.measured = there != 0 && std::abs(point.approach) < kMaxApproach;
  }
  points_[bin] = point;
}

/// The good points of a bin and those up to `ring` bins away.
template <typename Visit>
void MotionField::around(int column, int row, int ring, Visit&& visit) const {
  for (int y = std::max(row - ring, 0); y <= std::min(row + ring, rows_ - 1); ++y) {
    for (int x = std::max(column - ring, 0); x <= std::min(column + ring, columns_ - 1); ++x) {
      const Point& point = points_[static_cast<std::size_t>(y * columns_ + x)];
      if (point.good) visit(point);
    }
  }
}

/// Whether a point moves as most of the points around it on the same body do.
bool MotionField::agrees(std::size_t bin) const {
  constexpr int kRing = 2, kMax = (2 * kRing + 1) * (2 * kRing + 1), kFew = 3;
  constexpr float kTolerance = 1, kShare = 0.3F;  // [cells]; of the flow
  const Point& point = points_[bin];
  std::array<float, kMax> x, y;
  int count = 0;
  around(static_cast<int>(bin) % columns_, static_cast<int>(bin) / columns_, kRing, [&](const Point& other) {
    if (!same_body(point.depth, other.depth)) return;
    x[count] = other.flow.x();
    y[count++] = other.flow.y();
  });
  if (count <= kFew) return true;
  const Vector2f middle(median(x.data(), count), median(y.data(), count));
  return (point.flow - middle).norm() < kTolerance + kShare * middle.norm();
}

bool MotionField::at(const Vector2f& position, float depth, Motion& motion) const {
  return mean_around(position, depth, 1, motion) || mean_around(position, depth, 3, motion);
}

bool MotionField::mean_around(const Vector2f& position, float depth, int ring, Motion& motion) const {
  constexpr float kDepthScale = 0.15F;                           // [m]
  const float reach = (static_cast<float>(ring) + 0.5F) * kBin;  // [cells]
  const float per_reach = 1 / (reach * reach);
  float total = 0, total_approach = 0, approach = 0;
  Vector2f flow = Vector2f::Zero();
  const int column = static_cast<int>(std::floor(position.x() / kBin));
  const int row = static_cast<int>(std::floor(position.y() / kBin));
  around(column, row, ring, [&](const Point& point) {
    if (!same_body(depth, point.depth)) return;
    const float distance = (point.position - position).squaredNorm() * per_reach;
    if (distance >= 1) return;
    const float apart = depth == 0 || point.depth == 0 ? 1 : (depth - point.depth) / kDepthScale;
    // The near points far outweigh the others, but all fade to nothing at the end of the reach.
    const float fade = (1 - distance) * (1 - distance);
    const float weight = fade / ((0.05F + distance) * (1 + apart * apart));
    total += weight;
    flow += weight * point.flow;
    if (!point.measured) return;
    total_approach += weight;
    approach += weight * point.approach;
  });
  constexpr float kMin = 0.01F;
  if (!(total > kMin)) return false;
  motion.flow = flow / total;
  motion.approach = total_approach > kMin ? approach / total_approach : 0;
  return true;
}

}  // namespace stdc
