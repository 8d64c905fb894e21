// score_mesh: a dense map of a rendered sequence against the surfaces of the room. See docs/dense-map.md.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <set>
#include <sstream>

#include "commands/command.hpp"
#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "core/random.hpp"
#include "evaluation/trajectory_error.hpp"
#include "input/layouts/tum_sequence.hpp"
#include "input/trajectory.hpp"
#include "simulation/light/ray_scene.hpp"
#include "simulation/scene/room.hpp"
#include "simulation/sequence/preset.hpp"
#include "triangle_index.hpp"

namespace stdc {
namespace {

struct Options {
  std::string preset, sequence, mesh, trajectory, ghosts;
  std::uint64_t seed = 1;
  bool by_trajectory = false;
};

struct PlainMesh {
  std::vector<Eigen::Vector3f> positions;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// Reads what write_mesh_ply() writes.
PlainMesh read_mesh(const std::string& path) {
  const std::string bytes = read_file(path, "give a mesh that run --dense FILE.ply wrote");
  const std::size_t body = bytes.find("end_header\n");
  std::istringstream head(bytes.substr(0, body));
  std::size_t vertices = 0, faces = 0;
  for (std::string line; std::getline(head, line);) {
    std::sscanf(line.c_str(), "element vertex %zu", &vertices);
    std::sscanf(line.c_str(), "element face %zu", &faces);
  }
  constexpr std::size_t kVertex = 27, kFace = 13;
  const std::size_t start = body + 11;
  if (body == std::string::npos || bytes.size() != start + kVertex * vertices + kFace * faces) {
    throw Error(path, "is no mesh of this program", "give one that run --dense FILE.ply wrote");
  }
  PlainMesh mesh;
  mesh.positions.resize(vertices), mesh.triangles.resize(faces);
  for (std::size_t i = 0; i < vertices; ++i)
    std::memcpy(mesh.positions[i].data(), &bytes[start + kVertex * i], 12);
  for (std::size_t i = 0; i < faces; ++i) {
    std::memcpy(mesh.triangles[i].data(), &bytes[start + kVertex * vertices + kFace * i + 1], 12);
  }
  return mesh;
}

std::vector<TriangleIndex::Triangle> triangles_of(const simulation::Mesh& mesh) {
  std::vector<TriangleIndex::Triangle> triangles;
  for (const auto& quad : mesh.quads) {
    const auto at = [&](int k) { return mesh.positions[quad[static_cast<std::size_t>(k)]]; };
    triangles.push_back({at(0), at(1), at(2)});
    triangles.push_back({at(0), at(2), at(3)});
  }
  return triangles;
}

/// Points spread evenly over a mesh, about one on each 2 cm^2, and their distances from the true surface.
void score_accuracy(const PlainMesh& mesh, const TriangleIndex& room, const std::string& ghosts) {
  constexpr double kPerSquareMetre = 5000;
  constexpr float kLimit = 0.5F, kGhost = 0.05F;
  Random random(1, 1);
  std::vector<float> distances;
  std::string list;
  double area = 0, carry = 0;
  for (const auto& triangle : mesh.triangles) {
    const Eigen::Vector3f &a = mesh.positions[triangle[0]], &b = mesh.positions[triangle[1]],
                          &c = mesh.positions[triangle[2]];
    const double own = 0.5 * (b - a).cross(c - a).norm();
    area += own, carry += own * kPerSquareMetre;
    for (; carry >= 1; carry -= 1) {
      float u = static_cast<float>(random.next() >> 8U) / 16777216.F,
            v = static_cast<float>(random.next() >> 8U) / 16777216.F;
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Eigen::Vector3f point = a + u * (b - a) + v * (c - a);
      distances.push_back(room.distance(point, kLimit));
      if (distances.back() > kGhost)
        list +=
            fmt::format("{:.3f} {:.3f} {:.3f} {:.3f}\n", point.x(), point.y(), point.z(), distances.back());
    }
  }
  if (!ghosts.empty()) std::ofstream(ghosts) << list;
  std::sort(distances.begin(), distances.end());
  double sum = 0, large = 0;
  for (const float d : distances) sum += d, large += d > kGhost ? 1 : 0;
  const double n = static_cast<double>(std::max<std::size_t>(1, distances.size()));
  const auto quantile = [&](double q) {
    return distances.empty() ? 0.F : distances[static_cast<std::size_t>(q * (n - 1))];
  };
  fmt::print("mesh: {:.1f} m^2, {} triangles\n", area, mesh.triangles.size());
  fmt::print("distance to the true surface: mean {:.2f} mm, median {:.2f}, 95 % {:.2f}, 99 % {:.2f}\n",
             1e3 * sum / n, 1e3 * quantile(0.5), 1e3 * quantile(0.95), 1e3 * quantile(0.99));
  fmt::print("ghost surface (farther than 5 cm from any): {:.4f} %\n", 100 * large / n);
}

/// Improves an alignment: trajectories of a few decimetres leave a rotation open that costs centimetres at
/// the far wall. Point-to-plane ICP (Chen and Medioni 1992) of the mesh onto the room, nearest points within
/// 5 cm.
Pose refine(const PlainMesh& mesh, const TriangleIndex& room) {
  constexpr int kRounds = 15;
  constexpr std::size_t kPoints = 8000;
  constexpr float kLimit = 0.05F;
  Pose truth_from_mesh;
  const std::size_t step = std::max<std::size_t>(1, mesh.positions.size() / kPoints);
  for (int round = 0; round < kRounds; ++round) {
    Matrix6d a = Matrix6d::Identity() * 1e-9;
    Vector6d b = Vector6d::Zero();
    for (std::size_t i = 0; i < mesh.positions.size(); i += step) {
      const Eigen::Vector3d point = truth_from_mesh * mesh.positions[i].cast<double>();
      const TriangleIndex::Nearest nearest = room.find(point.cast<float>(), kLimit);
      if (nearest.distance >= kLimit) continue;
      const Eigen::Vector3d normal = nearest.normal.cast<double>();
      Vector6d row;
      row << normal, point.cross(normal);
      a += row * row.transpose();
      b -= row * normal.dot(point - nearest.point.cast<double>());
    }
    truth_from_mesh = Pose::exp(a.ldlt().solve(b)) * truth_from_mesh;
  }
  return truth_from_mesh;
}

/// True surface points where the depth camera has measured them.
std::vector<Eigen::Vector3f> seen_points(const TumSequence& sequence, const Camera& camera,
                                         const Trajectory& truth, const simulation::RayScene& scene,
                                         double max_depth) {
  constexpr std::size_t kEvery = 5;
  constexpr int kStep = 6;
  constexpr float kCell = 0.01F;
  std::set<std::array<int, 3>> cells;
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < sequence.frames().size(); i += kEvery) {
    const SequenceFrame& frame = sequence.frames()[i];
    const auto pose = std::lower_bound(truth.begin(), truth.end(), frame.timestamp - 1e-4,
                                       [](const StampedPose& p, double t) { return p.timestamp < t; });
    if (pose == truth.end() || std::abs(pose->timestamp - frame.timestamp) > 1e-3) continue;
    const cv::Mat depth = load_frame(frame, camera).depth;
    const Eigen::Vector3f origin = pose->world_from_cam.translation.cast<float>();
    for (int y = kStep / 2; y < depth.rows; y += kStep) {
      for (int x = kStep / 2; x < depth.cols; x += kStep) {
        const double z = depth.at<std::uint16_t>(y, x) / camera.depth_units_per_metre;
        if (!(z > 0) || z > max_depth) continue;
        const Eigen::Vector3f ray =
            (pose->world_from_cam.rotation * camera.unproject({x, y}, 1)).cast<float>();
        const simulation::Hit hit = scene.trace(origin, ray, 0.1F, 20);
        // Else it has measured a mover, or over an edge.
        if (!hit.valid() || std::abs(hit.distance - z) > 0.02 + 0.01 * z * z) continue;
        const Eigen::Vector3f point = origin + hit.distance * ray;
        const Eigen::Vector3f place = (point / kCell).array().floor();
        if (!cells
                 .insert(
                     {static_cast<int>(place.x()), static_cast<int>(place.y()), static_cast<int>(place.z())})
                 .second)
          continue;
        points.push_back(point);
      }
    }
  }
  return points;
}

void score_completeness(const PlainMesh& mesh, const std::vector<Eigen::Vector3f>& points, double max_depth) {
  std::vector<TriangleIndex::Triangle> triangles;
  for (const auto& t : mesh.triangles) {
    triangles.push_back({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]});
  }
  const TriangleIndex index(std::move(triangles), 0.03F);
  constexpr float kNear = 0.02F;
  std::size_t covered = 0;
  for (const Eigen::Vector3f& point : points) covered += index.distance(point, kNear) < kNear ? 1 : 0;
  fmt::print(
      "completeness (true surface measured within {:g} m, mesh within 2 cm of it): {:.2f} % of {} points\n",
      max_depth,
      100.0 * static_cast<double>(covered) / static_cast<double>(std::max<std::size_t>(1, points.size())),
      points.size());
}

void score(const Options& options) {
  const TumSequence sequence(options.sequence);
  const Camera camera = find_camera(sequence, {});
  const Trajectory truth = sequence.ground_truth().poses, estimate = read_trajectory(options.trajectory);
  const TrajectoryScores scores = score_trajectory(truth, estimate);
  const Pose& truth_from_estimate = scores.truth_from_estimate;
  PlainMesh mesh = read_mesh(options.mesh);
  for (Eigen::Vector3f& p : mesh.positions) p = (truth_from_estimate * p.cast<double>()).cast<float>();
  const simulation::Room room = simulation::make_room(
      options.seed, simulation::has_visitor_chair(simulation::preset_named(options.preset)));
  const TriangleIndex surfaces(triangles_of(room.world.mesh), 0.1F);
  if (!options.by_trajectory) {
    const Pose better = refine(mesh, surfaces);
    for (Eigen::Vector3f& p : mesh.positions) p = (better * p.cast<double>()).cast<float>();
  }
  score_accuracy(mesh, surfaces, options.ghosts);
  const simulation::RayScene scene(room.world.mesh, simulation::TreeQuality::good);
  for (const double max_depth : {10.0, 4.0})
    score_completeness(mesh, seen_points(sequence, camera, truth, scene, max_depth), max_depth);
}

}  // namespace
}  // namespace stdc

int main(int argc, char** argv) {
  stdc::Options options;
  auto program = stdc::app::Program::tool(
      "score_mesh", "Scores a dense map of a rendered sequence against the surfaces of the room.");
  stdc::app::Command command = program.root();
  command.add_option("PRESET", options.preset, "Name of the preset, as for stdc-slam render").required();
  command.add_option("SEQUENCE", options.sequence, "Its folder").required();
  command.add_option("MESH", options.mesh, "PLY of run --dense").required();
  command.add_option("TRAJECTORY", options.trajectory, "trajectory.txt of the same run, to align by")
      .required();
  command.add_option("--seed", options.seed, "As for stdc-slam render");
  command.add_flag("--by-trajectory", options.by_trajectory,
                   "Align by the trajectory alone, not by the surface too");
  command.add_option("--ghosts", options.ghosts,
                     "File for points that are far from any true surface: x y z distance");
  command.callback([&] { stdc::score(options); });
  try {
    return program.run(argc, argv);
  } catch (const stdc::Error& error) {
    fmt::print(stderr, "score_mesh: {}\n", error.what());
    return 2;
  }
}
