#include <fmt/format.h>
#include <turbojpeg.h>

#include <memory>
#include <type_traits>

#include "core/images/image_codec.hpp"

namespace stdc {
namespace {

struct DestroyHandle {
  void operator()(void* handle) const { tjDestroy(handle); }
};
using Handle = std::unique_ptr<std::remove_pointer_t<tjhandle>, DestroyHandle>;

struct FreeBytes {
  void operator()(unsigned char* bytes) const { tjFree(bytes); }
};

DecodedImage damaged(const Handle& handle) {
  return {{}, fmt::format("the JPEG is damaged ({})", tjGetErrorStr2(handle.get()))};
}

}  // namespace

bool is_jpeg(Bytes bytes) {
  return bytes.size() >= 3 && bytes[0] == 0xFF && bytes[1] == 0xD8 && bytes[2] == 0xFF;
}

DecodedImage decode_jpeg(Bytes bytes, cv::Size size, ColourMode mode) {
  const Handle handle(tjInitDecompress());
  if (!handle) return {{}, "the JPEG cannot be decoded (out of memory)"};
  int width = 0, height = 0, subsampling = -1, colours = -1;
  const int fault =
      tjDecompressHeader3(handle.get(), bytes.data(), bytes.size(), &width, &height, &subsampling, &colours);
  // A subsampling that it has no name for is a fault too, but can be decoded.
  if (fault != 0 && (width < 1 || height < 1 || colours < 0)) return damaged(handle);
  if (cv::Size(width, height) != size) {
    return {
        {},
        fmt::format("is {} x {} pixels, but the camera has {} x {}", width, height, size.width, size.height)};
  }
  if (colours == TJCS_CMYK || colours == TJCS_YCCK) {
    return {{}, "has 4 channels, but 1 or 3 are needed"};
  }
  const bool grey = mode == ColourMode::grey || colours == TJCS_GRAY;
  cv::Mat image(size, grey ? CV_8UC1 : CV_8UC3);
  // A progressive file of a few kilobytes can ask for thousands of passes over the image.
  constexpr int kFlags = TJFLAG_ACCURATEDCT | TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS;
  if (tjDecompress2(handle.get(), bytes.data(), bytes.size(), image.data, size.width,
                    static_cast<int>(image.step[0]), size.height, grey ? TJPF_GRAY : TJPF_BGR, kFlags) != 0) {
    return damaged(handle);
  }
  return {image, ""};
}

std::vector<std::uint8_t> encode_jpeg(const cv::Mat& image, int quality) {
  CV_Assert(image.type() == CV_8UC1 || image.type() == CV_8UC3);
  const bool grey = image.channels() == 1;
  const Handle handle(tjInitCompress());
  CV_Assert(handle != nullptr);
  unsigned char* buffer = nullptr;
  unsigned long size = 0;
  const int fault = tjCompress2(handle.get(), image.data, image.cols, static_cast<int>(image.step[0]),
                                image.rows, grey ? TJPF_GRAY : TJPF_BGR, &buffer, &size,
                                grey ? TJSAMP_GRAY : TJSAMP_420, quality, TJFLAG_ACCURATEDCT);
  const std::unique_ptr<unsigned char, FreeBytes> owner(buffer);
  CV_Assert(fault == 0 && size > 0);
  return {buffer, buffer + size};
}

}  // namespace stdc
