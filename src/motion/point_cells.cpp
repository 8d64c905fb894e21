#include "motion/point_cells.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stdc {

std::vector<PointMotion> cells_around_points(const FrameFeatures& features,
                                             const std::vector<PointMotion>& motion,
                                             const GridGeometry& geometry, const DepthGrid& grid) {
  constexpr int kSpread = 12;  // [cells]
  constexpr float kJoint = 0.02F, kJointGrowth = 0.02F;
  std::vector<PointMotion> cells(grid.depth.size(), PointMotion::unknown);
  std::vector<int> front, next;
  const auto scale = static_cast<float>(geometry.scale());
  for (int i = 0; i < features.size(); ++i) {
    const PointMotion state = motion[static_cast<std::size_t>(i)];
    if (state == PointMotion::unknown) continue;
    const int x = static_cast<int>((features.keypoint(i).x + 0.5F) / scale);
    const int y = static_cast<int>((features.keypoint(i).y + 0.5F) / scale);
    if (x < 0 || y < 0 || x >= geometry.width() || y >= geometry.height()) continue;
    const int cell = geometry.cell_of_square()[geometry.index(x, y)];
    if (cell < 0 || grid.depth[static_cast<std::size_t>(cell)] == 0) continue;
    if (cells[static_cast<std::size_t>(cell)] == PointMotion::unknown) front.push_back(cell);
    cells[static_cast<std::size_t>(cell)] = state;
  }
  for (int round = 0; round < kSpread && !front.empty(); ++round, std::swap(front, next)) {
    next.clear();
    for (const int cell : front) {
      const int x = cell % geometry.width(), y = cell / geometry.width();
      const float depth = grid.depth[static_cast<std::size_t>(cell)];
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        if (x + dx < 0 || y + dy < 0 || x + dx >= geometry.width() || y + dy >= geometry.height()) continue;
        const std::size_t other = geometry.index(x + dx, y + dy);
        const bool linked =
            grid.depth[other] != 0 && std::abs(grid.depth[other] - depth) < kJoint + kJointGrowth * depth;
        if (!linked || cells[other] != PointMotion::unknown) continue;
        cells[other] = cells[static_cast<std::size_t>(cell)];
        next.push_back(static_cast<int>(other));
      }
    }
  }
  return cells;
}

}  // namespace stdc
