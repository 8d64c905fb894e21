#include "simulation/scene/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stdc::simulation {
namespace {

constexpr double kFullTurn = 2 * std::numbers::pi;
using Eigen::Vector2d;
using Eigen::Vector3d;

}  // namespace

Pose placed(double x, double y, double z, double yaw_radians) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw_radians, Vector3d::UnitZ())), Vector3d(x, y, z)};
}

void ShapeBuilder::vertex(const Vector3d& position, const Vector3d& normal, const Eigen::Vector2f& uv) {
  mesh_.positions.push_back((world_from_local * position).cast<float>());
  mesh_.normals.push_back((world_from_local.rotation * normal).normalized().cast<float>());
  mesh_.uvs.push_back(uv);
}

Eigen::Vector2f ShapeBuilder::tiling_offset() {
  const auto u = static_cast<float>(random_.uniform()), v = static_cast<float>(random_.uniform());
  return {u, v};
}

Eigen::Vector2f ShapeBuilder::texture_at(const Finish& finish, const Eigen::Vector2f& offset, double s,
                                         double t, double width, double height) const {
  if (finish.picture) {
    const PictureArea& p = *finish.picture;
    return {p.u0 + static_cast<float>(s) * (p.u1 - p.u0), p.v1 - static_cast<float>(t) * (p.v1 - p.v0)};
  }
  const float tile = materials_[finish.material].tile;
  return offset +
         Eigen::Vector2f(static_cast<float>(s * width) / tile, static_cast<float>(-t * height) / tile);
}

void ShapeBuilder::rectangle(const Vector3d& corner, const Vector3d& s_edge, const Vector3d& t_edge,
                             const Finish& finish) {
  const Vector3d normal = s_edge.cross(t_edge);
  const Eigen::Vector2f offset = tiling_offset();
  for (int t = 0; t <= 1; ++t) {
    for (int s = 0; s <= 1; ++s) {
      vertex(corner + s * s_edge + t * t_edge, normal,
             texture_at(finish, offset, s, t, s_edge.norm(), t_edge.norm()));
    }
  }
  mesh_.finish_patch(1, 1, finish.material);
}

void ShapeBuilder::box(const Vector3d& base, const Vector3d& size, const BoxFinish& finish) {
  const Vector3d x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
  const Vector3d low = base - 0.5 * x - 0.5 * y, high = low + x + y + z;
  const std::array<std::array<Vector3d, 3>, 6> faces{
      {{low, x, z}, {low + x, y, z}, {high - z, -x, z}, {low + y, -y, z}, {low + z, x, y}, {low + y, x, -y}}};
  for (int i = 0; i < 6; ++i) {
    if (finish[i].material >= 0) rectangle(faces[i][0], faces[i][1], faces[i][2], finish[i]);
  }
}

void ShapeBuilder::box(const Vector3d& base, const Vector3d& size, const Finish& finish) {
  box(base, size, BoxFinish{finish, finish, finish, finish, finish, finish});
}

void ShapeBuilder::revolve(const Vector3d& base, const std::vector<Vector2d>& profile, int segments,
                           const Finish& finish) {
  constexpr double kSmoothCosine = 0.766;  // 40 degrees
  const Eigen::Vector2f offset = tiling_offset();
  const auto outward = [&](std::size_t i) -> Vector2d {  // of the piece from point i to i + 1
    const Vector2d d = profile[i + 1] - profile[i];
    return Vector2d(d.y(), -d.x()).normalized();
  };
  double total = 0, radius = 0;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) total += (profile[i + 1] - profile[i]).norm();
  for (const Vector2d& p : profile) radius = std::max(radius, p.x());
  double along = 0;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const Vector2d here = outward(i);
    Vector2d first = here, last = here;
    if (i > 0 && outward(i - 1).dot(here) > kSmoothCosine) first = outward(i - 1) + here;
    if (i + 2 < profile.size() && outward(i + 1).dot(here) > kSmoothCosine) last = outward(i + 1) + here;
    const double next = along + (profile[i + 1] - profile[i]).norm();
    for (int end = 0; end <= 1; ++end) {
      const Vector2d& p = profile[i + end];
      const Vector2d n = (end == 0 ? first : last).normalized();
      for (int k = 0; k <= segments; ++k) {
        const double angle = kFullTurn * k / segments, c = std::cos(angle), s = std::sin(angle);
        vertex(base + Vector3d(p.x() * c, p.x() * s, p.y()), Vector3d(n.x() * c, n.x() * s, n.y()),
               texture_at(finish, offset, static_cast<double>(k) / segments,
                          (end == 0 ? along : next) / total, kFullTurn * radius, total));
      }
    }
    mesh_.finish_patch(segments, 1, finish.material);
    along = next;
  }
}

void ShapeBuilder::cylinder(const Vector3d& base, double radius, double height, const Finish& side,
                            const Finish& ends, int segments) {
  constexpr double kCentre = 1e-4;  // a pole without a hole would need triangles
  revolve(base, {{radius, 0}, {radius, height}}, segments, side);
  revolve(base, {{radius, height}, {kCentre, height}}, segments, ends);
  revolve(base, {{kCentre, 0}, {radius, 0}}, segments, ends);
}

void ShapeBuilder::ellipsoid(const Vector3d& centre, const Vector3d& radii, const Finish& finish,
                             int segments) {
  const Eigen::Vector2f offset = tiling_offset();
  const int rows = std::max(4, segments / 2);
  for (int r = 0; r <= rows; ++r) {
    const double latitude = std::numbers::pi * (static_cast<double>(r) / rows - 0.5);
    for (int k = 0; k <= segments; ++k) {
      const double longitude = kFullTurn * k / segments;
      const Vector3d unit(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                          std::sin(latitude));
      vertex(centre + unit.cwiseProduct(radii), unit.cwiseQuotient(radii),
             texture_at(finish, offset, static_cast<double>(k) / segments, static_cast<double>(r) / rows,
                        kFullTurn * radii.x(), std::numbers::pi * radii.z()));
    }
  }
  mesh_.finish_patch(segments, rows, finish.material);
}

void ShapeBuilder::rod(const std::vector<Vector3d>& points, double radius, const Finish& finish, int sides) {
  const Eigen::Vector2f offset = tiling_offset();
  const int last = static_cast<int>(points.size()) - 1;
  double length = 0, along = 0;
  for (int i = 0; i < last; ++i) length += (points[i + 1] - points[i]).norm();
  Vector3d side = (points[1] - points[0]).unitOrthogonal();
  for (int i = 0; i <= last; ++i) {
    const Vector3d tangent = (points[std::min(i + 1, last)] - points[std::max(i - 1, 0)]).normalized();
    side = (side - tangent * tangent.dot(side)).normalized();  // carried along without twist
    const Vector3d across = tangent.cross(side);
    if (i > 0) along += (points[i] - points[i - 1]).norm();
    for (int k = 0; k <= sides; ++k) {
      const double angle = kFullTurn * k / sides;
      const Vector3d out = std::cos(angle) * side + std::sin(angle) * across;
      vertex(points[i] + radius * out, out,
             texture_at(finish, offset, static_cast<double>(k) / sides, along / length, kFullTurn * radius,
                        length));
    }
  }
  mesh_.finish_patch(sides, last, finish.material);
}

void ShapeBuilder::sheet(const std::vector<std::vector<Vector3d>>& rows, const Finish& finish) {
  const Eigen::Vector2f offset = tiling_offset();
  const int last_row = static_cast<int>(rows.size()) - 1, last_column = static_cast<int>(rows[0].size()) - 1;
  double width = 0, height = 0;
  for (int c = 0; c < last_column; ++c) width += (rows[0][c + 1] - rows[0][c]).norm();
  for (int r = 0; r < last_row; ++r) height += (rows[r + 1][0] - rows[r][0]).norm();
  for (int r = 0; r <= last_row; ++r) {
    for (int c = 0; c <= last_column; ++c) {
      const Vector3d along = rows[r][std::min(c + 1, last_column)] - rows[r][std::max(c - 1, 0)];
      const Vector3d up = rows[std::min(r + 1, last_row)][c] - rows[std::max(r - 1, 0)][c];
      vertex(rows[r][c], along.cross(up),
             texture_at(finish, offset, static_cast<double>(c) / last_column,
                        static_cast<double>(r) / last_row, width, height));
    }
  }
  mesh_.finish_patch(last_column, last_row, finish.material);
}

}  // namespace stdc::simulation
