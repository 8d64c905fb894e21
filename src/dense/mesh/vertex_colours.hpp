#pragma once

#include "dense/dense_settings.hpp"
#include "dense/fusion/pinhole.hpp"
#include "dense/fusion/placed_view.hpp"
#include "dense/mesh/triangle_mesh.hpp"

namespace stdc {

/// Gives each vertex the mean colour that views show where they see it, those that see it near and face on
/// preferred. Looking into the images costs less memory than colours in every voxel, and is sharper. A vertex
/// that no view sees is grey. The same colours on any number of threads.
void colour_vertices(TriangleMesh& mesh, const std::vector<PlacedView>& views, const Pinhole& pinhole,
                     const DenseSettings& settings, int threads = 0);

}  // namespace stdc
