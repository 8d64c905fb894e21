#pragma once

#include <string>

#include "atlas/atlas.hpp"
#include "input/trajectory.hpp"

namespace stdc::app {

/// The landmarks as a point cloud: a binary little-endian PLY file (Turk, 'The PLY Polygon File Format',
/// 1994) with float x, y, z [m, in the coordinates of the point's own map], uchar red, green, blue (the grey
/// value where its oldest observation has it; 128 if there are no patches), int observations, int map.
std::string point_cloud_ply(const Atlas& atlas);

/// The keyframes of one of the maps in order of time. Of those that have one time, because a sequence was
/// mapped twice, the youngest.
Trajectory keyframes_of(const Atlas& atlas, MapId map);

/// `name`.txt for the first of several maps, `name`-map-N.txt for the others.
std::string file_of_map(const std::string& name, MapId map);

}  // namespace stdc::app
