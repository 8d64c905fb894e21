#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "segmentation/mask_list.hpp"
#include "segmentation/segmenter.hpp"
#include "slam/settings.hpp"

namespace stdc {

/// Where the segmenters find what they need.
struct SegmenterFiles {
  std::filesystem::path weights;  ///< of the network, .safetensors or .onnx; empty: those that ship
  std::filesystem::path masks;    ///< folder of mask images
  std::optional<std::vector<MaskFile>>
      found_masks;                           ///< those in it that belong to the frames, if it is known
  std::vector<std::string> dynamic_classes;  ///< of the network, by name; empty: as the weights say
};

/// The segmenter that the settings ask for; null if segmentation is off. Throws Error if weights or masks are
/// missing or wrong.
/// @param rotation  Camera::rotation: the network is shown the images upright
std::unique_ptr<Segmenter> make_segmenter(const Settings& settings, const SegmenterFiles& files,
                                          int rotation = 0);

}  // namespace stdc
