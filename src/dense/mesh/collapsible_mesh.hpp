#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "dense/mesh/face_lists.hpp"

namespace stdc {

/// A mesh of which edges can be collapsed: their two vertices become one. Knows which triangles meet at a
/// vertex, and where the surface ends.
class CollapsibleMesh {
 public:
  using Index = std::uint32_t;
  using Face = std::array<Index, 3>;

  /// @param positions  of the vertices [m]
  CollapsibleMesh(const std::vector<Eigen::Vector3f>& positions, std::vector<Face> faces);

  const Eigen::Vector3d& position(Index vertex) const { return positions_[vertex]; }
  const Face& face(Index face) const { return faces_[face]; }
  FaceLists::List faces_of(Index vertex) const { return faces_of_.of(vertex); }
  std::size_t vertex_count() const { return positions_.size(); }
  std::size_t face_count() const { return faces_.size(); }
  std::size_t faces_left() const { return faces_left_; }
  /// The surface ends at this vertex.
  bool on_border(Index vertex) const { return kinds_[vertex] != Kind::inner; }
  /// The surface is not one piece around this vertex, which must stay.
  bool pinned(Index vertex) const { return kinds_[vertex] == Kind::pinned; }

  /// Vertices that share an edge with one, in rising order.
  std::vector<Index> neighbours(Index vertex) const;
  /// Triangles at an edge.
  int faces_at_edge(Index a, Index b) const;
  /// The vertices where the border goes on from a vertex of it; two if it is not pinned.
  std::vector<Index> along_border(Index vertex) const;

  /// The surface has as many pieces and holes after the collapse as before (the link condition: Dey et al.,
  /// 'Topology preserving edge contraction', 1999).
  bool keeps_topology(Index kept, Index gone) const;
  /// Makes one vertex of two. Faces at the edge vanish: their first vertex is kNone.
  void collapse(Index kept, Index gone, const Eigen::Vector3d& place);
  bool alive(Index face) const { return faces_[face][0] != kNone; }
  bool contains(Index face, Index vertex) const {
    return faces_[face][0] == vertex || faces_[face][1] == vertex || faces_[face][2] == vertex;
  }

  static constexpr Index kNone = ~Index{0};

 private:
  enum class Kind : std::uint8_t { inner, border, pinned };
  Kind kind_of(Index vertex) const;

  std::vector<Eigen::Vector3d> positions_;
  std::vector<Face> faces_;
  FaceLists faces_of_;
  std::vector<Kind> kinds_;
  std::size_t faces_left_ = 0;
};

}  // namespace stdc
