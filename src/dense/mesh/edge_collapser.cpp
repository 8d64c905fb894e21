#include "dense/mesh/edge_collapser.hpp"

#include <algorithm>
#include <cmath>

#include "dense/mesh/nearest_point.hpp"
#include "dense/mesh/triangle_shape.hpp"

namespace stdc {
namespace {

using Vertex = Eigen::Vector3d;

}  // namespace

EdgeCollapser::EdgeCollapser(TriangleMesh mesh, const MeshSimplification& simplification)
    : simplification_(simplification),
      mesh_(mesh.positions, mesh.triangles),
      quadrics_(mesh.positions.size()),
      facings_(mesh.positions.size(), Eigen::Vector3f::Zero()),
      border_errors_(mesh.positions.size(), 0),
      changes_(mesh.positions.size(), 0) {
  colours_.reserve(mesh.colours.size());
  for (const auto& colour : mesh.colours)
    colours_.emplace_back(Eigen::Vector3f(colour[0], colour[1], colour[2]));
  if (simplification.tolerance > 0) {
    points_.emplace(std::move(mesh), static_cast<float>(simplification.tolerance),
                    static_cast<float>(simplification.colour_tolerance));
  }
  mesh = {};  // here or there all is kept that is needed of it
  add_planes();
  queue_.reserve(mesh_.face_count() / 4 * 7 +
                 16);  // there are 3/2 as many edges as faces, and those at borders
  for (Index a = 0; a < mesh_.vertex_count(); ++a) {
    for (const Index b : mesh_.neighbours(a)) {
      if (a < b) queue_edge(a, b);
    }
  }
}

/// Each triangle's plane weighs by its area, which makes the sum independent of how finely a surface is cut.
void EdgeCollapser::add_planes() {
  double edges = 0;
  for (Index f = 0; f < mesh_.face_count(); ++f) {
    const auto& [a, b, c] = mesh_.face(f);
    const Vertex cross = (mesh_.position(b) - mesh_.position(a)).cross(mesh_.position(c) - mesh_.position(a));
    const double length = cross.norm();
    edges += std::sqrt(length);
    if (!(length > 0)) continue;
    const Quadric plane = Quadric::of_plane(cross / length, mesh_.position(a), length / 2);
    for (const Index vertex : mesh_.face(f)) {
      quadrics_[vertex] += plane;
      facings_[vertex] += cross.cast<float>();
    }
    add_border_planes(f);
  }
  // A strong edge in colour, 64 of 255, counts as an edge of a triangle's depth.
  constexpr double kStrong = 64;
  metres_per_colour_ = edges / std::max(1.0, static_cast<double>(mesh_.face_count())) / kStrong;
}

/// A plane through an edge where the surface ends, upright on its triangle, holds the border (Garland and
/// Heckbert, Sec. 6).
void EdgeCollapser::add_border_planes(Index face) {
  constexpr double kWeight = 10;
  for (std::size_t k = 0; k < 3; ++k) {
    const Index a = mesh_.face(face)[k], b = mesh_.face(face)[(k + 1) % 3], c = mesh_.face(face)[(k + 2) % 3];
    if (!mesh_.on_border(a) || !mesh_.on_border(b) || mesh_.faces_at_edge(a, b) != 1) continue;
    const Vertex along = mesh_.position(b) - mesh_.position(a),
                 across = mesh_.position(c) - mesh_.position(a);
    const Vertex normal = along.cross(across).cross(along).normalized();
    const Quadric plane = Quadric::of_plane(normal, mesh_.position(a), kWeight * along.squaredNorm());
    quadrics_[a] += plane;
    quadrics_[b] += plane;
  }
}

void EdgeCollapser::queue_edge(Index a, Index b) {
  const auto collapse = plan(std::min(a, b), std::max(a, b));
  if (!collapse) return;
  queue_.push({collapse->cost, std::min(a, b), std::max(a, b), changes_[a] + changes_[b]},
              [this](const CollapseCandidate& candidate) { return up_to_date(candidate); });
}

bool EdgeCollapser::up_to_date(const CollapseCandidate& candidate) const {
  return !mesh_.faces_of(candidate.a).empty() && !mesh_.faces_of(candidate.b).empty() &&
         candidate.changes == changes_[candidate.a] + changes_[candidate.b];
}

std::optional<EdgeCollapser::Collapse> EdgeCollapser::plan(Index a, Index b) const {
  Quadric sum = quadrics_[a];
  sum += quadrics_[b];
  Collapse collapse{a, b, Vertex::Zero(), 0};
  const auto rank = [&](Index vertex) {
    return (mesh_.on_border(vertex) ? 1 : 0) + (mesh_.pinned(vertex) ? 1 : 0);
  };
  if (rank(a) == 2 && rank(b) == 2) return std::nullopt;
  if (rank(a) == 0 && rank(b) == 0) {
    collapse.place = sum.best_near((mesh_.position(a) + mesh_.position(b)) / 2);
  } else {  // the border keeps vertices that it had
    const bool keep_a =
        rank(a) != rank(b) ? rank(a) > rank(b) : sum.error(mesh_.position(a)) <= sum.error(mesh_.position(b));
    if (!keep_a) std::swap(collapse.kept, collapse.gone);
    collapse.place = mesh_.position(collapse.kept);
  }
  // On a plane all costs nothing: then short edges go first, or there would be fans of a thousand triangles.
  constexpr double kLength = 1e-6;
  const double lesser = std::min(quadrics_[a].weight, quadrics_[b].weight);
  collapse.cost = sum.error(collapse.place) +
                  kLength * (mesh_.position(a) - mesh_.position(b)).squaredNorm() * sum.weight;
  if (!colours_.empty()) {
    const double difference = metres_per_colour_ * static_cast<double>((colours_[a] - colours_[b]).norm());
    collapse.cost += difference * difference * lesser;
  }
  return collapse;
}

void EdgeCollapser::run() {
  while (!queue_.empty() && mesh_.faces_left() > simplification_.triangles) {
    const CollapseCandidate next = queue_.pop();
    if (!up_to_date(next)) continue;
    const auto collapse = plan(next.a, next.b);
    if (!collapse || !try_collapse(*collapse)) continue;
    ++changes_[collapse->kept];
    for (const Index other : mesh_.neighbours(collapse->kept)) queue_edge(collapse->kept, other);
  }
}

bool EdgeCollapser::try_collapse(const Collapse& collapse) {
  if (!mesh_.keeps_topology(collapse.kept, collapse.gone)) return false;
  const auto border = border_error(collapse);
  if (!border) return false;
  std::vector<Index> staying;
  for (const Index f : mesh_.faces_of(collapse.kept)) {
    if (!mesh_.contains(f, collapse.gone)) staying.push_back(f);
  }
  for (const Index f : mesh_.faces_of(collapse.gone)) {
    if (!mesh_.contains(f, collapse.kept)) staying.push_back(f);
  }
  constexpr std::size_t kMaxFan = 32;
  if (staying.size() > kMaxFan || !turns_none_over(staying, collapse)) return false;
  const Eigen::Vector3f colour = colour_at(collapse);
  if (points_ && !covers(staying, collapse, colour)) return false;
  if (mesh_.on_border(collapse.gone)) {
    for (const Index other : mesh_.along_border(collapse.gone))
      border_errors_[other] = std::max(border_errors_[other], *border);
  }
  quadrics_[collapse.kept] += quadrics_[collapse.gone];
  facings_[collapse.kept] += facings_[collapse.gone];
  if (!colours_.empty()) colours_[collapse.kept] = colour;
  mesh_.collapse(collapse.kept, collapse.gone, collapse.place);
  return true;
}

/// How far the border will be from where it was; nothing if that is too far.
std::optional<double> EdgeCollapser::border_error(const Collapse& collapse) const {
  if (!mesh_.on_border(collapse.gone)) return 0.0;
  double error = 0;
  for (const Index other : mesh_.along_border(collapse.gone)) {
    if (other == collapse.kept) continue;
    error = std::max(
        error, distance_to_segment(mesh_.position(collapse.gone), mesh_.position(other), collapse.place));
  }
  error += border_errors_[collapse.gone];
  if (simplification_.tolerance > 0 && error > simplification_.tolerance) return std::nullopt;
  return error;
}

/// Neither in this step, nor little by little in many.
bool EdgeCollapser::turns_none_over(const std::vector<Index>& staying, const Collapse& collapse) const {
  constexpr double kMinCosine = 0.3, kMinShape = 0.02;
  const Eigen::Vector3f facing = facings_[collapse.kept] + facings_[collapse.gone];
  for (const Index f : staying) {
    std::array<Vertex, 3> before, after;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index vertex = mesh_.face(f)[k];
      before[k] = mesh_.position(vertex);
      after[k] = vertex == collapse.kept || vertex == collapse.gone ? collapse.place : before[k];
    }
    const Vertex old_normal = (before[1] - before[0]).cross(before[2] - before[0]),
                 new_normal = (after[1] - after[0]).cross(after[2] - after[0]);
    for (const Index vertex : mesh_.face(f)) {
      const bool moves = vertex == collapse.kept || vertex == collapse.gone;
      if (!(new_normal.cast<float>().dot(moves ? facing : facings_[vertex]) > 0)) return false;
    }
    if (new_normal.dot(old_normal) <= kMinCosine * new_normal.norm() * old_normal.norm()) return false;
    const double shape = shape_of(after[0], after[1], after[2]);
    if (shape < kMinShape && shape < shape_of(before[0], before[1], before[2])) return false;
  }
  return true;
}

bool EdgeCollapser::covers(const std::vector<Index>& staying, const Collapse& collapse,
                           const Eigen::Vector3f& colour) {
  std::vector<NewTriangle> triangles;
  triangles.reserve(staying.size());
  for (const Index f : staying) {
    std::array<Eigen::Vector3f, 3> corners, colours;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index vertex = mesh_.face(f)[k];
      const bool moves = vertex == collapse.kept || vertex == collapse.gone;
      corners[k] = (moves ? collapse.place : mesh_.position(vertex)).cast<float>();
      colours[k] = moves || colours_.empty() ? colour : colours_[vertex];
    }
    triangles.emplace_back(f, corners, colours);
  }
  const FaceLists::List kept_faces = mesh_.faces_of(collapse.kept);
  std::vector<Index> old_faces(kept_faces.begin(), kept_faces.end());
  for (const Index f : mesh_.faces_of(collapse.gone)) {
    if (!mesh_.contains(f, collapse.kept)) old_faces.push_back(f);
  }
  return points_->hand_over(old_faces, triangles, collapse.place.cast<float>());
}

Eigen::Vector3f EdgeCollapser::colour_at(const Collapse& collapse) const {
  if (colours_.empty()) return Eigen::Vector3f::Zero();
  const Vertex from = mesh_.position(collapse.kept), along = mesh_.position(collapse.gone) - from;
  const double length = along.squaredNorm();
  const auto t =
      static_cast<float>(length > 0 ? std::clamp((collapse.place - from).dot(along) / length, 0.0, 1.0) : 0);
  return colours_[collapse.kept] + t * (colours_[collapse.gone] - colours_[collapse.kept]);
}

TriangleMesh EdgeCollapser::result() const {
  TriangleMesh mesh;
  std::vector<Index> numbers(mesh_.vertex_count(), CollapsibleMesh::kNone);
  for (Index vertex = 0; vertex < mesh_.vertex_count(); ++vertex) {
    if (mesh_.faces_of(vertex).empty()) continue;
    numbers[vertex] = static_cast<Index>(mesh.positions.size());
    mesh.positions.emplace_back(mesh_.position(vertex).cast<float>());
    if (colours_.empty()) continue;
    const Eigen::Vector3f& colour = colours_[vertex];
    const auto rounded = [&](int c) { return static_cast<std::uint8_t>(std::lround(colour[c])); };
    mesh.colours.push_back({rounded(0), rounded(1), rounded(2)});
  }
  mesh.triangles.reserve(mesh_.faces_left());
  for (Index f = 0; f < mesh_.face_count(); ++f) {
    if (!mesh_.alive(f)) continue;
    const auto& [a, b, c] = mesh_.face(f);
    mesh.triangles.push_back({numbers[a], numbers[b], numbers[c]});
  }
  return mesh;
}

}  // namespace stdc
