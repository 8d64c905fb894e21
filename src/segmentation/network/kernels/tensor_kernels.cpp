#include "segmentation/network/kernels/tensor_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "segmentation/network/kernels/tensor_kernels.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace stdc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Blocks of 8 channels are the shortest that matter: longer vectors would leave them to the scalar tails.
using Floats = hn::CappedTag<float, 8>;
using Ints = hn::Rebind<std::int32_t, Floats>;
using Bytes = hn::Rebind<std::uint8_t, Floats>;

HWY_INLINE hn::Vec<Floats> load_level(const std::uint8_t* from) {
  return hn::ConvertTo(Floats(), hn::PromoteTo(Ints(), hn::LoadU(Bytes(), from)));
}

HWY_INLINE void store_level(hn::Vec<Floats> value, hn::Vec<Floats> max_level, std::uint8_t* to) {
  const auto bounded = hn::Min(hn::Max(value, hn::Zero(Floats())), max_level);
  hn::StoreU(hn::DemoteTo(Bytes(), hn::NearestInt(bounded)), Bytes(), to);
}

HWY_INLINE std::uint8_t to_level(float value, float max_level) {
  return static_cast<std::uint8_t>(std::nearbyint(std::min(std::max(value, 0.0F), max_level)));
}

/// The taps of one output pixel of the pooling, clipped to the source.
struct Window {
  int top, bottom, left, right;  // half-open
};

template <typename T>
void pool_pixel(const TensorView& source, int group, const Window& window, float factor, float max_level,
                T* out) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const T* data = static_cast<const T*>(source.data);
  int c = 0;
  for (; c + lanes <= source.block; c += lanes) {
    auto sum = hn::Zero(d);
    for (int y = window.top; y < window.bottom; ++y) {
      const T* tap = data + source.offset(group, y, window.left) + c;
      for (int x = window.left; x < window.right; ++x, tap += source.pixel_stride) {
        if constexpr (sizeof(T) == 1) {
          sum = hn::Add(sum, load_level(tap));
        } else {
          sum = hn::Add(sum, hn::LoadU(d, tap));
        }
      }
    }
    if constexpr (sizeof(T) == 1) {
      store_level(hn::Mul(sum, hn::Set(d, factor)), hn::Set(d, max_level), out + c);
    } else {
      hn::StoreU(hn::Mul(sum, hn::Set(d, factor)), d, out + c);
    }
  }
  for (; c < source.block; ++c) {
    float sum = 0;
    for (int y = window.top; y < window.bottom; ++y) {
      for (int x = window.left; x < window.right; ++x)
        sum += data[source.offset(group, y, x) + static_cast<std::size_t>(c)];
    }
    if constexpr (sizeof(T) == 1) {
      out[c] = to_level(sum * factor, max_level);
    } else {
      out[c] = sum * factor;
    }
  }
}

template <typename T>
void pool(const TensorView& source, const TensorView& target, float ratio, int levels) {
  const float factor = ratio / 9, max_level = static_cast<float>(levels);
  for (int g = 0; g < target.groups(); ++g) {
    for (int y = 0; y < target.shape.height; ++y) {
      T* out = static_cast<T*>(target.data) + target.offset(g, y, 0);
      for (int x = 0; x < target.shape.width; ++x, out += target.pixel_stride) {
        const Window window{std::max(2 * y - 1, 0), std::min(2 * y + 2, source.shape.height),
                            std::max(2 * x - 1, 0), std::min(2 * x + 2, source.shape.width)};
        pool_pixel(source, g, window, factor, max_level, out);
      }
    }
  }
}

void pool_floats(const TensorView& source, const TensorView& target) { pool<float>(source, target, 1, 0); }
void pool_levels(const TensorView& source, const TensorView& target, float ratio, int levels) {
  pool<std::uint8_t>(source, target, ratio, levels);
}

void rescale_levels(const TensorView& source, const TensorView& target, float ratio, int levels) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto factor = hn::Set(d, ratio), max_level = hn::Set(d, static_cast<float>(levels));
  for (int g = 0; g < source.groups(); ++g) {
    const std::uint8_t* from = source.bytes() + source.offset(g, 0, 0);
    std::uint8_t* to = target.bytes() + target.offset(g, 0, 0);
    for (std::size_t p = 0; p < source.shape.pixels(); ++p) {
      int c = 0;
      for (; c + lanes <= source.block; c += lanes) {
        store_level(hn::Mul(load_level(from + c), factor), max_level, to + c);
      }
      for (; c < source.block; ++c) to[c] = to_level(from[c] * ratio, static_cast<float>(levels));
      from += source.pixel_stride;
      to += target.pixel_stride;
    }
  }
}

template <typename T>
void add_up(const TensorView& source, float* HWY_RESTRICT sums) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int g = 0; g < source.groups(); ++g, sums += source.block) {
    const T* from = static_cast<const T*>(source.data) + source.offset(g, 0, 0);
    for (std::size_t p = 0; p < source.shape.pixels(); ++p, from += source.pixel_stride) {
      int c = 0;
      for (; c + lanes <= source.block; c += lanes) {
        if constexpr (sizeof(T) == 1) {
          hn::StoreU(hn::Add(hn::LoadU(d, sums + c), load_level(from + c)), d, sums + c);
        } else {
          hn::StoreU(hn::Add(hn::LoadU(d, sums + c), hn::LoadU(d, from + c)), d, sums + c);
        }
      }
      for (; c < source.block; ++c) sums[c] += from[c];
    }
  }
}

void add_up_floats(const TensorView& source, float* sums) { add_up<float>(source, sums); }
void add_up_levels(const TensorView& source, float* sums) { add_up<std::uint8_t>(source, sums); }

/// One pixel of combine(): all channels of a group.
template <typename T>
void combine_pixel(const Combination& job, int group, const float* from, const float* addend, T* to) {
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d)), block = job.source.block;
  const float* gain = job.gain.data() + static_cast<std::ptrdiff_t>(group) * block;
  const float* offset = job.offset.data() + static_cast<std::ptrdiff_t>(group) * block;
  const float max_level = static_cast<float>(job.levels);
  int c = 0;
  for (; c + lanes <= block; c += lanes) {
    auto value = hn::Add(hn::Mul(hn::LoadU(d, from + c), hn::LoadU(d, gain + c)), hn::LoadU(d, offset + c));
    if (addend != nullptr) value = hn::Add(value, hn::LoadU(d, addend + c));
    if constexpr (sizeof(T) == 1) {
      store_level(hn::Mul(value, hn::Set(d, job.inverse_scale)), hn::Set(d, max_level), to + c);
    } else {
      hn::StoreU(value, d, to + c);
    }
  }
  for (; c < block; ++c) {
    float value = from[c] * gain[c] + offset[c];
    if (addend != nullptr) value += addend[c];
    if constexpr (sizeof(T) == 1) {
      to[c] = to_level(value * job.inverse_scale, max_level);
    } else {
      to[c] = value;
    }
  }
}

template <typename T>
void combine_all(const Combination& job) {
  const TensorView &source = job.source, &target = job.target;
  const auto bytes = static_cast<std::size_t>(source.block) * sizeof(T);
  const bool adds = job.addend.data != nullptr;
  T* const out = static_cast<T*>(target.data);
  for (int g = 0; g < source.groups(); ++g) {
    for (int y = 0; y < source.shape.height; ++y) {
      for (int x = 0; x < source.shape.width; ++x) {
        T* to = out + target.offset(g, y * job.factor, x * job.factor);
        combine_pixel(job, g, source.floats() + source.offset(g, y, x),
                      adds ? job.addend.floats() + job.addend.offset(g, y, x) : nullptr, to);
        for (int i = 1; i < job.factor * job.factor; ++i) {
          std::memcpy(
              out + target.offset(g, y * job.factor + i / job.factor, x * job.factor + i % job.factor), to,
              bytes);
        }
      }
    }
  }
}

void combine_floats(const Combination& job) { combine_all<float>(job); }
void combine_levels(const Combination& job) { combine_all<std::uint8_t>(job); }

}  // namespace HWY_NAMESPACE
}  // namespace stdc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stdc {
HWY_EXPORT(pool_floats);
HWY_EXPORT(pool_levels);
HWY_EXPORT(rescale_levels);
HWY_EXPORT(add_up_floats);
HWY_EXPORT(add_up_levels);
HWY_EXPORT(combine_floats);
HWY_EXPORT(combine_levels);

void average_pool(const TensorView& source, const TensorView& target, float ratio, int levels) {
  if (source.type == ElementType::f32) {
    HWY_DYNAMIC_DISPATCH(pool_floats)(source, target);
  } else {
    HWY_DYNAMIC_DISPATCH(pool_levels)(source, target, ratio, levels);
  }
}

void rescale(const TensorView& source, const TensorView& target, float ratio, int levels) {
  HWY_DYNAMIC_DISPATCH(rescale_levels)(source, target, ratio, levels);
}

void global_average(const TensorView& source, std::span<float> means, float scale) {
  std::fill(means.begin(), means.end(), 0.0F);
  if (source.type == ElementType::f32) {
    HWY_DYNAMIC_DISPATCH(add_up_floats)(source, means.data());
  } else {
    HWY_DYNAMIC_DISPATCH(add_up_levels)(source, means.data());
  }
  const auto pixels = static_cast<float>(source.shape.pixels());
  for (float& mean : means) mean = mean / pixels * scale;
}

void combine(const Combination& combination) {
  if (combination.target.type == ElementType::f32) {
    HWY_DYNAMIC_DISPATCH(combine_floats)(combination);
  } else {
    HWY_DYNAMIC_DISPATCH(combine_levels)(combination);
  }
}

}  // namespace stdc
#endif
