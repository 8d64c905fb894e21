#include "triangle_index.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace stdc {
namespace {

Eigen::Vector3f nearest_on_segment(const Eigen::Vector3f& p, const Eigen::Vector3f& a,
                                   const Eigen::Vector3f& b) {
  const Eigen::Vector3f ab = b - a;
  const float length = ab.squaredNorm();
  const float t = length > 0 ? std::clamp(ab.dot(p - a) / length, 0.F, 1.F) : 0.F;
  return a + t * ab;
}

Eigen::Vector3f nearest_on(const Eigen::Vector3f& p, const TriangleIndex::Triangle& t) {
  const Eigen::Vector3f normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const float area = normal.squaredNorm();
  bool inside = area > 0;
  for (int k = 0; k < 3; ++k) inside = inside && (t[(k + 1) % 3] - t[k]).cross(p - t[k]).dot(normal) >= 0;
  if (inside) return p - normal * ((p - t[0]).dot(normal) / area);
  Eigen::Vector3f best = t[0];
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3f point = nearest_on_segment(p, t[k], t[(k + 1) % 3]);
    if ((p - point).squaredNorm() < (p - best).squaredNorm()) best = point;
  }
  return best;
}

}  // namespace

TriangleIndex::Key TriangleIndex::key_of(const Eigen::Vector3f& point) const {
  return {static_cast<int>(std::floor(point.x() / cell_)), static_cast<int>(std::floor(point.y() / cell_)),
          static_cast<int>(std::floor(point.z() / cell_))};
}

TriangleIndex::TriangleIndex(std::vector<Triangle> triangles, float cell)
    : triangles_(std::move(triangles)), cell_(cell) {
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    const Triangle& t = triangles_[i];
    const Key low = key_of(t[0].cwiseMin(t[1]).cwiseMin(t[2])),
              high = key_of(t[0].cwiseMax(t[1]).cwiseMax(t[2]));
    for (int z = low[2]; z <= high[2]; ++z) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int x = low[0]; x <= high[0]; ++x) cells_[{x, y, z}].push_back(i);
      }
    }
  }
}

TriangleIndex::Nearest TriangleIndex::find(const Eigen::Vector3f& point, float limit) const {
  const Key middle = key_of(point);
  Nearest best{limit};
  const auto try_cell = [&](const Key& key) {
    const auto cell = cells_.find(key);
    if (cell == cells_.end()) return;
    for (const std::uint32_t i : cell->second) {
      const Triangle& t = triangles_[i];
      const Eigen::Vector3f on = nearest_on(point, t);
      const float distance = (point - on).norm();
      if (distance < best.distance) best = {distance, on, (t[1] - t[0]).cross(t[2] - t[0]).normalized()};
    }
  };
  // Shells of cells around the point's own: what lies in the n-th is n - 1 cells away or more.
  for (int shell = 0; static_cast<float>(shell - 1) * cell_ < best.distance; ++shell) {
    for (int z = -shell; z <= shell; ++z) {
      for (int y = -shell; y <= shell; ++y) {
        const bool wall = std::abs(z) == shell || std::abs(y) == shell;
        for (int x = -shell; x <= shell; x += wall ? 1 : std::max(1, 2 * shell)) {
          try_cell({middle[0] + x, middle[1] + y, middle[2] + z});
        }
      }
    }
  }
  return best;
}

}  // namespace stdc
