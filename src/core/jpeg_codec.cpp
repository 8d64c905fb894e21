#include <cstdio>
// libjpeg's header needs <cstdio> before it.
#include <jerror.h>
#include <jpeglib.h>

#include <csetjmp>
#include <cstdlib>

#include "core/image_codec.hpp"

namespace stdc {
namespace {

/// libjpeg leaves by longjmp, so between setjmp and its calls there must be no object with a destructor.
struct JpegErrors {
  jpeg_error_mgr manager;  // first: libjpeg knows only of this part
  std::jmp_buf on_error;
  char problem[JMSG_LENGTH_MAX + 64] = "";
};

JpegErrors* errors_of(j_common_ptr jpeg) { return reinterpret_cast<JpegErrors*>(jpeg->err); }

void note_problem(j_common_ptr jpeg) {
  JpegErrors* errors = errors_of(jpeg);
  if (errors->problem[0] != '\0') return;  // the first one is the cause
  char message[JMSG_LENGTH_MAX];
  jpeg->err->format_message(jpeg, message);
  std::snprintf(errors->problem, sizeof errors->problem, "the JPEG is damaged (%s)", message);
}

[[noreturn]] void fail(j_common_ptr jpeg) {
  note_problem(jpeg);
  std::longjmp(errors_of(jpeg)->on_error, 1);
}

/// Level -1 is a warning, that is data which libjpeg repairs by guessing; others are traces.
void take_message(j_common_ptr jpeg, int level) {
  const int code = jpeg->err->msg_code;
  const bool harmless = code == JWRN_ADOBE_XFORM || code == JWRN_JFIF_MAJOR;
  if (level < 0 && !harmless) fail(jpeg);
}

void print_nothing(j_common_ptr) {}

void use(JpegErrors& errors) {
  jpeg_std_error(&errors.manager);
  errors.manager.error_exit = fail;
  errors.manager.emit_message = take_message;
  errors.manager.output_message = print_nothing;
}

/// A progressive file of a few kilobytes can ask for thousands of passes over the image.
void limit_scans(j_common_ptr jpeg) {
  constexpr int kMaxScans = 100;
  if (jpeg->is_decompressor == 0) return;
  if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number > kMaxScans) {
    jpeg->err->msg_code = JERR_EMPTY_IMAGE;
    std::snprintf(errors_of(jpeg)->problem, sizeof errors_of(jpeg)->problem, "the JPEG has too many scans");
    fail(jpeg);
  }
}

/// Reads the header and settles the output format; fills `errors.problem` if the image does not suit.
bool start(jpeg_decompress_struct& jpeg, JpegErrors& errors, cv::Size size, ColourMode mode) {
  jpeg_read_header(&jpeg, TRUE);
  if (jpeg.image_width != static_cast<unsigned>(size.width) ||
      jpeg.image_height != static_cast<unsigned>(size.height)) {
    std::snprintf(errors.problem, sizeof errors.problem, "is %u x %u pixels, but the camera has %d x %d",
                  jpeg.image_width, jpeg.image_height, size.width, size.height);
    return false;
  }
  if (jpeg.num_components != 1 && jpeg.num_components != 3) {
    std::snprintf(errors.problem, sizeof errors.problem, "has %d channels, but 1 or 3 are needed",
                  jpeg.num_components);
    return false;
  }
  const bool grey = mode == ColourMode::grey || jpeg.num_components == 1;
  jpeg.out_color_space = grey ? JCS_GRAYSCALE : JCS_EXT_BGR;
  return jpeg_start_decompress(&jpeg) != 0;
}

}  // namespace

bool is_jpeg(Bytes bytes) {
  return bytes.size() >= 3 && bytes[0] == 0xFF && bytes[1] == 0xD8 && bytes[2] == 0xFF;
}

DecodedImage decode_jpeg(Bytes bytes, cv::Size size, ColourMode mode) {
  JpegErrors errors{};
  jpeg_decompress_struct jpeg{};
  jpeg_progress_mgr progress{};
  cv::Mat image;
  use(errors);
  jpeg.err = &errors.manager;
  if (setjmp(errors.on_error) == 0) {  // NOLINT(cert-err52-cpp): the way of libjpeg
    jpeg_create_decompress(&jpeg);
    progress.progress_monitor = limit_scans;
    jpeg.progress = &progress;
    jpeg_mem_src(&jpeg, bytes.data(), static_cast<unsigned long>(bytes.size()));
    if (start(jpeg, errors, size, mode)) {
      image.create(size, CV_8UC(jpeg.output_components));
      while (jpeg.output_scanline < jpeg.output_height) {
        JSAMPROW row = image.ptr(static_cast<int>(jpeg.output_scanline));
        jpeg_read_scanlines(&jpeg, &row, 1);
      }
      jpeg_finish_decompress(&jpeg);  // reads on to the end mark
    }
  }
  jpeg_destroy_decompress(&jpeg);
  if (errors.problem[0] != '\0') return {{}, errors.problem};
  if (image.empty()) return {{}, "the JPEG cannot be decoded"};
  return {image, ""};
}

std::vector<std::uint8_t> encode_jpeg(const cv::Mat& image, int quality) {
  CV_Assert(image.type() == CV_8UC1 || image.type() == CV_8UC3);
  JpegErrors errors{};
  jpeg_compress_struct jpeg{};
  unsigned char* buffer = nullptr;
  unsigned long size = 0;
  use(errors);
  jpeg.err = &errors.manager;
  if (setjmp(errors.on_error) == 0) {  // NOLINT(cert-err52-cpp)
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &buffer, &size);
    jpeg.image_width = static_cast<unsigned>(image.cols);
    jpeg.image_height = static_cast<unsigned>(image.rows);
    jpeg.input_components = image.channels();
    jpeg.in_color_space = image.channels() == 3 ? JCS_EXT_BGR : JCS_GRAYSCALE;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, quality, TRUE);
    jpeg_start_compress(&jpeg, TRUE);
    while (jpeg.next_scanline < jpeg.image_height) {
      JSAMPROW row = const_cast<JSAMPROW>(image.ptr(static_cast<int>(jpeg.next_scanline)));
      jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
  }
  jpeg_destroy_compress(&jpeg);
  std::vector<std::uint8_t> bytes;
  if (errors.problem[0] == '\0') bytes.assign(buffer, buffer + size);
  std::free(buffer);  // NOLINT(cppcoreguidelines-no-malloc): libjpeg allocated it
  CV_Assert(!bytes.empty());
  return bytes;
}

}  // namespace stdc
