#include "run/run_checks.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "core/error.hpp"

namespace stdc::app {

void check_map_options(const RunOptions& options, const Settings& settings) {
  if (settings.system.localisation_only && !options.load_map) {
    throw Error("--localisation-only", "there is no map to find the camera in",
                "give one by --load-map FILE");
  }
  if (settings.system.localisation_only && options.save_map) {
    throw Error("--save-map", "with --localisation-only the map stays as it is", "leave out one of the two");
  }
}

void check_place_for_map(const RunOptions& options) {
  if (!options.save_map) return;
  std::error_code failed;
  if (std::filesystem::is_directory(*options.save_map, failed)) {
    throw Error(options.save_map->string(), "is a folder", "give a file to --save-map");
  }
  const std::filesystem::path folder = std::filesystem::absolute(*options.save_map, failed).parent_path();
  if (access(folder.c_str(), W_OK) != 0) {
    throw Error(options.save_map->string(),
                fmt::format("cannot be written ({})", std::generic_category().message(errno)),
                "check that its folder exists and may be written to");
  }
}

void check_inpainting(const RunOptions& options, const Settings& settings) {
  if (!options.inpaint) return;
  if (settings.segmentation.source == SegmentationSource::off &&
      settings.motion.method == MotionMethod::off) {
    throw Error("--inpaint", "there is nothing to inpaint: nobody looks for what moves",
                "choose --motion or --segmentation, or leave out --inpaint");
  }
}

void check_live(const RunOptions& options, const SequenceInput& input) {
  if (!input.source().is_live()) return;
  if (options.inpaint) {
    throw Error("--inpaint", "needs the frames a second time, and a camera gives them once",
                "record them first: stdc-slam record");
  }
  if (options.realtime) throw Error("--realtime", "a camera has a pace of its own", "leave it out");
}

void check_apart(const RunOptions& options, const InpaintedFolder& inpainted) {
  for (const std::optional<std::filesystem::path>& other :
       {std::optional(options.output), options.save_masks, options.debug_images}) {
    if (!other) continue;
    const std::filesystem::path inside =
        std::filesystem::absolute(*other).lexically_normal().lexically_relative(inpainted.path());
    if (inside.empty() || *inside.begin() == "..") continue;
    throw Error(other->string(), "other results cannot be put into the folder of --inpaint",
                "give folders beside each other");
  }
}

}  // namespace stdc::app
