#include "simulation/people/surface_nets.hpp"

#include <algorithm>
#include <cmath>

namespace stdc::simulation {
namespace {

using Eigen::Vector3f;
using Eigen::Vector3i;

constexpr int kBlock =
    4;  // lattice points are computed in blocks of 4^3, most of which are far from the surface

/// The signed distance at the points of a lattice; far from the surface only its sign is right.
class Lattice {
 public:
  Lattice(const Solid& solid, float cell) : cell_(cell) {
    const Eigen::AlignedBox3f box = solid.bounds();
    low_ = box.min() - Vector3f::Constant(1.5F * cell);
    for (int i = 0; i < 3; ++i) {
      const int points = static_cast<int>(std::ceil((box.max()[i] - low_[i]) / cell)) + 3;
      size_[i] = (points + kBlock - 1) / kBlock * kBlock;
    }
    values_.resize(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2]);
    for (int z = 0; z < size_[2]; z += kBlock) {
      for (int y = 0; y < size_[1]; y += kBlock) {
        for (int x = 0; x < size_[0]; x += kBlock) fill_block(solid, {x, y, z});
      }
    }
  }

  const Vector3i& size() const { return size_; }
  Vector3f point(const Vector3i& at) const { return low_ + cell_ * at.cast<float>(); }
  std::size_t offset(const Vector3i& at) const {
    return (static_cast<std::size_t>(at[2]) * size_[1] + at[1]) * size_[0] + at[0];
  }
  float value(const Vector3i& at) const { return values_[offset(at)]; }

 private:
  void fill_block(const Solid& solid, const Vector3i& first) {
    const Vector3f middle = point(first) + Vector3f::Constant(0.5F * (kBlock - 1) * cell_);
    const float there = solid.distance(middle);
    // Distances of flattened ellipsoids are rough, hence the wide margin.
    const bool far = std::abs(there) > 1.7F * 0.866F * kBlock * cell_;
    for (int z = 0; z < kBlock; ++z) {
      for (int y = 0; y < kBlock; ++y) {
        for (int x = 0; x < kBlock; ++x) {
          const Vector3i at = first + Vector3i(x, y, z);
          values_[offset(at)] = far ? there : solid.distance(point(at));
        }
      }
    }
  }

  float cell_;
  Vector3f low_;
  Vector3i size_;
  std::vector<float> values_;
};

Vector3i corner(int i) { return {i & 1, i >> 1 & 1, i >> 2 & 1}; }

/// Mean of the points where the edges of a cell cross the surface, or false if none does.
bool crossing(const Lattice& lattice, const Vector3i& cell, Vector3f* mean) {
  Vector3f sum = Vector3f::Zero();
  int count = 0;
  for (int i = 0; i < 8; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      if ((i >> axis & 1) != 0) continue;
      const Vector3i a = cell + corner(i), b = a + Vector3i::Unit(axis);
      const float va = lattice.value(a), vb = lattice.value(b);
      if ((va < 0) == (vb < 0)) continue;
      sum += lattice.point(a) + (lattice.point(b) - lattice.point(a)) * (va / (va - vb));
      ++count;
    }
  }
  if (count == 0) return false;
  *mean = sum / static_cast<float>(count);
  return true;
}

}  // namespace

QuadSurface surface_of(const Solid& solid, float cell) {
  constexpr std::uint32_t kNone = ~0U;
  const Lattice lattice(solid, cell);
  const Vector3i size = lattice.size();
  QuadSurface surface;
  std::vector<std::uint32_t> vertex_of(static_cast<std::size_t>(size[0]) * size[1] * size[2], kNone);
  Vector3i at;
  for (at[2] = 0; at[2] + 1 < size[2]; ++at[2]) {
    for (at[1] = 0; at[1] + 1 < size[1]; ++at[1]) {
      for (at[0] = 0; at[0] + 1 < size[0]; ++at[0]) {
        Vector3f p;
        if (!crossing(lattice, at, &p)) continue;
        vertex_of[lattice.offset(at)] = static_cast<std::uint32_t>(surface.positions.size());
        for (int i = 0; i < 2; ++i) {
          const float d = std::clamp(solid.distance(p), -0.5F * cell, 0.5F * cell);
          p -= d * solid.normal(p);
        }
        surface.positions.push_back(p);
        surface.normals.push_back(solid.normal(p));
      }
    }
  }
  for (at[2] = 1; at[2] + 1 < size[2]; ++at[2]) {
    for (at[1] = 1; at[1] + 1 < size[1]; ++at[1]) {
      for (at[0] = 1; at[0] + 1 < size[0]; ++at[0]) {
        for (int axis = 0; axis < 3; ++axis) {
          // The four cells round a lattice edge that crosses the surface make a quad.
          const bool inside = lattice.value(at) < 0;
          if (inside == (lattice.value(at + Vector3i::Unit(axis)) < 0)) continue;
          const Vector3i u = Vector3i::Unit((axis + 1) % 3), v = Vector3i::Unit((axis + 2) % 3);
          std::array<std::uint32_t, 4> quad{vertex_of[lattice.offset(at - u - v)],
                                            vertex_of[lattice.offset(at - v)], vertex_of[lattice.offset(at)],
                                            vertex_of[lattice.offset(at - u)]};
          if (!inside) std::swap(quad[1], quad[3]);
          surface.quads.push_back(quad);
        }
      }
    }
  }
  return surface;
}

}  // namespace stdc::simulation
