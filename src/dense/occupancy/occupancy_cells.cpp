#include "dense/occupancy/occupancy_cells.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "dense/fusion/view_batches.hpp"
#include "dense/parallel.hpp"

namespace stdc {
namespace {

/// A cell is free if a view sees something farther, by more than the cell's own diagonal.
void add_view(const ViewSamples& view, const Pose& cam_from_frame, std::size_t first_layer,
              std::size_t last_layer, OccupancyCells& cells) {
  constexpr float kNearest = 0.1F;
  const Eigen::Matrix3f rotation = cam_from_frame.rotation_matrix().cast<float>();
  const Eigen::Vector3f shift = cam_from_frame.translation.cast<float>();
  const Pinhole& pinhole = view.pinhole;
  const float diagonal = 1.8F * cells.cell;
  const auto width = static_cast<float>(pinhole.width), height = static_cast<float>(pinhole.height);
  for (std::size_t z = first_layer; z < last_layer; ++z) {
    for (int y = 0; y < cells.count[1]; ++y) {
      Occupancy* row = cells.states.data() + (z * cells.count[1] + y) * cells.count[0];
      for (int x = 0; x < cells.count[0]; ++x) {
        if (row[x] != Occupancy::unknown) continue;
        const Eigen::Vector3f centre(static_cast<float>(cells.first[0] + x) + 0.5F,
                                     static_cast<float>(cells.first[1] + y) + 0.5F,
                                     static_cast<float>(cells.first[2]) + static_cast<float>(z) + 0.5F);
        const Eigen::Vector3f point = rotation * (cells.cell * centre) + shift;
        if (point.z() < kNearest) continue;
        const float inverse = 1 / point.z();
        const float u = pinhole.fx * point.x() * inverse + pinhole.cx + 0.5F,
                    v = pinhole.fy * point.y() * inverse + pinhole.cy + 0.5F;
        if (!(u >= 0 && v >= 0 && u < width && v < height)) continue;
        const auto pixel =
            static_cast<std::size_t>(static_cast<int>(v) * pinhole.width + static_cast<int>(u));
        if ((view.infos[pixel] & ViewSamples::kFree) == 0) continue;
        if (view.depths[pixel] - point.z() > diagonal) row[x] = Occupancy::free;
      }
    }
  }
}

}  // namespace

OccupancyCells find_occupancy(const TriangleMesh& mesh, const std::vector<PlacedView>& views,
                              const Pinhole& pinhole, const DenseSettings& settings,
                              const Pose& frame_from_world, double cell, int threads) {
  threads = threads_or_cores(threads);
  OccupancyCells cells;
  cells.cell = static_cast<float>(cell);
  const Eigen::Matrix3f rotation = frame_from_world.rotation_matrix().cast<float>() / cells.cell;
  const Eigen::Vector3f shift = frame_from_world.translation.cast<float>() / cells.cell;
  const auto cell_of = [&](const Eigen::Vector3f& position) -> Eigen::Vector3f {
    return (rotation * position + shift).array().floor();
  };
  Eigen::Vector3f low = Eigen::Vector3f::Zero(), high = Eigen::Vector3f::Zero();
  bool any = false;
  const auto extend = [&](const Eigen::Vector3f& position) {
    const Eigen::Vector3f place = cell_of(position);
    low = any ? Eigen::Vector3f(low.cwiseMin(place)) : place;
    high = any ? Eigen::Vector3f(high.cwiseMax(place)) : place;
    any = true;
  };
  for (const Eigen::Vector3f& position : mesh.positions) extend(position);
  for (const PlacedView& view : views) extend(view.cam_from_world.centre().cast<float>());
  if (!any) return cells;
  constexpr double kMaxCells = 1e9;
  const Eigen::Vector3f sides = high - low + Eigen::Vector3f::Ones();
  if (!(sides.cast<double>().prod() <= kMaxCells)) {
    throw Error("dense.cell", "the map would have more than a thousand million cells", "choose larger cells");
  }
  for (int k = 0; k < 3; ++k) {
    cells.first[k] = static_cast<std::int32_t>(low[k]);
    cells.count[k] = static_cast<std::int32_t>(sides[k]);
  }
  cells.states.assign(static_cast<std::size_t>(sides.cast<double>().prod()), Occupancy::unknown);
  const auto occupy = [&](const Eigen::Vector3f& position) {
    const Eigen::Vector3f place = cell_of(position) - low;
    cells
        .states[(static_cast<std::size_t>(place.z()) * cells.count[1] + static_cast<std::size_t>(place.y())) *
                    cells.count[0] +
                static_cast<std::size_t>(place.x())] = Occupancy::occupied;
  };
  for (const Eigen::Vector3f& position : mesh.positions) occupy(position);
  for (const auto& triangle : mesh.triangles) {
    occupy((mesh.positions[triangle[0]] + mesh.positions[triangle[1]] + mesh.positions[triangle[2]]) / 3);
  }
  const Pose world_from_frame = frame_from_world.inverse();
  for_each_view(views, pinhole, settings.min_frames, threads, make_samples,
                [&](std::size_t first, const SampleBatch& samples) {
                  parallel_for(static_cast<std::size_t>(cells.count[2]), threads,
                               [&](std::size_t begin, std::size_t end) {
                                 for (std::size_t i = 0; i < samples.size(); ++i) {
                                   if (samples[i].empty()) continue;
                                   add_view(samples[i], views[first + i].cam_from_world * world_from_frame,
                                            begin, end, cells);
                                 }
                               });
                });
  return cells;
}

}  // namespace stdc
