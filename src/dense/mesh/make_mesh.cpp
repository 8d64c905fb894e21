#include "dense/mesh/make_mesh.hpp"

#include <map>

#include "dense/fusion/field_windows.hpp"
#include "dense/mesh/surface_extraction.hpp"
#include "dense/mesh/vertex_colours.hpp"

namespace stdc {

std::vector<PlacedView> place_views(const DenseViews& views, const AtlasSnapshot& snapshot, MapId map) {
  std::vector<PlacedView> placed;
  for (const auto& view : views) {
    if (snapshot.keyframes()[view->reference.value].map != map) continue;
    placed.push_back({view, snapshot.cam_from_world(view->reference, view->cam_from_reference)});
  }
  return placed;
}

MapId map_with_most_views(const DenseViews& views, const AtlasSnapshot& snapshot) {
  std::map<MapId, int> counts;
  for (const auto& view : views) ++counts[snapshot.keyframes()[view->reference.value].map];
  MapId best{0};
  for (const auto& [map, count] : counts) {
    if (count > counts[best]) best = map;
  }
  return best;
}

TriangleMesh make_mesh(const std::vector<PlacedView>& views, const Pinhole& pinhole,
                       const DenseSettings& settings, int threads) {
  SurfaceExtraction surface(settings.min_weight);
  for_each_window(views, pinhole, settings, threads, kBlocksInWindow,
                  [&](const DistanceField& field, BlockRange blocks) { surface.add(field, blocks); });
  TriangleMesh mesh = surface.take();
  drop_small_components(mesh, settings.min_component);
  colour_vertices(mesh, views, pinhole, settings, threads);
  compute_normals(mesh);  // last: nothing needs them before, and making colours takes most memory
  return mesh;
}

}  // namespace stdc
