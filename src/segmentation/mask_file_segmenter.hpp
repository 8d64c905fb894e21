#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include "segmentation/mask_list.hpp"
#include "segmentation/segmenter.hpp"

namespace stdc {

/// Takes the masks from files: ground truth of rendered sequences, or what another program made.
class MaskFileSegmenter final : public Segmenter {
 public:
  /// How far the time of a mask may be from that of the colour image [s].
  static constexpr double kTolerance = 1e-3;

  /// `folder`: see list_masks(). Throws Error as that does; the masks themselves are read when they are asked
  /// for.
  explicit MaskFileSegmenter(const std::filesystem::path& folder);

  /// `masks`: of the frames, by time, as find_frame_masks() gives them.
  explicit MaskFileSegmenter(std::vector<MaskFile> masks) : masks_(std::move(masks)) {}

  /// Pixels of 128 and above are dynamic. Files are PNGs with one channel of up to 8 bits and the size of the
  /// colour image.
  /// @returns CV_8UC1, 255 = dynamic; an empty image if there is no mask for that time: the frame is not
  /// segmented, which is not the same as a mask of zeros
  /// Throws Error naming the file if it is missing, damaged, of another size or kind, or holds labels (not
  /// zero, but nothing of 128 and above).
  cv::Mat segment(const SegmenterInput& input) override;

 private:
  std::vector<MaskFile> masks_;
};

/// Reads one mask as MaskFileSegmenter::segment does.
cv::Mat load_mask(const MaskFile& file, cv::Size size);

}  // namespace stdc
