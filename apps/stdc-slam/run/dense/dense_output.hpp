#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/camera.hpp"
#include "core/files/whole_file.hpp"
#include "dense/dense_settings.hpp"
#include "dense/fusion/placed_view.hpp"
#include "dense/mesh/triangle_mesh.hpp"
#include "dense/occupancy/floor_plane.hpp"

namespace stdc::app {

/// What a dense map can be written as.
enum class DenseKind { mesh_ply, mesh_glb, cloud_ply, cloud_pcd, octomap, grid };

struct DenseTarget {
  DenseKind kind = DenseKind::mesh_ply;
  std::filesystem::path path;  ///< of a grid the YAML file
};

bool is_mesh(const DenseTarget& target);

/// Throw Error naming the option if the file's name does not end as it should.
DenseTarget any_target(const std::filesystem::path& path, const char* option);  ///< kind by the name
DenseTarget mesh_target(const std::filesystem::path& path, const char* option);
DenseTarget cloud_target(const std::filesystem::path& path, const char* option);
DenseTarget octomap_target(const std::filesystem::path& path, const char* option);
DenseTarget grid_target(const std::filesystem::path& path, const char* option);

/// What a dense map is made of.
struct DenseInput {
  std::vector<PlacedView> views;
  Camera camera;
  DenseSettings settings;
  std::optional<Eigen::Vector3d> up;  ///< in the world, if the user knows it
};

struct DenseReport {
  std::size_t views = 0, vertices = 0, triangles = 0;  ///< of the mesh as it is written
  std::size_t whole = 0;                               ///< triangles before it was simplified
  double cpu_seconds = 0, seconds = 0;                 ///< of making and writing it
};

/// Files of a dense map, which appear at the end or not at all.
class DenseOutput {
 public:
  /// Throws Error if a file cannot be made.
  explicit DenseOutput(std::vector<DenseTarget> targets);

  /// Makes the map and writes all files, but does not put them in their places. Throws Error if there is no
  /// surface, or no floor for a grid, or a file cannot be written.
  DenseReport write(const DenseInput& input);
  void commit();
  /// "a.glb, b.bt"
  std::string names() const;

 private:
  /// Meshes, which may be simplified, and what is made of the whole surface.
  void write_meshes(const TriangleMesh& mesh, const Pose& level_from_world);
  void write_others(const TriangleMesh& mesh, const DenseInput& input,
                    const std::optional<FloorPlane>& floor);

  std::vector<DenseTarget> targets_;
  std::deque<WholeFile> files_;   ///< one for each target
  std::deque<WholeFile> images_;  ///< one for each grid
};

}  // namespace stdc::app
