#pragma once

#include <iosfwd>
#include <string>

#include "dense/occupancy/floor_plane.hpp"
#include "dense/occupancy/occupancy_cells.hpp"

namespace stdc {

/// The plan that a robot on the floor navigates by, as ROS map_server reads it.
struct GridMap {
  int width = 0, height = 0;
  double resolution = 0;              ///< side of a pixel [m]
  double origin_x = 0, origin_y = 0;  ///< of the lower left corner of the lower left pixel [m], level frame
  std::vector<std::uint8_t>
      pixels;  ///< rows from the top (largest y) down: 0 occupied, 254 free, 205 unknown
};

/// Looks down on cells in level coordinates (z up, floor at 0): a column is occupied if anything stands
/// between the two heights [m], free if the floor is seen, or seen through is what lies just above it.
GridMap flatten(const OccupancyCells& cells, double min_height, double max_height);

/// The image: PGM (Netpbm, 'P5').
void write_pgm(std::ostream& stream, const GridMap& map);
/// What goes with it: YAML of map_server; the place of the grid in the world as a comment.
/// @param image  name of the image file
void write_yaml(std::ostream& stream, const GridMap& map, const std::string& image,
                const Pose& level_from_world);

}  // namespace stdc
