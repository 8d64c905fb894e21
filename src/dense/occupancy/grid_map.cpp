#include "dense/occupancy/grid_map.hpp"

#include <fmt/format.h>

#include <cmath>
#include <ostream>

namespace stdc {
namespace {

constexpr std::uint8_t kOccupied = 0, kFree = 254, kUnknown = 205;

std::uint8_t look_down(const OccupancyCells& cells, int x, int y, double min_height, double max_height) {
  bool free = false, lowest = true;
  for (int z = 0; z < cells.count[2]; ++z) {
    const double height = (cells.first[2] + z + 0.5) * static_cast<double>(cells.cell);
    if (height > max_height) break;
    const Occupancy state = cells.at(x, y, z);
    if (height >= min_height) {
      if (state == Occupancy::occupied) return kOccupied;
      // Only just above the floor: what is hidden by a desk is not free because there is air above it.
      free = free || (lowest && state == Occupancy::free);
      lowest = false;
    } else if (height > -min_height) {
      free = free || state == Occupancy::occupied;  // the floor
    }
  }
  return free ? kFree : kUnknown;
}

}  // namespace

GridMap flatten(const OccupancyCells& cells, double min_height, double max_height) {
  GridMap map;
  map.width = cells.count[0], map.height = cells.count[1];
  map.resolution = static_cast<double>(cells.cell);
  map.origin_x = cells.first[0] * map.resolution, map.origin_y = cells.first[1] * map.resolution;
  for (int y = map.height - 1; y >= 0; --y) {
    for (int x = 0; x < map.width; ++x) map.pixels.push_back(look_down(cells, x, y, min_height, max_height));
  }
  return map;
}

void write_pgm(std::ostream& stream, const GridMap& map) {
  stream << fmt::format("P5\n# {:.6g} m a pixel, of STDC-SLAM\n{} {}\n255\n", map.resolution, map.width,
                        map.height);
  stream.write(reinterpret_cast<const char*>(map.pixels.data()),
               static_cast<std::streamsize>(map.pixels.size()));
}

void write_yaml(std::ostream& stream, const GridMap& map, const std::string& image,
                const Pose& level_from_world) {
  const Eigen::Vector3d& t = level_from_world.translation;
  const Eigen::Quaterniond& q = level_from_world.rotation;
  stream << fmt::format(
      "# Lengths in metres; z is up and the floor at z = 0.\n"
      "# The grid's coordinates from those of the trajectory, tx ty tz qx qy qz qw:\n"
      "# {:.6f} {:.6f} {:.6f} {:.7f} {:.7f} {:.7f} {:.7f}\n"
      "image: {}\nmode: trinary\nresolution: {:.6g}\norigin: [{:.6f}, {:.6f}, 0]\nnegate: "
      "0\noccupied_thresh: 0.65\n"
      "free_thresh: 0.196\n",
      t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w(), image, map.resolution, map.origin_x, map.origin_y);
}

}  // namespace stdc
