#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "atlas/atlas.hpp"
#include "atlas/dense_view.hpp"
#include "core/camera.hpp"

namespace stdc {

/// The newest version of the format; older ones are read too. Since 2 the camera has k4, k5, k6 and the lens
/// model. Since 3 there may be views for a dense map; a map without them is written as version 2.
inline constexpr std::uint32_t kMapFileVersion = 3;

/// What a map file holds; docs/map-file.md describes the format.
struct StoredMap {
  Camera camera;  ///< that the map was made with; one needs the same to be localised in it
  Atlas atlas;
  std::uint32_t version = kMapFileVersion;  ///< of the file
  DenseViews views;                         ///< what a dense map can be made of; most maps have none
};

/// Writes a map to a file, whole or not at all: it is written beside it under another name, brought to the
/// disk and then renamed. Keyframes and landmarks are numbered anew, in the same order, without gaps;
/// keyframes that were removed are not kept; views that belonged to those go to their nearest ancestor.
/// Throws Error if it cannot be written.
void save_map(const std::filesystem::path& path, const Camera& camera, const Atlas& atlas,
              const DenseViews& views = {});

/// Reads it back. Throws Error, one line naming the file and what to do, if it is missing, no map file,
/// damaged anywhere, cut short, or of a newer version.
StoredMap load_map(const std::filesystem::path& path);

/// The same to and from streams; `name` stands for the file in errors.
void write_map(std::ostream& stream, const Camera& camera, const Atlas& atlas, const DenseViews& views = {});
StoredMap read_map(std::istream& stream, const std::string& name);

}  // namespace stdc
