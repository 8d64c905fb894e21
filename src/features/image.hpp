#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stdc {

/// A view of a grey image that it does not own. Row y starts at `data + y * stride`.
struct ImageView {
  const std::uint8_t* data = nullptr;
  int width = 0, height = 0;  ///< [px]
  std::ptrdiff_t stride = 0;  ///< bytes from a row to the next

  const std::uint8_t* row(int y) const { return data + y * stride; }
  std::uint8_t at(int x, int y) const { return row(y)[x]; }
};

/// A grey image with room behind each row, so that vector loops may read and write whole vectors.
class PaddedImage {
 public:
  /// Bytes behind the last pixel of each row that belong to the image and mean nothing: the widest vector.
  static constexpr int kPadding = 64;

  /// Stride of an image of that width: an odd number of cache lines, so that the rows of a patch never share
  /// one set of the cache.
  static std::ptrdiff_t stride_for(int width) { return (((width + kPadding + 63) / 64) | 1) * 64; }

  /// Makes room for width x height pixels; keeps the memory it has where that is enough. Contents: undefined.
  /// @param stride  at least stride_for(width); images of one stride share tables of pixel offsets
  void resize(int width, int height, std::ptrdiff_t stride) {
    width_ = width;
    height_ = height;
    stride_ = stride;
    const auto needed = static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height) + kPadding;
    if (bytes_.size() < needed) bytes_.resize(needed);
  }
  int width() const { return width_; }
  int height() const { return height_; }
  std::ptrdiff_t stride() const { return stride_; }
  std::uint8_t* row(int y) { return bytes_.data() + y * stride_; }
  const std::uint8_t* row(int y) const { return bytes_.data() + y * stride_; }
  ImageView view() const { return {bytes_.data(), width_, height_, stride_}; }

 private:
  std::vector<std::uint8_t> bytes_;
  int width_ = 0, height_ = 0;
  std::ptrdiff_t stride_ = 0;
};

}  // namespace stdc
