#include "commands/options/segmentation_options.hpp"

#include <utility>

#include "core/error.hpp"
#include "slam/make_segmenter.hpp"
#include "slam/settings_io.hpp"

namespace stdc::app {

void add_dynamic_option(Command command, std::vector<std::string>& classes) {
  command
      .add_option(
          "--dynamic", classes,
          "Classes of the network that count as dynamic, such as person,animal; default: as the weights say")
      .delimiter(',')
      .type_name("CLASS,...");
}

void add_segmentation_options(Command command, SegmentationOptions& options) {
  command
      .add_option("--segmentation", options.source,
                  "Where masks of people come from: off, network, or masks (files)")
      .type_name("off|network|masks");
  command.add_option(
      "--masks", options.masks,
      "Folder of mask images, above 127 = dynamic, named like the colour images, by their times or by "
      "the frames' numbers; default: mask/ in the sequence");
  command.add_option(
      "--weights", options.weights,
      "Weights of the network, or which of those that ship: slim, wide, or permissive; default: slim");
  add_dynamic_option(command, options.dynamic_classes);
  command.add_option("--refinement", options.refinement, "Complete masks by depth (SRM): on or off")
      .type_name("on|off");
}

void apply_segmentation_options(const SegmentationOptions& options, Settings& settings) {
  std::string source = options.source;
  // Whoever names masks or weights wants them used.
  if (source.empty() && options.masks) source = "masks";
  if (source.empty() && (options.weights || !options.dynamic_classes.empty())) source = "network";
  if (!source.empty()) apply_setting("segmentation.source=" + source, settings);
  if (!options.refinement.empty()) apply_setting("segmentation.refinement=" + options.refinement, settings);
}

void check_segmentation_options(const SegmentationOptions& options, const Settings& settings) {
  const SegmentationSource source = settings.segmentation.source;
  if (options.masks && source != SegmentationSource::masks) {
    throw Error("--masks", "is of no use, masks do not come from files",
                "add --segmentation masks or leave it out");
  }
  if (options.weights && source != SegmentationSource::network) {
    throw Error("--weights", "is of no use without the network",
                "add --segmentation network or leave it out");
  }
  if (!options.dynamic_classes.empty() && source != SegmentationSource::network) {
    throw Error("--dynamic", "is of no use without the network",
                "add --segmentation network or leave it out");
  }
  if (!options.refinement.empty() && source == SegmentationSource::off) {
    throw Error("--refinement", "is of no use, segmentation is off", "leave one of the two out");
  }
}

ColourMode colour_mode(const Settings& settings) {
  return settings.segmentation.source == SegmentationSource::network ? ColourMode::as_stored
                                                                     : ColourMode::grey;
}

std::filesystem::path mask_folder(const SegmentationOptions& options, const std::filesystem::path& sequence) {
  return options.masks ? std::filesystem::path(*options.masks) : sequence / "mask";
}

std::unique_ptr<Segmenter> chosen_segmenter(const SegmentationOptions& options, const Settings& settings,
                                            const std::filesystem::path& sequence, int rotation,
                                            std::optional<std::vector<MaskFile>> masks) {
  SegmenterFiles files;
  files.weights = options.weights.value_or("");
  files.masks = mask_folder(options, sequence);
  files.found_masks = std::move(masks);
  files.dynamic_classes = options.dynamic_classes;
  return make_segmenter(settings, files, rotation);
}

}  // namespace stdc::app
