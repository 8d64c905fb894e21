#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "segmentation/mask_list.hpp"

namespace stdc {

/// What a mask may be named by.
struct MaskedFrame {
  double timestamp = 0;  ///< of its colour image [s]
  std::string name;      ///< stem of its colour image's file; empty: it has none
  int number = 0;        ///< in the whole sequence, from 0
};

/// The masks of some frames.
struct FrameMasks {
  std::vector<MaskFile> masks;  ///< by time, each with the time of its frame
  int files = 0;                ///< masks in the folder
  std::string found_by;         ///< in words: "time", "number, counted from 1"
};

/// Finds the masks of a folder that belong to frames. If it has a mask.txt, by the times in there, as
/// list_masks() does; else by the names of the PNG files: that of the colour image, its time (seconds with
/// any number of decimals, or whole milli-, micro- or nanoseconds), or the frame's number ("000012.png",
/// "mask_12.png"; from 0, or from 1 if that is what all numbers fit). Times are found within a millisecond,
/// or within the last decimal of the name down to a hundredth. Throws Error as list_masks() does, but for a
/// folder without masks of these frames.
FrameMasks find_frame_masks(const std::filesystem::path& folder, const std::vector<MaskedFrame>& frames);

}  // namespace stdc
