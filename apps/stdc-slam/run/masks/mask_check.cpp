#include "run/masks/mask_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "segmentation/frame_masks.hpp"
#include "segmentation/mask_file_segmenter.hpp"

namespace stdc::app {

namespace {

constexpr const char* kMaskHint =
    "name the masks like the colour images, by their times or numbers, or give the folder that belongs to "
    "the sequence";

std::string image_names(const std::vector<MaskedFrame>& frames) {
  const auto name = [](const MaskedFrame& frame) {
    return frame.name.empty() ? fmt::format("{:.6f}", frame.timestamp) : frame.name;
  };
  return fmt::format("{} to {}", name(frames.front()), name(frames.back()));
}

}  // namespace

std::optional<std::vector<MaskFile>> masks_of_input(const std::filesystem::path& folder,
                                                    const SequenceInput& input) {
  const auto frames = input.masked_frames();
  if (!frames || frames->empty()) {
    list_masks(folder);
    return std::nullopt;
  }
  FrameMasks found = find_frame_masks(folder, *frames);
  if (found.files == 0) list_masks(folder);  // says what is expected
  if (found.masks.empty()) {
    throw Error(folder.string(),
                fmt::format("none of its {} masks has the name, time or number of an image (images: {})",
                            found.files, image_names(*frames)),
                kMaskHint);
  }
  const bool guessed = found.found_by.starts_with("number");
  if (guessed || found.masks.size() < frames->size()) {
    fmt::print(stderr, "stdc-slam: {}: {} of {} images have a mask, found by {}\n", folder.string(),
               found.masks.size(), frames->size(), found.found_by);
  }
  return std::move(found.masks);
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
      kMaskHint);
}

}  // namespace stdc::app
