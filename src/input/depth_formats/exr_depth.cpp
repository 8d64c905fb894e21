#include <opencv2/core.hpp>

#include "input/depth_formats/depth_formats.hpp"
#include "input/depth_formats/expected_size.hpp"

#ifdef STDC_WITH_EXR
#include <OpenEXR/openexr.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <string_view>
#endif

namespace stdc {

bool is_exr(Bytes bytes) {
  return bytes.size() >= 4 && bytes[0] == 0x76 && bytes[1] == 0x2f && bytes[2] == 0x31 && bytes[3] == 0x01;
}

#ifndef STDC_WITH_EXR

DecodedImage decode_exr_depth(Bytes, cv::Size) {
  return {cv::Mat(), "is an EXR, and this program was built without OpenEXR (libopenexr-dev)"};
}

#else

namespace {

std::int64_t read_memory(exr_const_context_t, void* from, void* to, std::uint64_t count, std::uint64_t offset,
                         exr_stream_error_func_ptr_t) {
  const Bytes bytes = *static_cast<const Bytes*>(from);
  if (offset > bytes.size()) return -1;
  const std::uint64_t taken = std::min<std::uint64_t>(count, bytes.size() - offset);
  if (taken > 0) std::memcpy(to, bytes.data() + offset, taken);
  return static_cast<std::int64_t>(taken);
}

std::int64_t size_of_memory(exr_const_context_t, void* from) {
  return static_cast<std::int64_t>(static_cast<const Bytes*>(from)->size());
}

void say_nothing(exr_const_context_t, exr_result_t, const char*) {}

/// An open file; closed at the end.
class ExrFile {
 public:
  explicit ExrFile(Bytes& bytes) {
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.user_data = &bytes;
    setup.read_fn = read_memory;
    setup.size_fn = size_of_memory;
    setup.error_handler_fn = say_nothing;
    constexpr int kMaxSide = 16384;
    setup.max_image_width = setup.max_image_height = kMaxSide;
    open_ = exr_start_read(&context_, "depth", &setup) == EXR_ERR_SUCCESS;
  }
  ~ExrFile() {
    if (context_ != nullptr) exr_finish(&context_);
  }
  ExrFile(const ExrFile&) = delete;
  ExrFile& operator=(const ExrFile&) = delete;
  bool is_open() const { return open_; }
  exr_context_t get() const { return context_; }

 private:
  exr_context_t context_ = nullptr;
  bool open_ = false;
};

/// The channel that holds depth; nothing if none has one of the names and there are several.
std::string depth_channel(const exr_attr_chlist_t& channels) {
  const auto has = [&](std::string_view name) {
    return std::any_of(channels.entries, channels.entries + channels.num_channels,
                       [&](const exr_attr_chlist_entry_t& c) { return name == c.name.str; });
  };
  for (const char* name : {"Z", "depth", "Depth", "Y", "depth.Z", "R"}) {
    if (has(name)) return name;
  }
  return channels.num_channels == 1 ? channels.entries[0].name.str : "";
}

/// The steps of decoding one chunk; freed at the end.
class Decoder {
 public:
  explicit Decoder(exr_context_t context) : context_(context) {}
  ~Decoder() {
    if (ready_) exr_decoding_destroy(context_, &pipeline_);
  }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  /// Decodes the rows of a chunk that begins at row `y` of the image, whose first row is `top` in the file.
  bool run(const exr_chunk_info_t& chunk, const std::string& channel, int top, cv::Mat& image) {
    const exr_result_t begun = ready_ ? exr_decoding_update(context_, 0, &chunk, &pipeline_)
                                      : exr_decoding_initialize(context_, 0, &chunk, &pipeline_);
    if (begun != EXR_ERR_SUCCESS) return false;
    bool found = false;
    for (int i = 0; i < pipeline_.channel_count; ++i) {
      exr_coding_channel_info_t& c = pipeline_.channels[i];
      c.decode_to_ptr = nullptr;
      if (channel != c.channel_name) continue;
      if (c.x_samples != 1 || c.y_samples != 1 || c.width != image.cols) return false;
      if (chunk.start_y < top || chunk.start_y - top + c.height > image.rows) return false;
      c.decode_to_ptr = image.ptr(chunk.start_y - top);
      c.user_bytes_per_element = sizeof(float);
      c.user_data_type = EXR_PIXEL_FLOAT;
      c.user_pixel_stride = sizeof(float);
      c.user_line_stride = static_cast<int>(image.step[0]);
      found = true;
    }
    if (!found) return false;
    if (!ready_ && exr_decoding_choose_default_routines(context_, 0, &pipeline_) != EXR_ERR_SUCCESS)
      return false;
    ready_ = true;
    return exr_decoding_run(context_, 0, &pipeline_) == EXR_ERR_SUCCESS;
  }

 private:
  exr_context_t context_;
  exr_decode_pipeline_t pipeline_ = {};  // as EXR_DECODE_PIPELINE_INITIALIZER, of which clang warns
  bool ready_ = false;
};

}  // namespace

DecodedImage decode_exr_depth(Bytes bytes, cv::Size size) {
  const auto fault = [](std::string problem) { return DecodedImage{cv::Mat(), std::move(problem)}; };
  const ExrFile file(bytes);
  exr_storage_t storage = EXR_STORAGE_LAST_TYPE;
  exr_attr_box2i_t window{};
  const exr_attr_chlist_t* channels = nullptr;
  if (!file.is_open() || exr_get_storage(file.get(), 0, &storage) != EXR_ERR_SUCCESS ||
      exr_get_data_window(file.get(), 0, &window) != EXR_ERR_SUCCESS ||
      exr_get_channels(file.get(), 0, &channels) != EXR_ERR_SUCCESS || channels == nullptr) {
    return fault("the EXR is damaged");
  }
  if (storage != EXR_STORAGE_SCANLINE) return fault("is an EXR with tiles, one with scan lines is read");
  const std::string channel = depth_channel(*channels);
  if (channel.empty()) return fault("is an EXR without a channel Z, depth, Y or R");
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  const std::string problem = size_problem(width, height, size);
  if (!problem.empty()) return fault(problem);
  std::int32_t rows = 0;
  if (exr_get_scanlines_per_chunk(file.get(), 0, &rows) != EXR_ERR_SUCCESS || rows < 1)
    return fault("the EXR is damaged");
  cv::Mat image(static_cast<int>(height), static_cast<int>(width), CV_32FC1, cv::Scalar(0));
  Decoder decoder(file.get());
  for (int y = window.min.y; y <= window.max.y; y += rows) {
    exr_chunk_info_t chunk{};
    if (exr_read_scanline_chunk_info(file.get(), 0, y, &chunk) != EXR_ERR_SUCCESS ||
        !decoder.run(chunk, channel, window.min.y, image)) {
      return fault("the EXR is damaged");
    }
  }
  return {image, ""};
}

#endif

}  // namespace stdc
