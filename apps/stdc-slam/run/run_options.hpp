#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "commands/options/segmentation_options.hpp"
#include "commands/options/settings_options.hpp"
#include "run/dense/run_dense.hpp"
#include "run/live_view.hpp"
#include "run/sequence_input.hpp"

namespace stdc::app {

/// What `stdc-slam run` was asked to do.
struct RunOptions {
  InputOptions input;
  std::filesystem::path output;
  std::optional<std::filesystem::path> debug_images, save_masks, true_masks, inpaint;
  std::optional<std::filesystem::path> load_map, save_map;
  DenseOptions dense;
  LiveViewOptions view;
  SettingsOptions settings;
  SegmentationOptions segmentation;
  int debug_every = 10;            ///< a picture of every n-th frame
  bool localisation_only = false;  ///< leave the loaded map as it is
  bool realtime = false;           ///< frames come at the pace of their timestamps
  bool inpaint_all = false;        ///< fill the background from later frames too
  bool no_report = false;          ///< leave out report.html
  bool quiet = false;
};

}  // namespace stdc::app
