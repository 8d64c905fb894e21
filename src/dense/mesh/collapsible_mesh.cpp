#include "dense/mesh/collapsible_mesh.hpp"

#include <algorithm>
#include <iterator>

namespace stdc {

CollapsibleMesh::CollapsibleMesh(const TriangleMesh& mesh)
    : faces_(mesh.triangles), faces_of_(mesh.positions.size()), faces_left_(mesh.triangles.size()) {
  positions_.reserve(mesh.positions.size());
  for (const Eigen::Vector3f& position : mesh.positions) positions_.emplace_back(position.cast<double>());
  for (Index f = 0; f < faces_.size(); ++f) {
    for (const Index vertex : faces_[f]) faces_of_[vertex].push_back(f);
  }
  kinds_.resize(positions_.size());
  for (Index vertex = 0; vertex < positions_.size(); ++vertex) kinds_[vertex] = kind_of(vertex);
}

CollapsibleMesh::Kind CollapsibleMesh::kind_of(Index vertex) const {
  int ends = 0;
  for (const Index other : neighbours(vertex)) {
    const int faces = faces_at_edge(vertex, other);
    if (faces > 2) return Kind::pinned;
    ends += faces == 1 ? 1 : 0;
  }
  if (ends == 0) return Kind::inner;
  return ends == 2 ? Kind::border : Kind::pinned;
}

std::vector<CollapsibleMesh::Index> CollapsibleMesh::neighbours(Index vertex) const {
  std::vector<Index> found;
  found.reserve(2 * faces_of_[vertex].size());
  for (const Index f : faces_of_[vertex]) {
    for (const Index other : faces_[f]) {
      if (other != vertex) found.push_back(other);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

int CollapsibleMesh::faces_at_edge(Index a, Index b) const {
  return static_cast<int>(
      std::count_if(faces_of_[a].begin(), faces_of_[a].end(), [&](Index f) { return contains(f, b); }));
}

std::vector<CollapsibleMesh::Index> CollapsibleMesh::along_border(Index vertex) const {
  std::vector<Index> found = neighbours(vertex);
  std::erase_if(found, [&](Index other) { return faces_at_edge(vertex, other) != 1; });
  return found;
}

bool CollapsibleMesh::keeps_topology(Index kept, Index gone) const {
  const int faces = faces_at_edge(kept, gone);
  if (faces < 1 || faces > 2) return false;
  if (on_border(kept) && on_border(gone) && faces != 1) return false;  // would pinch the surface
  const std::vector<Index> a = neighbours(kept), b = neighbours(gone);
  std::vector<Index> common;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
  if (static_cast<int>(common.size()) != faces) return false;
  // What is left around the vertex must be a surface: not a triangle seen from both sides.
  const std::size_t left = a.size() + b.size() - 2 - common.size();
  return left >= (on_border(kept) || on_border(gone) ? 2U : 3U);
}

void CollapsibleMesh::collapse(Index kept, Index gone, const Eigen::Vector3d& place) {
  positions_[kept] = place;
  if (kinds_[gone] != Kind::inner) kinds_[kept] = std::max(kinds_[kept], kinds_[gone]);
  for (const Index f : faces_of_[gone]) {
    if (!contains(f, kept)) {
      std::replace(faces_[f].begin(), faces_[f].end(), gone, kept);
      faces_of_[kept].push_back(f);
      continue;
    }
    for (const Index vertex : faces_[f]) {
      if (vertex != gone) std::erase(faces_of_[vertex], f);
    }
    faces_[f].fill(kNone);
    --faces_left_;
  }
  faces_of_[gone] = {};
}

}  // namespace stdc
