#pragma once

#include <string>

#include "dense/mesh/triangle_mesh.hpp"

namespace stdc {

/// Corner of the mesh's box and its size (three f32 each), number of vertices and of triangles (u32 each);
/// then positions in 65535ths of the box (three u16 each: a tenth of a millimetre in a room), colours (red,
/// green, blue: u8; grey if the mesh has none), zeros up to a multiple of 4, triangles (three u32 each).
std::string encode_mesh(const TriangleMesh& mesh);

}  // namespace stdc
