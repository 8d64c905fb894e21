#include "commands/segment/truth_masks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "core/images/image_codec.hpp"
#include "core/images/image_size.hpp"
#include "segmentation/mask_file_segmenter.hpp"

namespace stdc::app {
namespace {

namespace fs = std::filesystem;

/// The size that an image file says it has; nothing if there is none.
std::optional<cv::Size> size_of(const fs::path& path) {
  std::error_code fault;
  if (!fs::exists(path, fault)) return std::nullopt;
  const std::string text = read_file(path, "make it readable");
  return image_size(Bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

/// Brings a true mask of another size to that of its image, if it has the same shape within 1 %.
cv::Mat fit_truth(const cv::Mat& truth, cv::Size size, const fs::path& path) {
  if (truth.size() == size) return truth;
  const double wide = static_cast<double>(truth.cols) * size.height;
  const double high = static_cast<double>(truth.rows) * size.width;
  if (std::abs(wide - high) > 0.01 * high) {
    throw Error(path.string(),
                fmt::format("is a mask of {} x {} pixels, of another shape than its image of {} x {}",
                            truth.cols, truth.rows, size.width, size.height),
                "give true masks of the image's size, or scaled copies of it");
  }
  cv::Mat scaled;
  cv::resize(truth, scaled, size, 0, 0, cv::INTER_NEAREST);
  return scaled;
}

/// A grey PNG as stored; nothing if there is no file.
std::optional<cv::Mat> load_grey(const fs::path& path) {
  std::error_code fault;
  if (!fs::exists(path, fault)) return std::nullopt;
  const std::string text = read_file(path, "make it readable");
  const Bytes bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  constexpr const char* kHint = "give an 8-bit grey PNG of the image's size";
  if (!is_png(bytes) || !image_size(bytes)) throw Error(path.string(), "is not a PNG", kHint);
  const DecodedImage decoded = decode_png_colour(bytes, *image_size(bytes), ColourMode::as_stored);
  if (!decoded.problem.empty()) throw Error(path.string(), decoded.problem, kHint);
  if (decoded.image.channels() != 1) throw Error(path.string(), "is a colour image", kHint);
  return decoded.image;
}

}  // namespace

TruthMasks::TruthMasks(fs::path folder, TruthKind kind) : folder_(std::move(folder)), kind_(kind) {}

std::optional<TruthMask> TruthMasks::load(const SegmentImage& image, cv::Size size, Orientation orientation) {
  const cv::Size turned(size.height, size.width);
  if (swaps_sides(orientation) && size_of(folder_ / (image.name + ".png")) == turned) {
    std::optional<TruthMask> truth = load(image, turned, Orientation::upright);
    if (!truth) return truth;
    truth->mask = from_upright(truth->mask, orientation);
    if (!truth->ignore.empty()) truth->ignore = from_upright(truth->ignore, orientation);
    return truth;
  }
  if (kind_ == TruthKind::masks && image.timestamp) {
    if (!by_time_) by_time_ = list_masks(folder_);
    const MaskFile* file = find_mask(*by_time_, *image.timestamp, MaskFileSegmenter::kTolerance);
    if (file == nullptr) return std::nullopt;
    const cv::Mat mask = load_mask(*file, size_of(file->path).value_or(size));
    return TruthMask{fit_truth(mask, size, file->path), {}};
  }
  const fs::path path = folder_ / (image.name + ".png");
  auto stored = load_grey(path);
  if (!stored) return std::nullopt;
  if (kind_ == TruthKind::labels) {
    constexpr double kDoubt = 255;
    const cv::Mat labels = fit_truth(*stored, size, path);
    return TruthMask{(labels != 0) & (labels != kDoubt), labels == kDoubt};
  }
  return TruthMask{fit_truth(load_mask({0, path, 0}, stored->size()), size, path), {}};
}

}  // namespace stdc::app
