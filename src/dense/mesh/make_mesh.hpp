#pragma once

#include "atlas/atlas_snapshot.hpp"
#include "dense/dense_settings.hpp"
#include "dense/fusion/pinhole.hpp"
#include "dense/fusion/placed_view.hpp"
#include "dense/mesh/triangle_mesh.hpp"

namespace stdc {

/// The views of a map, where the map now has them.
std::vector<PlacedView> place_views(const DenseViews& views, const AtlasSnapshot& snapshot, MapId map);

/// The map that most views belong to; of equals the older. Map 0 if there are none.
MapId map_with_most_views(const DenseViews& views, const AtlasSnapshot& snapshot);

/// The surface that views show, with normals and colours, in the coordinates of the map. The same views,
/// poses and settings give the same mesh, bit by bit, on any number of threads; 0: one for each core.
TriangleMesh make_mesh(const std::vector<PlacedView>& views, const Pinhole& pinhole,
                       const DenseSettings& settings, int threads = 0);

}  // namespace stdc
