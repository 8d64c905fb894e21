#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "input/frame_source.hpp"
#include "input/source_options.hpp"

namespace stdc {

/// A kind of input.
struct SourceKind {
  const char* name;   ///< for --input-kind: "tum"
  const char* title;  ///< "folder in TUM RGB-D layout"
  /// Whether a path looks like one, at little cost; never throws.
  bool (*matches)(const std::filesystem::path& path);
  /// Throws Error for whatever is wrong with it.
  std::unique_ptr<FrameSource> (*open)(const std::filesystem::path& path, const SourceOptions& options);
  bool takes_rate = false, takes_topics = false, is_live = false;
};

/// All kinds, the first that matches counts.
std::span<const SourceKind> source_kinds();
/// "tum, euroc, ...", for help and hints.
std::string source_kind_names();

/// The kind that a path looks like; nullptr if it is none.
const SourceKind* recognise_source(const std::filesystem::path& path);

/// The kind as which open_source() opens it: what the options name, else what it looks like. Throws Error if
/// there is none.
const SourceKind& source_kind_of(const std::filesystem::path& path, const SourceOptions& options);

/// Opens a file or folder of any kind. Throws Error if it is of none, for an unknown kind, for an option that
/// the kind does not take, and as the kind does.
std::unique_ptr<FrameSource> open_source(const std::filesystem::path& path,
                                         const SourceOptions& options = {});

}  // namespace stdc
