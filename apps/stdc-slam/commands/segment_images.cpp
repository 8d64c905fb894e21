#include "commands/segment_images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "core/error.hpp"
#include "core/image_codec.hpp"
#include "core/image_size.hpp"
#include "core/text_file.hpp"
#include "input/layouts/tum_sequence.hpp"
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

std::vector<SegmentImage> list_folder(const fs::path& folder) {
  std::vector<SegmentImage> images;
  std::vector<std::string> left_out;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    const std::string extension = extension_of(entry.path());
    if (is_one_of(kRead, extension)) images.push_back({entry.path(), entry.path().stem().string(), {}});
    if (is_one_of(kNotRead, extension)) left_out.push_back(entry.path().filename().string());
  }
  if (!left_out.empty() && !images.empty()) {
    fmt::print(stderr, "stdc-slam: {}: {} images are neither PNG nor JPEG and are left out, such as {}\n",
               folder.string(), left_out.size(), *std::min_element(left_out.begin(), left_out.end()));
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

}  // namespace stdc::app
