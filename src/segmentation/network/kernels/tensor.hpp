#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace stdc {

/// Element type of a tensor.
enum class ElementType : std::uint8_t { f32, u8 };

inline std::size_t element_size(ElementType type) { return type == ElementType::f32 ? 4 : 1; }

/// Channels, rows and columns of one image's activations.
struct TensorShape {
  int channels = 0, height = 0, width = 0;
  bool operator==(const TensorShape&) const = default;

  std::size_t pixels() const { return static_cast<std::size_t>(height) * static_cast<std::size_t>(width); }
  std::size_t elements() const { return static_cast<std::size_t>(channels) * pixels(); }
};

/// Where the elements of a tensor lie, without owning them. The channels are cut into groups of `block`;
/// within a group the channels of one pixel lie side by side. block = channels: channels last (NHWC); block =
/// 8 or 16: the blocked layouts nChw8c and nChw16c; block = 1: planes (NCHW). `channels` is a multiple of
/// `block`.
struct TensorView {
  TensorShape shape;
  ElementType type = ElementType::f32;
  int block = 1;
  int pixel_stride = 1;  ///< elements from one pixel to the next; > block in a slice of channels-last data
  void* data = nullptr;

  int groups() const { return shape.channels / block; }
  bool channels_last() const { return block == shape.channels; }
  std::size_t group_stride() const { return shape.pixels() * static_cast<std::size_t>(pixel_stride); }
  float* floats() const { return static_cast<float*>(data); }
  std::uint8_t* bytes() const { return static_cast<std::uint8_t*>(data); }
  /// Offset of a group's first element at a pixel.
  std::size_t offset(int group, int y, int x) const {
    const auto pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(shape.width) + static_cast<std::size_t>(x);
    return static_cast<std::size_t>(group) * group_stride() + pixel * static_cast<std::size_t>(pixel_stride);
  }
  /// The channels from `first` on; `first` and `count` are multiples of the block unless channels are last.
  TensorView slice(int first, int count) const;
};

/// A tensor that holds its place in the arena for as long as it lives.
struct Tensor {
  TensorView view;
  std::shared_ptr<void> lease;
};

/// Memory for activations. While the network is put together, a place whose tensors are all gone is given out
/// again: what matters is the order of the steps, which is also the order in which they run later.
class TensorArena {
 public:
  Tensor make(TensorShape shape, ElementType type, int block);
  /// Bytes of all places.
  std::size_t bytes() const;

 private:
  struct Place;
  std::vector<std::shared_ptr<Place>> places_;
};

/// `bytes` of memory at a multiple of 64.
std::shared_ptr<void> aligned_memory(std::size_t bytes);

}  // namespace stdc
