#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/pose.hpp"
#include "core/random.hpp"
#include "simulation/scene/material.hpp"
#include "simulation/scene/mesh.hpp"

namespace stdc::simulation {

/// Part of a bitmap: (u0, v0) top left, (u1, v1) bottom right.
struct PictureArea {
  float u0 = 0, v0 = 0, u1 = 1, v1 = 1;
};

/// Surface of a face: a picture spread over it, or else a material tiled at its real size.
struct Finish {
  int material = 0;
  std::optional<PictureArea> picture;
};

/// Faces of a box in the order front (-y), right (+x), back (+y), left (-x), top (+z), bottom (-z).
using BoxFinish = std::array<Finish, 6>;

/// Adds shapes to a mesh. Coordinates are in the builder's own frame, metres; z is up.
class ShapeBuilder {
 public:
  /// @param seed  where in their tiling the materials start
  ShapeBuilder(Mesh& mesh, const std::vector<Material>& materials, std::uint64_t seed)
      : mesh_(mesh), materials_(materials), random_(seed) {}

  /// Pose of the shapes that follow.
  Pose world_from_local;

  /// A parallelogram; outside is along s_edge x t_edge. A picture's left is at s = 0, its lower side at t =
  /// 0.
  void rectangle(const Eigen::Vector3d& corner, const Eigen::Vector3d& s_edge, const Eigen::Vector3d& t_edge,
                 const Finish& finish);
  /// A box standing on `base`, the centre of its lower face; faces with material < 0 are left out.
  void box(const Eigen::Vector3d& base, const Eigen::Vector3d& size, const BoxFinish& finish);
  void box(const Eigen::Vector3d& base, const Eigen::Vector3d& size, const Finish& finish);
  /// A surface of revolution about the z axis through `base`; `profile` = (radius, height) from its lower or
  /// outer end, so that outside is on the right when going along the profile with z up. Creases of more
  /// than 40 degrees stay sharp.
  void revolve(const Eigen::Vector3d& base, const std::vector<Eigen::Vector2d>& profile, int segments,
               const Finish& finish);
  /// A closed cylinder standing on `base`.
  void cylinder(const Eigen::Vector3d& base, double radius, double height, const Finish& side,
                const Finish& ends, int segments = 20);
  void ellipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& radii, const Finish& finish,
                 int segments = 20);
  /// A round rod along a smooth curve through `points`; open ends.
  void rod(const std::vector<Eigen::Vector3d>& points, double radius, const Finish& finish, int sides = 8);
  /// A bent sheet seen from both sides: rows of points, all of the same length.
  void sheet(const std::vector<std::vector<Eigen::Vector3d>>& rows, const Finish& finish);

 private:
  void vertex(const Eigen::Vector3d& position, const Eigen::Vector3d& normal, const Eigen::Vector2f& uv);
  Eigen::Vector2f tiling_offset();
  Eigen::Vector2f texture_at(const Finish& finish, const Eigen::Vector2f& offset, double s, double t,
                             double width, double height) const;

  Mesh& mesh_;
  const std::vector<Material>& materials_;
  Random random_;
};

/// Rotation about the vertical, then a shift.
Pose placed(double x, double y, double z, double yaw_radians = 0);

}  // namespace stdc::simulation
