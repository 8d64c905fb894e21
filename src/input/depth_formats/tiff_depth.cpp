#include <opencv2/core.hpp>

#include "input/depth_formats/depth_formats.hpp"
#include "input/depth_formats/expected_size.hpp"

#ifdef STDC_WITH_TIFF
#include <tiffio.h>

#include <algorithm>
#include <cstring>
#include <memory>
#endif

namespace stdc {

bool is_tiff(Bytes bytes) {
  if (bytes.size() < 4) return false;
  const bool little = bytes[0] == 'I' && bytes[1] == 'I' && bytes[2] == 42 && bytes[3] == 0;
  return little || (bytes[0] == 'M' && bytes[1] == 'M' && bytes[2] == 0 && bytes[3] == 42);
}

#ifndef STDC_WITH_TIFF

DecodedImage decode_tiff_depth(Bytes, cv::Size) {
  return {cv::Mat(), "is a TIFF, and this program was built without libtiff (libtiff-dev)"};
}

#else

namespace {

/// What libtiff reads from.
struct Memory {
  Bytes bytes;
  toff_t at = 0;
};

Memory& memory_of(thandle_t handle) { return *static_cast<Memory*>(handle); }

tmsize_t tiff_read_memory(thandle_t handle, void* to, tmsize_t count) {
  Memory& memory = memory_of(handle);
  const toff_t left = memory.at < memory.bytes.size() ? memory.bytes.size() - memory.at : 0;
  const auto taken = std::min<toff_t>(static_cast<toff_t>(std::max<tmsize_t>(count, 0)), left);
  if (taken > 0) std::memcpy(to, memory.bytes.data() + memory.at, taken);
  memory.at += taken;
  return static_cast<tmsize_t>(taken);
}

tmsize_t write_nothing(thandle_t, void*, tmsize_t) { return 0; }

toff_t seek_memory(thandle_t handle, toff_t offset, int from) {
  Memory& memory = memory_of(handle);
  if (from == SEEK_SET) memory.at = offset;
  if (from == SEEK_CUR) memory.at += offset;
  if (from == SEEK_END) memory.at = memory.bytes.size() + offset;
  return memory.at;
}

int close_nothing(thandle_t) { return 0; }
toff_t tiff_size_of_memory(thandle_t handle) { return memory_of(handle).bytes.size(); }

/// Silences what libtiff would print.
int tiff_say_nothing(TIFF*, void*, const char*, const char*, va_list) { return 1; }

using Tiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

Tiff open(Memory& memory) {
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(TIFFOpenOptionsAlloc(),
                                                                                 &TIFFOpenOptionsFree);
  constexpr tmsize_t kMaxAllocation = tmsize_t{1} << 28U;
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kMaxAllocation);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), tiff_say_nothing, nullptr);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), tiff_say_nothing, nullptr);
  return {TIFFClientOpenExt("depth", "rm", &memory, tiff_read_memory, write_nothing, seek_memory,
                            close_nothing, tiff_size_of_memory, nullptr, nullptr, options.get()),
          &TIFFClose};
}

/// Strips follow each other without gaps.
bool read_strips(TIFF* tiff, cv::Mat& image) {
  std::uint8_t* to = image.data;
  auto left = static_cast<tmsize_t>(image.total() * image.elemSize());
  for (std::uint32_t strip = 0; strip < TIFFNumberOfStrips(tiff) && left > 0; ++strip) {
    const tmsize_t got = TIFFReadEncodedStrip(tiff, strip, to, left);
    if (got <= 0) return false;
    to += got;
    left -= got;
  }
  return left == 0;
}

bool read_tiles(TIFF* tiff, cv::Mat& image) {
  std::uint32_t width = 0, height = 0;
  TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &width);
  TIFFGetField(tiff, TIFFTAG_TILELENGTH, &height);
  constexpr std::uint32_t kMaxSide = 4096;
  if (width == 0 || height == 0 || width > kMaxSide || height > kMaxSide) return false;
  cv::Mat tile(static_cast<int>(height), static_cast<int>(width), image.type());
  const auto bytes = static_cast<tmsize_t>(tile.total() * tile.elemSize());
  for (int y = 0; y < image.rows; y += tile.rows) {
    for (int x = 0; x < image.cols; x += tile.cols) {
      const std::uint32_t number =
          TIFFComputeTile(tiff, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0, 0);
      if (TIFFReadEncodedTile(tiff, number, tile.data, bytes) != bytes) return false;
      const cv::Rect here = cv::Rect(x, y, tile.cols, tile.rows) & cv::Rect({}, image.size());
      tile(cv::Rect({}, here.size())).copyTo(image(here));
    }
  }
  return true;
}

}  // namespace

DecodedImage decode_tiff_depth(Bytes bytes, cv::Size size) {
  Memory memory{bytes, 0};
  const Tiff tiff = open(memory);
  if (!tiff) return {cv::Mat(), "the TIFF is damaged"};
  std::uint32_t width = 0, height = 0;
  std::uint16_t bits = 1, samples = 1, format = SAMPLEFORMAT_UINT;
  TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height);
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, &samples);
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_SAMPLEFORMAT, &format);
  std::string problem = size_problem(width, height, size);
  if (!problem.empty()) return {cv::Mat(), problem};
  const bool units = bits == 16 && format == SAMPLEFORMAT_UINT;
  const bool metres = bits == 32 && format == SAMPLEFORMAT_IEEEFP;
  if (samples != 1 || (!units && !metres)) {
    return {cv::Mat(),
            fmt::format("is a TIFF of {} x {} bits, depth is one channel of 16 bits or 32-bit floating "
                        "point",
                        samples, bits)};
  }
  cv::Mat image(static_cast<int>(height), static_cast<int>(width), units ? CV_16UC1 : CV_32FC1,
                cv::Scalar(0));
  const bool sound =
      TIFFIsTiled(tiff.get()) != 0 ? read_tiles(tiff.get(), image) : read_strips(tiff.get(), image);
  if (!sound) return {cv::Mat(), "the TIFF is damaged"};
  return {image, ""};
}

#endif

}  // namespace stdc
