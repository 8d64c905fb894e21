#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "atlas/atlas.hpp"
#include "core/camera.hpp"

namespace stdc {

/// Version of the format that is written, and the newest that is read; older ones are read too. Since 2 the
/// camera has k4, k5, k6 and the lens model.
inline constexpr std::uint32_t kMapFileVersion = 2;

/// What a map file holds; docs/map-file.md describes the format.
struct StoredMap {
  Camera camera;  ///< that the map was made with; one needs the same to be localised in it
  Atlas atlas;
  std::uint32_t version = kMapFileVersion;  ///< of the file
};

/// Writes a map to a file, whole or not at all: it is written beside it under another name, brought to the
/// disk and then renamed. Keyframes and landmarks are numbered anew, in the same order, without gaps;
/// keyframes that were removed are not kept. Throws Error if it cannot be written.
void save_map(const std::filesystem::path& path, const Camera& camera, const Atlas& atlas);

/// Reads it back. Throws Error, one line naming the file and what to do, if it is missing, no map file,
/// damaged anywhere, cut short, or of a newer version.
StoredMap load_map(const std::filesystem::path& path);

/// The same to and from streams; `name` stands for the file in errors.
void write_map(std::ostream& stream, const Camera& camera, const Atlas& atlas);
StoredMap read_map(std::istream& stream, const std::string& name);

}  // namespace stdc
