#include "run/mask_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "segmentation/mask_file_segmenter.hpp"

namespace stdc::app {

void check_masks(const std::filesystem::path& folder, const SequenceInput& input) {
  const std::vector<MaskFile> masks = list_masks(folder);
  const std::optional<std::vector<double>> times = input.frame_times();
  if (times) check_masks(folder, masks, *times);
}

void check_masks(const std::filesystem::path& folder, const std::vector<MaskFile>& masks,
                 const std::vector<double>& times) {
  const bool any = std::any_of(times.begin(), times.end(), [&](double time) {
    return find_mask(masks, time, MaskFileSegmenter::kTolerance) != nullptr;
  });
  if (any || times.empty()) return;
  throw Error(
      folder.string(),
      fmt::format("none of its {} masks has the time of an image (masks: {:.3f} to {:.3f} s, images: {:.3f} "
                  "to {:.3f} s)",
                  masks.size(), masks.front().timestamp, masks.back().timestamp, times.front(), times.back()),
      "name the masks like the colour images, or give the folder that belongs to the sequence");
}

}  // namespace stdc::app
