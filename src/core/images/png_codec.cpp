#include <fmt/format.h>
#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "core/images/image_codec.hpp"
#include "core/images/png_quick.hpp"

namespace stdc {
namespace {

/// What the C callbacks share with us. libpng leaves by longjmp, so between setjmp and the calls below there
/// must be no object with a destructor.
struct PngReader {
  Bytes bytes;
  std::size_t used = 0;
  char problem[160] = "";
  std::jmp_buf on_error;
};

[[noreturn]] void fail(png_structp png, png_const_charp message) {
  auto* reader = static_cast<PngReader*>(png_get_error_ptr(png));
  std::snprintf(reader->problem, sizeof reader->problem, "the PNG is damaged (%s)", message);
  std::longjmp(reader->on_error, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

void read_bytes(png_structp png, png_bytep to, std::size_t count) {
  auto* reader = static_cast<PngReader*>(png_get_io_ptr(png));
  if (count > reader->bytes.size() - reader->used) {
    std::snprintf(reader->problem, sizeof reader->problem, "the PNG ends too early, after %zu bytes",
                  reader->bytes.size());
    std::longjmp(reader->on_error, 1);
  }
  std::memcpy(to, reader->bytes.data() + reader->used, count);
  reader->used += count;
}

/// Asks libpng to turn what is stored into what the caller wants. False if it cannot be.
bool ask_for_colour(png_structp png, png_infop info) {
  const int type = png_get_color_type(png, info);
  if (png_get_bit_depth(png, info) > 8) return false;
  if (type == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png);
  if (type == PNG_COLOR_TYPE_GRAY) png_set_expand_gray_1_2_4_to_8(png);
  png_set_strip_alpha(png);
  if ((type & PNG_COLOR_MASK_COLOR) != 0) png_set_bgr(png);
  return true;
}

bool ask_for_depth(png_structp png, png_infop info) {
  if (png_get_bit_depth(png, info) != 16 || png_get_color_type(png, info) != PNG_COLOR_TYPE_GRAY)
    return false;
  if constexpr (std::endian::native == std::endian::little) png_set_swap(png);
  return true;
}

enum class Kind { colour, depth };

/// Reads the header and settles the output format; fills `reader.problem` if the image is not what is wanted.
bool start(png_structp png, png_infop info, PngReader& reader, cv::Size size, Kind kind) {
  // Ancillary chunks (profiles, texts) say nothing that is needed here and may be broken without harm.
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_set_benign_errors(png, 0);
  png_set_read_fn(png, &reader, read_bytes);
  png_read_info(png, info);
  const auto width = png_get_image_width(png, info), height = png_get_image_height(png, info);
  if (width != static_cast<unsigned>(size.width) || height != static_cast<unsigned>(size.height)) {
    std::snprintf(reader.problem, sizeof reader.problem, "is %u x %u pixels, but the camera has %d x %d",
                  width, height, size.width, size.height);
    return false;
  }
  const bool fits = kind == Kind::depth ? ask_for_depth(png, info) : ask_for_colour(png, info);
  if (!fits) {
    std::snprintf(reader.problem, sizeof reader.problem, "has %d channel(s) of %d bits, but %s is needed",
                  png_get_channels(png, info), png_get_bit_depth(png, info),
                  kind == Kind::depth ? "one of 16 (grey)" : "1 or 3 of 8 (grey or RGB)");
    return false;
  }
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  return true;
}

DecodedImage decode(Bytes bytes, const cv::Size& size, Kind kind) {
  PngReader reader;
  reader.bytes = bytes;
  cv::Mat image;
  std::vector<png_bytep> rows(static_cast<std::size_t>(size.height));
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, fail, ignore_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  if (info == nullptr) {
    png_destroy_read_struct(&png, nullptr, nullptr);
    return {{}, "cannot be decoded (out of memory)"};
  }
  if (setjmp(reader.on_error) == 0) {  // NOLINT(cert-err52-cpp): how libpng reports errors
    if (start(png, info, reader, size, kind)) {
      const int type = kind == Kind::depth ? CV_16UC1 : CV_8UC(png_get_channels(png, info));
      image.create(size, type);
      for (int y = 0; y < size.height; ++y) rows[static_cast<std::size_t>(y)] = image.ptr(y);
      png_read_image(png, rows.data());
      png_read_end(png, nullptr);  // so that a missing end and a wrong check sum are noticed
    }
  }
  png_destroy_read_struct(&png, &info, nullptr);
  if (reader.problem[0] != '\0') return {{}, reader.problem};
  return {image, ""};
}

void append_bytes(png_structp png, png_bytep from, std::size_t count) {
  auto* bytes = static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
  bytes->insert(bytes->end(), from, from + count);
}

void no_flush(png_structp) {}

}  // namespace

bool is_png(Bytes bytes) { return bytes.size() >= 8 && png_sig_cmp(bytes.data(), 0, 8) == 0; }

DecodedImage decode_png_colour(Bytes bytes, cv::Size size, ColourMode mode) {
  const std::optional<DecodedImage> quick = decode_png_quickly(bytes, size);
  const bool suits = quick && quick->image.depth() == CV_8U;
  DecodedImage decoded = suits ? *quick : decode(bytes, size, Kind::colour);
  if (mode == ColourMode::grey && decoded.image.channels() == 3) {
    cv::Mat grey;
    cv::cvtColor(decoded.image, grey, cv::COLOR_BGR2GRAY);
    decoded.image = grey;
  }
  return decoded;
}

DecodedImage decode_png_depth(Bytes bytes, cv::Size size) {
  const std::optional<DecodedImage> quick = decode_png_quickly(bytes, size);
  return quick && quick->image.type() == CV_16UC1 ? *quick : decode(bytes, size, Kind::depth);
}

std::vector<std::uint8_t> encode_png(const cv::Mat& image, PngEffort effort) {
  CV_Assert(image.type() == CV_8UC1 || image.type() == CV_8UC3 || image.type() == CV_16UC1);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(image.total());
  PngReader errors;  // only its place to jump to
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &errors, fail, ignore_warning);
  png_infop info = png_create_info_struct(png);
  if (setjmp(errors.on_error) == 0) {  // NOLINT(cert-err52-cpp)
    png_set_write_fn(png, &bytes, append_bytes, no_flush);
    png_set_IHDR(png, info, static_cast<unsigned>(image.cols), static_cast<unsigned>(image.rows),
                 image.depth() == CV_16U ? 16 : 8,
                 image.channels() == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    constexpr int kRunLengths = 3;  // Z_RLE of zlib.h
    png_set_compression_level(png, effort == PngEffort::fast ? 1 : 3);
    if (effort == PngEffort::fast) png_set_compression_strategy(png, kRunLengths);
    // One filter, or libpng tries all five on every row. "Sub" suits smooth images best at its price.
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_write_info(png, info);
    if (image.channels() == 3) png_set_bgr(png);
    if (image.depth() == CV_16U && std::endian::native == std::endian::little) png_set_swap(png);
    for (int y = 0; y < image.rows; ++y) png_write_row(png, image.ptr(y));
    png_write_end(png, info);
  } else {
    bytes.clear();
  }
  png_destroy_write_struct(&png, &info);
  CV_Assert(!bytes.empty());
  return bytes;
}

}  // namespace stdc
