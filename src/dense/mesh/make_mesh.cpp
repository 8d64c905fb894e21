#include "dense/mesh/make_mesh.hpp"

#include <map>

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
  TriangleMesh mesh = extract_surface(make_field(views, pinhole, settings, threads), settings.min_weight);
  drop_small_components(mesh, settings.min_component);
  compute_normals(mesh);
  colour_vertices(mesh, views, pinhole, settings, threads);
  return mesh;
}

}  // namespace stdc
