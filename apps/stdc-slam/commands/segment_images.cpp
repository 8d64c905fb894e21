#include "commands/segment_images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "core/image_codec.hpp"
#include "core/image_size.hpp"
#include "core/text_file.hpp"
#include "input/layouts/tum_sequence.hpp"
#include "run/frame_range.hpp"
#include "run/sequence_input.hpp"
#include "segmentation/mask_file_segmenter.hpp"

namespace stdc::app {
namespace {

namespace fs = std::filesystem;

bool is_image_name(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char letter) {
    return static_cast<char>(letter >= 'A' && letter <= 'Z' ? letter + 32 : letter);
  });
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

std::vector<SegmentImage> list_folder(const fs::path& folder) {
  std::vector<SegmentImage> images;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_image_name(entry.path())) {
      images.push_back({entry.path(), entry.path().stem().string(), {}});
    }
  }
  std::sort(images.begin(), images.end(),
            [](const SegmentImage& a, const SegmentImage& b) { return a.path < b.path; });
  for (std::size_t i = 1; i < images.size(); ++i) {
    if (images[i].name == images[i - 1].name) {
      throw Error(images[i].path.string(), "there is another image of this name", "rename one of them");
    }
  }
  return images;
}

std::vector<SegmentImage> list_all(const fs::path& input) {
  std::error_code fault;
  if (fs::is_regular_file(input, fault)) return {{input, input.stem().string(), {}}};
  if (!fs::is_directory(input, fault)) {
    throw Error(input.string(), "there is no such image or folder",
                "give an image, a folder of images or a sequence");
  }
  if (!fs::exists(input / "rgb.txt", fault)) return list_folder(input);
  std::vector<SegmentImage> images;
  const TumSequence sequence(input);
  for (const SequenceFrame& frame : sequence.frames()) {
    images.push_back({frame.colour, frame.colour.stem().string(), frame.timestamp});
  }
  return images;
}

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

std::vector<SegmentImage> list_segment_images(const fs::path& input, const std::string& range) {
  const std::vector<SegmentImage> images = list_all(input);
  if (images.empty()) throw Error(input.string(), "holds no PNG or JPEG images", "give a folder with images");
  const auto [first, end] = parse_frame_range(range, static_cast<int>(images.size()));
  return {images.begin() + first, images.begin() + end};
}

StoredImage load_segment_image(const fs::path& path) {
  const std::string text = read_file(path, "restore the image or leave it out");
  const Bytes bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  const auto size = image_size(bytes);
  if (!size)
    throw Error(path.string(), "is neither a PNG nor a JPEG, or its header is damaged", "convert it");
  const DecodedImage decoded = decode_colour(bytes, *size, ColourMode::as_stored);
  if (!decoded.problem.empty())
    throw Error(path.string(), decoded.problem, "restore the image or leave it out");
  return {decoded.image, exif_orientation(bytes)};
}

std::optional<TruthMask> load_truth(const fs::path& folder, const SegmentImage& image, cv::Size size,
                                    TruthKind kind, Orientation orientation) {
  const cv::Size turned(size.height, size.width);
  if (swaps_sides(orientation) && size_of(folder / (image.name + ".png")) == turned) {
    std::optional<TruthMask> truth = load_truth(folder, image, turned, kind);
    if (!truth) return truth;
    truth->mask = from_upright(truth->mask, orientation);
    if (!truth->ignore.empty()) truth->ignore = from_upright(truth->ignore, orientation);
    return truth;
  }
  if (kind == TruthKind::masks && image.timestamp) {
    const std::vector<MaskFile> masks = list_masks(folder);
    const MaskFile* file = find_mask(masks, *image.timestamp, MaskFileSegmenter::kTolerance);
    if (file == nullptr) return std::nullopt;
    const cv::Mat mask = load_mask(*file, size_of(file->path).value_or(size));
    return TruthMask{fit_truth(mask, size, file->path), {}};
  }
  const fs::path path = folder / (image.name + ".png");
  auto stored = load_grey(path);
  if (!stored) return std::nullopt;
  constexpr double kDoubt = 255;
  if (kind == TruthKind::labels) *stored = fit_truth(*stored, size, path);
  if (kind == TruthKind::labels) return TruthMask{(*stored != 0) & (*stored != kDoubt), *stored == kDoubt};
  return TruthMask{fit_truth(load_mask({0, path, 0}, stored->size()), size, path), {}};
}

}  // namespace stdc::app
