#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "input/frame_source.hpp"

namespace stdc {

/// How a source is to be opened.
struct SourceOptions {
  std::string kind;            ///< one of source_kinds(); empty: found by looking
  std::optional<double> rate;  ///< [Hz] takes the order of the images for the time, in place of their stamps
  /// Topics of recordings; empty: found by looking, if there is one sensible choice.
  std::string colour_topic, depth_topic, colour_info_topic, depth_info_topic, imu_topic;

  bool has_topic() const {
    return !(colour_topic.empty() && depth_topic.empty() && colour_info_topic.empty() &&
             depth_info_topic.empty() && imu_topic.empty());
  }
};

/// A kind of input.
struct SourceKind {
  const char* name;   ///< for --input-kind: "tum"
  const char* title;  ///< "folder in TUM RGB-D layout"
  /// Whether a path looks like one, at little cost; never throws.
  bool (*matches)(const std::filesystem::path& path);
  /// Throws Error for whatever is wrong with it.
  std::unique_ptr<FrameSource> (*open)(const std::filesystem::path& path, const SourceOptions& options);
  bool takes_rate = false, takes_topics = false;
};

/// All kinds, the first that matches counts.
std::span<const SourceKind> source_kinds();
/// "tum, euroc, ...", for help and hints.
std::string source_kind_names();

/// Opens a file or folder of any kind. Throws Error if it is of none, for an unknown kind, for an option that
/// the kind does not take, and as the kind does.
std::unique_ptr<FrameSource> open_source(const std::filesystem::path& path,
                                         const SourceOptions& options = {});

}  // namespace stdc
