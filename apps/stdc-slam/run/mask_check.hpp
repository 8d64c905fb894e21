#pragma once

#include <filesystem>

#include "run/sequence_input.hpp"

namespace stdc::app {

/// Throws Error if no mask of a folder has the time of an image of the sequence: they would be passed over
/// frame by frame. Also as list_masks() does.
void check_masks(const std::filesystem::path& folder, const SequenceInput& input);

}  // namespace stdc::app
