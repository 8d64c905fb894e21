#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "atlas/storage/map_file.hpp"

namespace stdc::app {

/// What one of the maps in a file holds.
struct MapContent {
  int keyframes = 0, landmarks = 0, observations = 0;
  Eigen::AlignedBox3d box;                         ///< of the landmarks [m], in the map's coordinates
  double first_timestamp = 0, last_timestamp = 0;  ///< of the keyframes [s]
};

/// What `map info` tells about a file.
struct MapReport {
  std::string file;
  std::uintmax_t bytes = 0;
  std::uint32_t version = kMapFileVersion;
  Camera camera;
  std::vector<MapContent> maps;
  int dense_views = 0;             ///< what a dense map can be made of
  std::uintmax_t dense_bytes = 0;  ///< of the file, for those
};

MapReport describe_map(const std::string& file, std::uintmax_t bytes, const StoredMap& stored);
/// For people.
std::string map_report_text(const MapReport& report);
/// For programs: metres, seconds, bytes.
std::string map_report_json(const MapReport& report);

}  // namespace stdc::app
