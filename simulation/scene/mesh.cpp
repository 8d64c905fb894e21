#include "simulation/scene/mesh.hpp"

#include <cassert>

namespace stdc::simulation {

void Mesh::finish_patch(int columns, int rows, int material) {
  const std::size_t count = static_cast<std::size_t>(columns + 1) * (rows + 1);
  assert(columns > 0 && rows > 0 && positions.size() >= count);
  assert(positions.size() == normals.size() && positions.size() == uvs.size());
  Patch patch;
  patch.first_vertex = static_cast<std::uint32_t>(positions.size() - count);
  patch.first_quad = static_cast<std::uint32_t>(quads.size());
  patch.columns = static_cast<std::uint16_t>(columns);
  patch.rows = static_cast<std::uint16_t>(rows);
  patch.material = static_cast<std::uint16_t>(material);
  const auto stride = static_cast<std::uint32_t>(columns + 1);
  double width = 0, height = 0;
  for (std::uint32_t r = 0; r < static_cast<std::uint32_t>(rows); ++r) {
    for (std::uint32_t c = 0; c < static_cast<std::uint32_t>(columns); ++c) {
      const std::uint32_t v = patch.first_vertex + r * stride + c;
      quads.push_back({v, v + 1, v + stride + 1, v + stride});
      patch_of_quad.push_back(static_cast<std::uint32_t>(patches.size()));
      width += (positions[v + 1] - positions[v]).norm();
      height += (positions[v + stride] - positions[v]).norm();
    }
  }
  patch.width = static_cast<float>(width / rows);
  patch.height = static_cast<float>(height / columns);
  patches.push_back(patch);
}

int Mesh::move_within(const Eigen::AlignedBox3f& region, const Pose& new_from_old) {
  const Eigen::Matrix3f rotation = new_from_old.rotation_matrix().cast<float>();
  const Eigen::Vector3f translation = new_from_old.translation.cast<float>();
  int moved = 0;
  for (const Patch& patch : patches) {
    const std::size_t first = patch.first_vertex,
                      last = first + static_cast<std::size_t>(patch.columns + 1) * (patch.rows + 1);
    bool inside = true;
    for (std::size_t v = first; v < last && inside; ++v) inside = region.contains(positions[v]);
    if (!inside) continue;
    ++moved;
    for (std::size_t v = first; v < last; ++v) {
      positions[v] = rotation * positions[v] + translation;
      normals[v] = rotation * normals[v];
    }
  }
  return moved;
}

}  // namespace stdc::simulation
