#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "run/sequence_input.hpp"
#include "segmentation/mask_list.hpp"

namespace stdc::app {

/// The masks of a folder that belong to the chosen frames of an input, see find_frame_masks(); says on stderr
/// if only some of the frames have one, or if they were found by numbers. Throws Error if none has: they
/// would be passed over frame by frame. Where the frames are not known before they are read: nothing.
std::optional<std::vector<MaskFile>> masks_of_input(const std::filesystem::path& folder,
                                                    const SequenceInput& input);
/// Throws Error if no mask has one of these times [s].
void check_masks(const std::filesystem::path& folder, const std::vector<MaskFile>& masks,
                 const std::vector<double>& times);

}  // namespace stdc::app
