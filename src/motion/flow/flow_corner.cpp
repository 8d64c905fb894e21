#include "motion/flow/flow_corner.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace stdc {
namespace {

constexpr int kReach = 3;  // of the window of the tensor [cells]

/// Sum of the products of gradients around a cell, on its own surface, for a mean cell.
Eigen::Matrix2d structure(const SmallFrame& frame, int x, int y) {
  const SmallImage& image = frame.levels[0];
  const int stride = image.stride();
  const float depth = frame.depth_at(x, y), same = same_surface(depth);
  int xx = 0, xy = 0, yy = 0;
  for (int v = std::max(y - kReach, 0); v <= std::min(y + kReach, frame.height() - 1); ++v) {
    const std::uint8_t* row = image.row(v);
    for (int u = std::max(x - kReach, 0); u <= std::min(x + kReach, frame.width() - 1); ++u) {
      const float there = frame.depth_at(u, v);
      if (depth != 0 && there != 0 && std::abs(there - depth) > same) continue;
      const int dx = row[u + 1] - row[u - 1], dy = row[u + stride] - row[u - stride];
      xx += dx * dx;
      xy += dx * dy;
      yy += dy * dy;
    }
  }
  constexpr double kCells = 4.0 * (2 * kReach + 1) * (2 * kReach + 1);  // 4: differences across two cells
  Eigen::Matrix2d tensor;
  tensor << xx, xy, xy, yy;
  return tensor / kCells;
}

double smaller_eigenvalue(const Eigen::Matrix2d& tensor) {
  const double middle = 0.5 * tensor.trace(), difference = 0.5 * (tensor(0, 0) - tensor(1, 1));
  return middle - std::sqrt(difference * difference + tensor(0, 1) * tensor(0, 1));
}

}  // namespace

float same_surface(float depth) { return std::max(0.04F, 0.06F * depth); }

bool find_corner(const SmallFrame& frame, const cv::Rect& square, FlowCorner& corner) {
  constexpr double kMinContrast = 6, kSharp = 60;  // [grey levels^2 per cell^2]
  double best = kMinContrast;
  Eigen::Matrix2d tensor;
  for (int y = square.y; y < square.br().y; y += 2) {
    for (int x = square.x; x < square.br().x; x += 2) {
      const Eigen::Matrix2d here = structure(frame, x, y);
      const double value = smaller_eigenvalue(here);
      if (value <= best) continue;
      best = value;
      tensor = here;
      corner.at = {x, y};
    }
  }
  if (best <= kMinContrast) return false;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeDirect(tensor);
  const Eigen::Vector2d values = (solver.eigenvalues() / kSharp).cwiseMin(1);
  corner.certainty = solver.eigenvectors() * values.asDiagonal() * solver.eigenvectors().transpose();
  return true;
}

}  // namespace stdc
