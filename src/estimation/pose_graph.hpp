#pragma once

#include <cstdint>
#include <vector>

#include "core/pose.hpp"
#include "estimation/pose_graph_settings.hpp"

namespace stdc {

/// The measured pose of one node relative to another: exp(error) * a_from_b is the truth, with a normally
/// distributed error.
struct PoseGraphEdge {
  std::int32_t a = 0, b = 0;  ///< nodes, indices into the graph's list
  Pose a_from_b;
  /// Inverse covariance of the error (translation [m], rotation [rad]), which is one of frame a. Symmetric,
  /// positive semi-definite.
  Matrix6d information = Matrix6d::Identity();
  bool robust = false;  ///< Huber kernel: an edge that may be wrong
};

/// Poses and the measured poses between them; solved in place.
struct PoseGraph {
  std::vector<Pose> node_from_world;  ///< cam_from_world, for keyframes
  std::vector<std::uint8_t> fixed;    ///< same length; if none is 1, the first node is taken as fixed
  std::vector<PoseGraphEdge> edges;
};

struct PoseGraphResult {
  bool usable = false;  ///< false: the graph is left as it was (nothing to solve, singular, not finite)
  int iterations = 0;
  double initial_cost = 0, final_cost = 0;  ///< half of the sum of the robust squared errors
};

/// Levenberg-Marquardt on SE(3) for the error log(a_from_b^-1 between the poses), that is
///
///     e = log(a_from_world * b_from_world^-1 * a_from_b^-1),
///
/// weighted with the edge's information (Grisetti, Kuemmerle, Stachniss and Burgard, 'A Tutorial on
/// Graph-Based SLAM', 2010; the essential graph that it is meant for: Mur-Artal, Montiel and Tardos,
/// 'ORB-SLAM', T-RO 2015, sec. VII; with RGB-D the scale is known, so SE(3) is enough). The normal equations
/// are solved as a block-sparse matrix in the order of approximate minimum degree, with the kernels of the
/// bundle adjustment: 500 nodes with 5,000 edges take some tens of milliseconds. Edges between fixed nodes,
/// from a node to itself or that are not finite are ignored. Nodes that no chain of edges connects to a fixed
/// one stay together as they are. Never throws; same input, same bytes. Single-threaded.
PoseGraphResult optimise_pose_graph(PoseGraph& graph, const PoseGraphSettings& settings = {});

}  // namespace stdc
