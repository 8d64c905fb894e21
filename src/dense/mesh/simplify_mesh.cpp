#include "dense/mesh/simplify_mesh.hpp"

#include <utility>

#include "dense/mesh/edge_collapser.hpp"
#include "dense/mesh/surface_extraction.hpp"

namespace stdc {

MeshSimplification simplification_of(const DenseSettings& settings) {
  return {settings.mesh_tolerance, settings.mesh_colour_tolerance,
          static_cast<std::size_t>(settings.mesh_triangles)};
}

void simplify_mesh(TriangleMesh& mesh, const MeshSimplification& simplification) {
  if (!simplification.active() || mesh.triangles.size() <= simplification.triangles) return;
  if (mesh.normals.size() != mesh.positions.size()) compute_normals(mesh);
  std::erase_if(mesh.triangles, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  EdgeCollapser collapser(std::exchange(mesh, {}), simplification);
  collapser.run();
  mesh = collapser.result();
  compute_normals(mesh);
}

}  // namespace stdc
