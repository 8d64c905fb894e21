#pragma once

#include <Eigen/Geometry>
#include <iosfwd>

#include "dense/mesh/triangle_mesh.hpp"

namespace stdc {

// Files that other programs read. Streams are binary; whether all went well is for the caller to ask them.

/// Binary little-endian PLY (Turk, 'The PLY Polygon File Format', 1994): x, y, z [m], nx, ny, nz, red, green,
/// blue of each vertex, and the triangles.
void write_mesh_ply(std::ostream& stream, const TriangleMesh& mesh);

/// The vertices alone, as a point cloud: PLY like above without triangles.
void write_cloud_ply(std::ostream& stream, const TriangleMesh& mesh);

/// The vertices as a point cloud of the Point Cloud Library: PCD 0.7, binary, fields x y z normal_x normal_y
/// normal_z rgb.
void write_cloud_pcd(std::ostream& stream, const TriangleMesh& mesh);

/// One file of glTF 2.0 (Khronos), which browsers and desktops open: colours are given as linear light, as
/// the specification (3.7.2.1) wants them, in 16 bits.
/// @param upright  turns the mesh so that y is up, as viewers take it
void write_mesh_glb(std::ostream& stream, const TriangleMesh& mesh, const Eigen::Quaternionf& upright);

}  // namespace stdc
