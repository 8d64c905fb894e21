#include "dense/mesh/covered_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dense/mesh/nearest_point.hpp"

namespace stdc {
namespace {

constexpr std::uint32_t kNoPoint = ~std::uint32_t{0};

float mean_edge(const std::vector<Eigen::Vector3f>& positions,
                const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  double sum = 0;
  for (const auto& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) sum += (positions[t[k]] - positions[t[(k + 1) % 3]]).norm();
  }
  return static_cast<float>(sum / std::max(1.0, 3.0 * static_cast<double>(triangles.size())));
}

}  // namespace

NewTriangle::NewTriangle(std::uint32_t face_index, const std::array<Eigen::Vector3f, 3>& corners,
                         const std::array<Eigen::Vector3f, 3>& corner_colours)
    : face(face_index),
      first(corners[0]),
      second(corners[1] - corners[0]),
      third(corners[2] - corners[0]),
      normal(second.cross(third)),
      colours(corner_colours) {}

CoveredPoints::CoveredPoints(TriangleMesh mesh, float tolerance, float colour_tolerance)
    : positions_(std::move(mesh.positions)),
      normals_(std::move(mesh.normals)),
      colours_(std::move(mesh.colours)),
      tolerance_(tolerance),
      colour_tolerance_(colour_tolerance),
      spacing_(mean_edge(positions_, mesh.triangles)),
      heads_(mesh.triangles.size(), kNoPoint),
      next_(positions_.size(), kNoPoint) {
  std::vector<bool> held(positions_.size(), false);
  for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
    for (const std::uint32_t point : mesh.triangles[f]) {
      if (held[point]) continue;
      held[point] = true;
      next_[point] = heads_[f];
      heads_[f] = point;
    }
  }
}

int CoveredPoints::holder_of(std::uint32_t point, const std::vector<NewTriangle>& triangles) const {
  const Eigen::Vector3f& position = positions_[point];
  const Eigen::Vector3f& normal = normals_[point];
  int best = -1;
  Barycentric best_at;
  float best_square = tolerance_ * tolerance_;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const NewTriangle& triangle = triangles[i];
    if (!(triangle.normal.dot(normal) > 0)) continue;
    const Eigen::Vector3f offset = position - triangle.first;
    const Barycentric at = nearest_in_triangle(offset, triangle.second, triangle.third);
    const float square = (offset - at.second * triangle.second - at.third * triangle.third).squaredNorm();
    if (square > best_square || (square == best_square && best >= 0)) continue;
    best = static_cast<int>(i), best_at = at, best_square = square;
  }
  if (best < 0 || colours_.empty()) return best;
  const auto& corners = triangles[static_cast<std::size_t>(best)].colours;
  const Eigen::Vector3f colour =
      corners[0] + best_at.second * (corners[1] - corners[0]) + best_at.third * (corners[2] - corners[0]);
  for (int c = 0; c < 3; ++c) {
    const auto own = static_cast<float>(colours_[point][static_cast<std::size_t>(c)]);
    if (std::abs(own - colour[c]) > colour_tolerance_) return -1;
  }
  return best;
}

/// Distances of points from triangles say nothing of a spike between them.
bool CoveredPoints::near_points(const Eigen::Vector3f& apex) const {
  constexpr float kSpacings = 1.5F;
  std::uint32_t nearest = kNoPoint;
  float square = std::numeric_limits<float>::max();
  for (const std::uint32_t point : points_) {
    const float own = (positions_[point] - apex).squaredNorm();
    if (own < square) nearest = point, square = own;
  }
  if (nearest == kNoPoint) return true;
  const float reach = tolerance_ + kSpacings * spacing_;
  return square <= reach * reach && std::abs(normals_[nearest].dot(positions_[nearest] - apex)) <= tolerance_;
}

bool CoveredPoints::hand_over(const std::vector<std::uint32_t>& old_faces,
                              const std::vector<NewTriangle>& triangles, const Eigen::Vector3f& apex) {
  points_.clear(), holders_.clear();
  // The points that begin a face's list are those that have refused before: it is likely that they do again.
  for (const std::uint32_t face : old_faces) {
    if (heads_[face] != kNoPoint && holder_of(heads_[face], triangles) < 0) return false;
  }
  for (const std::uint32_t face : old_faces) {
    for (std::uint32_t point = heads_[face]; point != kNoPoint; point = next_[point])
      points_.push_back(point);
  }
  if (!near_points(apex)) return false;
  for (const std::uint32_t face : old_faces) {
    std::uint32_t* link = &heads_[face];
    for (; *link != kNoPoint; link = &next_[*link]) {
      const int holder = holder_of(*link, triangles);
      holders_.push_back(holder);
      if (holder >= 0) continue;
      const std::uint32_t point = *link;
      *link = next_[point], next_[point] = heads_[face], heads_[face] = point;
      return false;
    }
  }
  for (const std::uint32_t face : old_faces) heads_[face] = kNoPoint;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    std::uint32_t& head = heads_[triangles[static_cast<std::size_t>(holders_[i])].face];
    next_[points_[i]] = head;
    head = points_[i];
  }
  return true;
}

}  // namespace stdc
