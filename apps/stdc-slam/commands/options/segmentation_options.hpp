#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands/command.hpp"
#include "core/images/image_codec.hpp"
#include "segmentation/mask_list.hpp"
#include "segmentation/segmenter.hpp"
#include "slam/settings.hpp"

namespace stdc::app {

/// The options by which commands choose where masks come from.
struct SegmentationOptions {
  std::string source;                         ///< --segmentation off|network|masks; empty: as in the settings
  std::string refinement;                     ///< --refinement on|off; empty: as in the settings
  std::optional<std::string> masks, weights;  ///< --masks FOLDER, --weights FILE
  std::vector<std::string> dynamic_classes;   ///< --dynamic CLASS,...
};

/// Adds --dynamic.
void add_dynamic_option(Command command, std::vector<std::string>& classes);
/// Adds --segmentation, --refinement, --masks, --weights and --dynamic to a command.
void add_segmentation_options(Command command, SegmentationOptions& options);
/// Changes the settings as the options say. Throws Error.
void apply_segmentation_options(const SegmentationOptions& options, Settings& settings);
/// Throws Error for options that can have no effect with these settings.
void check_segmentation_options(const SegmentationOptions& options, const Settings& settings);
/// Only the network looks at colours; without it, grey is decoded faster.
ColourMode colour_mode(const Settings& settings);
/// Where masks from files are: --masks, else the folder `mask` of the sequence.
std::filesystem::path mask_folder(const SegmentationOptions& options, const std::filesystem::path& sequence);
/// The segmenter that the settings ask for; null if segmentation is off.
/// @param rotation  Camera::rotation
/// @param masks     those of mask_folder() that belong to the frames, if that is known
/// Throws Error if its weights or masks are missing or wrong.
std::unique_ptr<Segmenter> chosen_segmenter(const SegmentationOptions& options, const Settings& settings,
                                            const std::filesystem::path& sequence, int rotation,
                                            std::optional<std::vector<MaskFile>> masks = {});

}  // namespace stdc::app
