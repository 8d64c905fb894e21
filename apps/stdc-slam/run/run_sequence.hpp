#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "commands/segmentation_options.hpp"
#include "commands/settings_options.hpp"

namespace stdc::app {

/// What `stdc-slam run` was asked to do.
struct RunOptions {
  std::filesystem::path sequence, output;
  std::optional<std::filesystem::path> camera, debug_images, save_masks, true_masks, inpaint;
  std::optional<std::filesystem::path> load_map, save_map;
  SettingsOptions settings;
  SegmentationOptions segmentation;
  std::optional<double> rate;      ///< [Hz] takes the order of the lines for the time
  std::string frames;              ///< "A:B": frames A..B-1 of the sequence; either may be missing
  int debug_every = 10;            ///< a picture of every n-th frame
  bool localisation_only = false;  ///< leave the loaded map as it is
  bool realtime = false;           ///< frames come at the pace of their timestamps
  bool inpaint_all = false;        ///< fill the background from later frames too
  bool quiet = false;
};

/// Runs on a sequence and writes the results. Throws Error for bad input; then nothing is written.
/// @return whether any frame got a pose; if none did, that is said on stderr and no map is saved
bool run_sequence(const RunOptions& options);

}  // namespace stdc::app
