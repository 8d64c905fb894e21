#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "dense/mesh/triangle_mesh.hpp"

namespace stdc {

/// A triangle that may take the place of others.
struct NewTriangle {
  NewTriangle(std::uint32_t face, const std::array<Eigen::Vector3f, 3>& corners,
              const std::array<Eigen::Vector3f, 3>& corner_colours);

  std::uint32_t face;
  Eigen::Vector3f first, second, third;  ///< corner; the other two, seen from it
  Eigen::Vector3f normal;                ///< of any length
  std::array<Eigen::Vector3f, 3> colours;
};

/// The vertices of a mesh as it was, each held by the triangle that now stands for it. So it is known at any
/// time how far what was is from what is left, not only by how much each step has changed it (Klein, Liebich
/// and Strasser, 'Mesh reduction with error control', 1996).
class CoveredPoints {
 public:
  /// @param tolerance         [m]
  /// @param colour_tolerance  of any channel, of 255
  CoveredPoints(TriangleMesh mesh, float tolerance, float colour_tolerance);

  /// Hands the points of old faces over to new ones that are near enough to each, look in its direction and
  /// have its colour. Changes nothing and returns false if a point finds none.
  /// @param apex  a vertex of the new ones that is none of the mesh: must be near to the points, too
  bool hand_over(const std::vector<std::uint32_t>& old_faces, const std::vector<NewTriangle>& triangles,
                 const Eigen::Vector3f& apex);

 private:
  /// Index of the triangle that is to hold a point; -1 if none can.
  int holder_of(std::uint32_t point, const std::vector<NewTriangle>& triangles) const;
  bool near_points(const Eigen::Vector3f& apex) const;

  std::vector<Eigen::Vector3f> positions_, normals_;
  std::vector<std::array<std::uint8_t, 3>> colours_;
  float tolerance_, colour_tolerance_;
  float spacing_;                     ///< mean length of an edge [m]
  std::vector<std::uint32_t> heads_;  ///< first point of each face
  std::vector<std::uint32_t> next_;   ///< the point of the same face after each
  std::vector<std::uint32_t> points_;
  std::vector<int> holders_;
};

}  // namespace stdc
