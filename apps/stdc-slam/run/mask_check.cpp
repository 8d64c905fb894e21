#include "run/mask_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "segmentation/mask_file_segmenter.hpp"

namespace stdc::app {

void check_masks(const std::filesystem::path& folder, const SequenceInput& input) {
  const std::vector<MaskFile> masks = list_masks(folder);
  const bool any = std::any_of(input.frames.begin(), input.frames.end(), [&](const SequenceFrame& frame) {
    return find_mask(masks, frame.timestamp, MaskFileSegmenter::kTolerance) != nullptr;
  });
  if (any) return;
  throw Error(
      folder.string(),
      fmt::format("none of its {} masks has the time of an image (masks: {:.3f} to {:.3f} s, images: {:.3f} "
                  "to {:.3f} s)",
                  masks.size(), masks.front().timestamp, masks.back().timestamp,
                  input.frames.front().timestamp, input.frames.back().timestamp),
      "name the masks like the colour images, or give the folder that belongs to the sequence");
}

}  // namespace stdc::app
