#include "dense/fusion/view_coverage.hpp"

#include <algorithm>
#include <cmath>

namespace stdc {

ViewCoverage::Cells ViewCoverage::cells_of(const FusedDepth& fused, const Pinhole& pinhole,
                                           const Pose& world_from_cam, MapId map) {
  constexpr int kStep = 12;         // [px]
  constexpr double kSide = 0.2;     // [m]
  constexpr int kMiddle = 1 << 16;  // coordinates have 17 bits: 13 km either way
  Cells cells;
  for (int y = kStep / 2; y < pinhole.height; y += kStep) {
    for (int x = kStep / 2; x < pinhole.width; x += kStep) {
      const float z = fused.depth.at<float>(y, x);
      if (!(z > 0) || fused.support.at<std::uint8_t>(y, x) == FusedDepth::kMoving) continue;
      const Eigen::Vector3d place = world_from_cam * pinhole.point(x, y, z).cast<double>() / kSide;
      // By octaves of distance: what is near shows more.
      const int scale = std::clamp(static_cast<int>(std::floor(std::log2(z))) + 4, 0, 15);
      std::uint64_t cell =
          (static_cast<std::uint64_t>(map.value & 255U) << 4U) | static_cast<unsigned>(scale);
      for (const double coordinate : place) {
        const int number = static_cast<int>(std::clamp(std::floor(coordinate), -60000.0, 60000.0)) + kMiddle;
        cell = (cell << 17U) | static_cast<std::uint64_t>(number);
      }
      cells.push_back(cell);
    }
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

void ViewCoverage::add(const Cells& cells) {
  for (const std::uint64_t cell : cells) ++counts_[cell];
}

void ViewCoverage::remove(const Cells& cells) {
  for (const std::uint64_t cell : cells) {
    const auto found = counts_.find(cell);
    if (found != counts_.end() && --found->second == 0) counts_.erase(found);
  }
}

bool ViewCoverage::is_redundant(const Cells& cells, int overlap) const {
  constexpr double kMaxRare = 0.03;
  const auto max_rare = static_cast<std::size_t>(kMaxRare * static_cast<double>(cells.size()));
  std::size_t rare = 0;
  for (const std::uint64_t cell : cells) {
    const auto found = counts_.find(cell);
    if (found != counts_.end() && found->second > overlap) continue;
    if (++rare > max_rare) return false;
  }
  return true;
}

}  // namespace stdc
