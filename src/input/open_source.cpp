#include "input/open_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "core/error.hpp"
#include "core/lower_case.hpp"
#include "input/layouts/layouts.hpp"
#include "input/layouts/scannet/sens_file.hpp"
#include "input/layouts/tum_source.hpp"
#include "input/layouts/video_folder.hpp"
#include "input/live/openni_source.hpp"
#include "input/recordings/recording_source.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

// A kind that is recognised by more comes before one that is recognised by less.
constexpr std::array kKinds{
    SourceKind{"openni2", "camera by OpenNI 2, live: openni2: for the first one, or openni2:URI",
               is_openni_device, open_openni_device, false, false, true},
    SourceKind{"tum", "folder in TUM RGB-D layout: rgb.txt, depth.txt (also BONN, ETH3D)", is_tum_folder,
               open_tum_folder, true},
    SourceKind{"openloris", "folder of OpenLORIS-Scene: color.txt, aligned_depth.txt", is_openloris,
               open_openloris},
    SourceKind{"icl-nuim", "folder of ICL-NUIM: associations.txt", is_icl_nuim, open_icl_nuim, true},
    SourceKind{"7-scenes", "folder of 7-Scenes: frame-000000.color.png", is_seven_scenes, open_seven_scenes,
               true},
    SourceKind{"scannet", "folder of ScanNet: color, depth, pose, intrinsic", is_scannet, open_scannet, true},
    SourceKind{"sens", "file of ScanNet (.sens)", is_sens_file, open_sens_file, true},
    SourceKind{"stray-scanner", "folder of Stray Scanner: odometry.csv, depth, rgb.mp4", is_stray_scanner,
               open_stray_scanner},
    SourceKind{"record3d", "folder of Record3D, exported as EXR + JPG: metadata.json, rgb, depth",
               is_record3d, open_record3d, true},
    SourceKind{"euroc", "folder in EuRoC layout: cam0/data.csv, with depth0", is_euroc, open_euroc, true},
    SourceKind{"open3d", "folder of Open3D or Redwood: color (image, rgb; or one video), depth", is_open3d,
               open_open3d, true},
    SourceKind{"mcap", "MCAP recording of ROS 2 or ROS 1, or a folder of rosbag2 with such files",
               is_mcap_recording, open_recording_source, false, true},
    SourceKind{"db3", "SQLite recording of ROS 2, or a folder of rosbag2 with such files", is_db3_recording,
               open_recording_source, false, true},
    SourceKind{"bag", "bag of ROS 1, also of RealSense", is_bag_recording, open_recording_source, false,
               true},
};

void check_options(const SourceKind& kind, const fs::path& path, const SourceOptions& options) {
  if (options.rate && !kind.takes_rate) {
    throw Error("--rate",
                fmt::format("{} is of the kind {}, whose times are its own", path.string(), kind.name),
                "leave it out");
  }
  if (options.has_topic() && !kind.takes_topics) {
    throw Error(path.string(), fmt::format("is of the kind {}, which has no topics", kind.name),
                "leave the topics out");
  }
}

const SourceKind& kind_named(const std::string& name) {
  const auto* kind =
      std::find_if(kKinds.begin(), kKinds.end(), [&](const SourceKind& k) { return name == k.name; });
  if (kind == kKinds.end()) {
    throw Error("--input-kind", fmt::format("there is no kind '{}'", name),
                "give one of " + source_kind_names());
  }
  return *kind;
}

std::string ending_of(const fs::path& path) { return lower_case(path.extension().string()); }

/// What is known and cannot be read gets an answer of its own.
void refuse_known(const fs::path& path) {
  std::error_code ignored;
  if ((ending_of(path) == ".r3d" && fs::is_regular_file(path, ignored)) ||
      fs::exists(path / "rgbd" / "0.depth", ignored)) {
    throw Error(path.string(),
                "is a recording of Record3D, whose depth is packed by LZFSE, which cannot be read here",
                "export it in the app as 'EXR + JPG' and give that folder");
  }
  if (is_video(path)) {
    throw Error(path.string(), "is a video without depth images",
                "give the folder that holds it and a folder depth with them (docs/inputs.md)");
  }
  if (const auto videos = videos_in(path); videos.size() > 1 && fs::is_directory(path / "depth", ignored)) {
    throw Error(path.string(),
                fmt::format("holds several videos: {} and {}", videos[0].filename().string(),
                            videos[1].filename().string()),
                "leave only that of the colour images there");
  }
}

const SourceKind& kind_of(const fs::path& path) {
  if (const SourceKind* kind = recognise_source(path)) return *kind;
  refuse_known(path);
  std::error_code ignored;
  if (fs::is_regular_file(path, ignored)) {
    throw Error(
        path.string(), "is no recording of a kind that can be read",
        "see docs/inputs.md for the kinds, or name one by --input-kind (" + source_kind_names() + ")");
  }
  return kind_named("tum");  // which says what is missing
}

}  // namespace

std::span<const SourceKind> source_kinds() { return kKinds; }

std::string source_kind_names() {
  std::string names;
  for (const SourceKind& kind : kKinds) names += (names.empty() ? "" : ", ") + std::string(kind.name);
  return names;
}

const SourceKind* recognise_source(const fs::path& path) {
  const auto* kind =
      std::find_if(kKinds.begin(), kKinds.end(), [&](const SourceKind& k) { return k.matches(path); });
  return kind == kKinds.end() ? nullptr : &*kind;
}

const SourceKind& source_kind_of(const fs::path& path, const SourceOptions& options) {
  return options.kind.empty() ? kind_of(path) : kind_named(options.kind);
}

std::unique_ptr<FrameSource> open_source(const fs::path& path, const SourceOptions& options) {
  const SourceKind& kind = source_kind_of(path, options);
  check_options(kind, path, options);
  return kind.open(path, options);
}

}  // namespace stdc
