#include "run/dense/dense_output.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/lower_case.hpp"
#include "core/stopwatch.hpp"
#include "dense/export/mesh_files.hpp"
#include "dense/export/octomap_file.hpp"
#include "dense/fusion/rectifier.hpp"
#include "dense/mesh/make_mesh.hpp"
#include "dense/mesh/simplify_mesh.hpp"
#include "dense/occupancy/grid_map.hpp"
#include "run/process_usage.hpp"

namespace stdc::app {
namespace fs = std::filesystem;

namespace {

struct Ending {
  const char* suffix;
  DenseKind kind;
};

DenseTarget target_of(const fs::path& path, const char* option, std::initializer_list<Ending> endings) {
  const std::string suffix = lower_case(path.extension().string());
  std::string known;
  for (const Ending& ending : endings) {
    if (suffix == ending.suffix) {
      DenseTarget target{ending.kind, path};
      if (target.kind == DenseKind::grid) target.path.replace_extension(".yaml");
      if (target.kind == DenseKind::octomap && !has_octomap()) {
        throw Error(option, "this program was built without OctoMap",
                    "install liboctomap-dev and build again, or choose another format");
      }
      return target;
    }
    known += (known.empty() ? "" : ", ") + std::string(ending.suffix);
  }
  throw Error(fmt::format("{} {}", option, path.string()),
              suffix.empty() ? "the name has no ending that says what to write"
                             : fmt::format("'{}' is no ending that says what to write", suffix),
              fmt::format("give a file that ends in {}", known));
}

/// Axes of a robot (x forwards, z up) from those of a camera that is held level.
Pose level_from_camera() {
  Eigen::Matrix3d rotation;
  rotation << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return Pose(rotation, Eigen::Vector3d::Zero());
}

/// Axes of glTF (y up) from level ones (z up).
Eigen::Quaternionf gltf_from_world(const Pose& level_from_world) {
  Eigen::Matrix3d gltf_from_level;
  gltf_from_level << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return Eigen::Quaternionf(
      Eigen::Quaterniond(gltf_from_level * level_from_world.rotation_matrix()).cast<float>());
}

}  // namespace

bool is_mesh(const DenseTarget& target) {
  return target.kind == DenseKind::mesh_ply || target.kind == DenseKind::mesh_glb;
}

DenseTarget any_target(const fs::path& path, const char* option) {
  return target_of(path, option,
                   {{".glb", DenseKind::mesh_glb},
                    {".ply", DenseKind::mesh_ply},
                    {".pcd", DenseKind::cloud_pcd},
                    {".bt", DenseKind::octomap},
                    {".yaml", DenseKind::grid},
                    {".pgm", DenseKind::grid}});
}
DenseTarget mesh_target(const fs::path& path, const char* option) {
  return target_of(path, option, {{".glb", DenseKind::mesh_glb}, {".ply", DenseKind::mesh_ply}});
}
DenseTarget cloud_target(const fs::path& path, const char* option) {
  return target_of(path, option, {{".ply", DenseKind::cloud_ply}, {".pcd", DenseKind::cloud_pcd}});
}
DenseTarget octomap_target(const fs::path& path, const char* option) {
  return target_of(path, option, {{".bt", DenseKind::octomap}});
}
DenseTarget grid_target(const fs::path& path, const char* option) {
  return target_of(path, option, {{".yaml", DenseKind::grid}, {".pgm", DenseKind::grid}});
}

DenseOutput::DenseOutput(std::vector<DenseTarget> targets) : targets_(std::move(targets)) {
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (targets_[i].path != targets_[k].path) continue;
      throw Error(targets_[i].path.string(), "is asked for twice", "give each file a name of its own");
    }
    files_.emplace_back(targets_[i].path);
    if (targets_[i].kind == DenseKind::grid)
      images_.emplace_back(fs::path(targets_[i].path).replace_extension(".pgm"));
  }
}

DenseReport DenseOutput::write(const DenseInput& input) {
  Stopwatch watch;
  const double cpu_start = process_usage().cpu_seconds;
  TriangleMesh mesh = make_mesh(input.views, pinhole_of(input.camera), input.settings);
  if (mesh.empty()) {
    throw Error(targets_.front().path.string(), "there is no surface to write: the dense map is empty",
                "give frames with depth that get a pose, or a smaller dense.min_component");
  }
  const bool wants_level = std::any_of(targets_.begin(), targets_.end(), [](const DenseTarget& target) {
    return target.kind == DenseKind::mesh_glb || target.kind == DenseKind::octomap ||
           target.kind == DenseKind::grid;
  });
  const auto floor = wants_level ? find_floor(mesh, input.views, input.up) : std::nullopt;
  write_others(mesh, input, floor);
  DenseReport report{input.views.size(), mesh.positions.size(), mesh.triangles.size(), mesh.triangles.size()};
  if (std::any_of(targets_.begin(), targets_.end(), is_mesh)) {
    simplify_mesh(mesh, simplification_of(input.settings));
    report.vertices = mesh.positions.size(), report.triangles = mesh.triangles.size();
    write_meshes(mesh, floor ? floor->level_from_world : level_from_camera());
  }
  report.seconds = 1e-3 * watch.lap_ms();
  report.cpu_seconds = process_usage().cpu_seconds - cpu_start;
  return report;
}

void DenseOutput::write_meshes(const TriangleMesh& mesh, const Pose& level_from_world) {
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (!is_mesh(targets_[i])) continue;
    if (targets_[i].kind == DenseKind::mesh_ply) {
      write_mesh_ply(files_[i].stream(), mesh);
    } else {
      write_mesh_glb(files_[i].stream(), mesh, gltf_from_world(level_from_world));
    }
    files_[i].flush();
  }
}

void DenseOutput::write_others(const TriangleMesh& mesh, const DenseInput& input,
                               const std::optional<FloorPlane>& floor) {
  const Pose level_from_world = floor ? floor->level_from_world : level_from_camera();
  std::optional<OccupancyCells> cells;
  const auto occupancy = [&]() -> const OccupancyCells& {
    if (!cells) {
      cells = find_occupancy(mesh, input.views, pinhole_of(input.camera), input.settings, level_from_world,
                             std::max(input.settings.cell, input.settings.voxel));
    }
    return *cells;
  };
  auto image = images_.begin();
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    if (is_mesh(targets_[i])) continue;
    std::ostream& stream = files_[i].stream();
    if (targets_[i].kind == DenseKind::cloud_ply) write_cloud_ply(stream, mesh);
    if (targets_[i].kind == DenseKind::cloud_pcd) write_cloud_pcd(stream, mesh);
    if (targets_[i].kind == DenseKind::octomap) write_octomap(stream, occupancy());
    if (targets_[i].kind == DenseKind::grid) {
      if (!floor) {
        throw Error(targets_[i].path.string(),
                    "no floor was found in the dense map, so there is no plan of it",
                    "show the floor to the camera, or say what is up by map export --up X,Y,Z");
      }
      const GridMap map =
          flatten(occupancy(), input.settings.min_obstacle_height, input.settings.max_obstacle_height);
      write_pgm(image->stream(), map);
      write_yaml(stream, map, image->path().filename().string(), level_from_world);
      image->flush();
      ++image;
    }
    files_[i].flush();
  }
}

void DenseOutput::commit() {
  for (WholeFile& image : images_) image.commit();
  for (WholeFile& file : files_) file.commit();
}

std::string DenseOutput::names() const {
  std::string names;
  for (const DenseTarget& target : targets_) names += (names.empty() ? "" : ", ") + target.path.string();
  return names;
}

}  // namespace stdc::app
