#pragma once

#include <optional>
#include <vector>

#include "dense/mesh/collapse_queue.hpp"
#include "dense/mesh/collapsible_mesh.hpp"
#include "dense/mesh/covered_points.hpp"
#include "dense/mesh/mesh_simplification.hpp"
#include "dense/mesh/quadric.hpp"

namespace stdc {

/// Collapses the edges of a mesh in the order of what that costs.
class EdgeCollapser {
 public:
  /// @param mesh  is used up
  EdgeCollapser(TriangleMesh mesh, const MeshSimplification& simplification);

  void run();
  /// What is left, without normals. Vertices and triangles in the order that they had.
  TriangleMesh result() const;

 private:
  using Index = CollapsibleMesh::Index;

  /// An edge of which a vertex stays, where it goes, and what that costs.
  struct Collapse {
    Index kept = 0, gone = 0;
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    double cost = 0;
  };

  void add_planes();
  void add_border_planes(Index face);
  void queue_edge(Index a, Index b);
  bool up_to_date(const CollapseCandidate& candidate) const;
  std::optional<Collapse> plan(Index a, Index b) const;
  bool try_collapse(const Collapse& collapse);
  std::optional<double> border_error(const Collapse& collapse) const;
  bool turns_none_over(const std::vector<Index>& staying, const Collapse& collapse) const;
  bool covers(const std::vector<Index>& staying, const Collapse& collapse, const Eigen::Vector3f& colour);
  Eigen::Vector3f colour_at(const Collapse& collapse) const;

  MeshSimplification simplification_;
  CollapsibleMesh mesh_;
  std::optional<CoveredPoints> points_;  ///< with a tolerance
  std::vector<Quadric> quadrics_;
  /// Twice the sum of the areas that each vertex stands for, as vectors: where the surface looked there.
  std::vector<Eigen::Vector3f> facings_;
  std::vector<Eigen::Vector3f> colours_;
  std::vector<double> border_errors_;  ///< how far the border beside a vertex may be from where it was [m]
  std::vector<std::uint32_t> changes_;
  CollapseQueue queue_;
  double metres_per_colour_ = 0;  ///< a difference in colour of 1 of 255 costs as much as this distance
};

}  // namespace stdc
