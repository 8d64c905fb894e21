#include "dense/mesh/collapsible_mesh.hpp"

#include <algorithm>
#include <iterator>

namespace stdc {

CollapsibleMesh::CollapsibleMesh(const std::vector<Eigen::Vector3f>& positions, std::vector<Face> faces)
    : faces_(std::move(faces)), faces_of_(faces_, positions.size()), faces_left_(faces_.size()) {
  positions_.reserve(positions.size());
  for (const Eigen::Vector3f& position : positions) positions_.emplace_back(position.cast<double>());
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
  for (const Index f : faces_of(vertex)) {
    for (const Index other : faces_[f]) {
      if (other != vertex) found.push_back(other);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

int CollapsibleMesh::faces_at_edge(Index a, Index b) const {
  int count = 0;
  for (const Index f : faces_of(a)) count += contains(f, b) ? 1 : 0;
  return count;
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
  std::vector<Index> vanish;
  for (const Index f : faces_of(gone)) {
    if (contains(f, kept)) {
      vanish.push_back(f);
    } else {
      std::replace(faces_[f].begin(), faces_[f].end(), gone, kept);
    }
  }
  for (const Index f : vanish) {
    for (const Index vertex : faces_[f]) faces_of_.remove(vertex, f);
    faces_[f].fill(kNone);
    --faces_left_;
  }
  faces_of_.append(kept, gone);
}

}  // namespace stdc
