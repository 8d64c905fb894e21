#include "run/dense/dense_detail.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace stdc::app {

void add_detail_options(Command command, const std::string& prefix, DenseDetail& detail) {
  command.add_option(prefix + "voxel", detail.voxel, "Side of the voxels of the dense map, default 0.01")
      .type_name("METRES");
  command
      .add_option(prefix + "tolerance", detail.tolerance,
                  "Write meshes with fewer triangles, nowhere farther than this from the whole one")
      .type_name("METRES");
  command
      .add_option(prefix + "triangles", detail.triangles,
                  "Write meshes with at most so many triangles, which may cost detail")
      .type_name("COUNT");
}

void apply_detail(const DenseDetail& detail, const std::string& prefix, const SettingsOptions& chosen,
                  DenseSettings& settings) {
  const auto apply = [&](const auto& given, const std::string& name, const std::string& setting,
                         auto& value) {
    check_not_assigned(given.has_value(), (prefix + name).c_str(), chosen, setting);
    if (given) value = *given;
  };
  apply(detail.voxel, "voxel", "dense.voxel", settings.voxel);
  apply(detail.tolerance, "tolerance", "dense.mesh_tolerance", settings.mesh_tolerance);
  apply(detail.triangles, "triangles", "dense.mesh_triangles", settings.mesh_triangles);
}

void check_simplifies(const DenseDetail& detail, const std::string& prefix,
                      const std::vector<DenseTarget>& targets, const std::string& remedy) {
  if ((!detail.tolerance && !detail.triangles) || std::any_of(targets.begin(), targets.end(), is_mesh))
    return;
  throw Error(prefix + (detail.tolerance ? "tolerance" : "triangles"), "there is no mesh to simplify",
              "give " + remedy + ", too");
}

}  // namespace stdc::app
