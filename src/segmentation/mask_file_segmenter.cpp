#include "segmentation/mask_file_segmenter.hpp"

#include <fmt/format.h>

#include <opencv2/core.hpp>

#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "core/images/image_codec.hpp"

namespace stdc {

cv::Mat load_mask(const MaskFile& file, cv::Size size) {
  constexpr const char* kHint = "write it anew as an 8-bit grey PNG, dynamic pixels 255 and others 0";
  constexpr std::size_t kMaxMask = std::size_t{1} << 28U;
  constexpr double kDynamic = 128;
  const std::string where =
      file.line > 0 ? fmt::format("{} (mask.txt:{})", file.path.string(), file.line) : file.path.string();
  std::string text;
  try {
    text = read_file(file.path, "restore the mask or remove it from the list", kMaxMask);
  } catch (const Error& error) {
    throw Error(where, error.problem(), error.hint());
  }
  const Bytes bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  if (!is_png(bytes)) throw Error(where, "is not a PNG", kHint);
  const DecodedImage decoded = decode_png_colour(bytes, size, ColourMode::as_stored);
  if (!decoded.problem.empty()) throw Error(where, decoded.problem, kHint);
  if (decoded.image.channels() != 1) throw Error(where, "is a colour image", kHint);
  double max_level = 0;
  cv::minMaxLoc(decoded.image, nullptr, &max_level);
  if (max_level > 0 && max_level < kDynamic) {
    throw Error(where, fmt::format("holds labels up to {} instead of a mask", max_level), kHint);
  }
  return decoded.image >= kDynamic;
}

MaskFileSegmenter::MaskFileSegmenter(const std::filesystem::path& folder) : masks_(list_masks(folder)) {}

cv::Mat MaskFileSegmenter::segment(const SegmenterInput& input) {
  const MaskFile* file = find_mask(masks_, input.timestamp, kTolerance);
  return file == nullptr ? cv::Mat() : load_mask(*file, input.colour.size());
}

}  // namespace stdc
