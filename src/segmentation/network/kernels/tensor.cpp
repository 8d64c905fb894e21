#include "segmentation/network/kernels/tensor.hpp"

#include <cstring>
#include <new>

namespace stdc {
namespace {

constexpr std::align_val_t kAlignment{64};
constexpr std::size_t kSlack = 64;  // vector loops may read, never write, beyond the end

}  // namespace

struct TensorArena::Place {
  std::size_t bytes = 0;
  bool taken = false;
  std::shared_ptr<void> memory;
};

std::shared_ptr<void> aligned_memory(std::size_t bytes) {
  void* memory = ::operator new(bytes + kSlack, kAlignment);
  std::memset(memory, 0, bytes + kSlack);
  return {memory, [](void* old) { ::operator delete(old, kAlignment); }};
}

TensorView TensorView::slice(int first, int count) const {
  TensorView part = *this;
  part.shape.channels = count;
  std::size_t skipped = 0;
  if (channels_last()) {
    part.block = count;
    skipped = static_cast<std::size_t>(first);
  } else {
    skipped = static_cast<std::size_t>(first / block) * group_stride();
  }
  part.data = bytes() + skipped * element_size(type);
  return part;
}

Tensor TensorArena::make(TensorShape shape, ElementType type, int block) {
  const std::size_t bytes = shape.elements() * element_size(type);
  std::shared_ptr<Place> best;
  for (const auto& place : places_) {
    if (!place->taken && place->bytes >= bytes && (!best || place->bytes < best->bytes)) best = place;
  }
  if (!best) {
    best = places_.emplace_back(std::make_shared<Place>(Place{bytes, false, aligned_memory(bytes)}));
  }
  best->taken = true;
  const std::shared_ptr<void> lease(best->memory.get(), [place = best](void*) { place->taken = false; });
  return {TensorView{shape, type, block, block, best->memory.get()}, lease};
}

std::size_t TensorArena::bytes() const {
  std::size_t sum = 0;
  for (const auto& place : places_) sum += place->bytes;
  return sum;
}

}  // namespace stdc
