#include "commands/segment/segment_images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "core/images/image_codec.hpp"
#include "core/images/image_size.hpp"
#include "run/frame_range.hpp"

namespace stdc::app {
namespace {

namespace fs = std::filesystem;

constexpr std::array kRead{".png", ".jpg", ".jpeg"};
constexpr std::array kNotRead{".avif", ".bmp", ".gif", ".heic", ".heif", ".jp2", ".pgm",
                              ".pnm",  ".ppm", ".tga", ".tif",  ".tiff", ".webp"};

std::string extension_of(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char letter) {
    return static_cast<char>(letter >= 'A' && letter <= 'Z' ? letter + 32 : letter);
  });
  return extension;
}

bool is_one_of(const auto& extensions, const std::string& extension) {
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

SegmentImage image_of(const fs::path& path) {
  return {path.string(), path.stem().string(), {}, [path] { return load_segment_image(path); }};
}

std::vector<SegmentImage> list_folder(const fs::path& folder) {
  std::vector<SegmentImage> images;
  std::vector<std::string> left_out;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    const std::string extension = extension_of(entry.path());
    if (is_one_of(kRead, extension)) images.push_back(image_of(entry.path()));
    if (is_one_of(kNotRead, extension)) left_out.push_back(entry.path().filename().string());
  }
  if (!left_out.empty() && !images.empty()) {
    fmt::print(stderr, "stdc-slam: {}: {} images are neither PNG nor JPEG and are left out, such as {}\n",
               folder.string(), left_out.size(), *std::min_element(left_out.begin(), left_out.end()));
  }
  std::sort(images.begin(), images.end(), [](const SegmentImage& a, const SegmentImage& b) {
    return fs::path(a.where) < fs::path(b.where);
  });
  for (std::size_t i = 1; i < images.size(); ++i) {
    if (images[i].name == images[i - 1].name) {
      throw Error(images[i].where, "there is another image of this name", "rename one of them");
    }
  }
  return images;
}

std::vector<SegmentImage> list_files(const fs::path& input) {
  std::error_code fault;
  if (fs::is_regular_file(input, fault)) return {image_of(input)};
  if (fs::is_directory(input, fault)) return list_folder(input);
  throw Error(input.string(), "there is no such image or folder",
              "give an image, a folder of images or a sequence");
}

}  // namespace

SegmentImages::SegmentImages(const InputOptions& input) {
  std::error_code fault;
  // What has a list of colour images is meant to be a sequence.
  const bool sequence = !input.source.kind.empty() || recognise_source(input.path) != nullptr ||
                        fs::exists(input.path / "rgb.txt", fault);
  if (sequence) {
    source_ = open_source(input.path, input.source);
    for (const std::string& note : source_->notes()) fmt::print(stderr, "stdc-slam: {}\n", note);
    range_ = parse_frame_range(input.frames, source_->frame_count());
    for (; at_ < range_.first; ++at_) source_->next();
    return;
  }
  files_ = list_files(input.path);
  if (files_.empty()) {
    throw Error(input.path.string(), "holds no PNG or JPEG images", "give a folder with images");
  }
  range_ = parse_frame_range(input.frames, static_cast<int>(files_.size()));
  at_ = range_.first;
}

std::optional<int> SegmentImages::count() const {
  if (!range_.end) return std::nullopt;
  return *range_.end - range_.first;
}

std::optional<Camera> SegmentImages::camera() const {
  if (!source_) return std::nullopt;
  const auto cameras = source_->cameras();
  return cameras ? std::optional(cameras->colour) : std::nullopt;
}

std::optional<SegmentImage> SegmentImages::next() {
  if (range_.end && at_ == *range_.end) return std::nullopt;
  if (!source_) return files_[static_cast<std::size_t>(at_++)];
  const auto frame = source_->next();
  if (!frame) return std::nullopt;
  ++at_;
  return SegmentImage{frame->where, frame->name, frame->timestamp, [images = frame->images] {
                        return StoredImage{images->colour({}, ColourMode::as_stored), Orientation::upright};
                      }};
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

}  // namespace stdc::app
