#pragma once

#include <filesystem>
#include <vector>

#include "run/sequence_input.hpp"
#include "segmentation/mask_list.hpp"

namespace stdc::app {

/// Throws Error if no mask of a folder has the time of an image of the sequence: they would be passed over
/// frame by frame. Also as list_masks() does. Where the times are not known before the frames are read, only
/// that.
void check_masks(const std::filesystem::path& folder, const SequenceInput& input);
/// The same with the times of the images [s].
void check_masks(const std::filesystem::path& folder, const std::vector<MaskFile>& masks,
                 const std::vector<double>& times);

}  // namespace stdc::app
