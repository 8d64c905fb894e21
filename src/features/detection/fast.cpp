#include "features/detection/fast.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "features/detection/fast.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#ifndef STDC_FEATURES_FAST_ONCE
#define STDC_FEATURES_FAST_ONCE
namespace stdc {
namespace {

// The circle of radius 3, clockwise from the top.
constexpr int kCircle[16][2] = {{0, -3}, {1, -3}, {2, -2}, {3, -1}, {3, 0},  {3, 1},   {2, 2},   {1, 3},
                                {0, 3},  {-1, 3}, {-2, 2}, {-3, 1}, {-3, 0}, {-3, -1}, {-2, -2}, {-1, -3}};

}  // namespace
}  // namespace stdc
#endif

HWY_BEFORE_NAMESPACE();
namespace stdc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using Bytes = hn::ScalableTag<std::uint8_t>;
using Vector = hn::Vec<Bytes>;

// The largest over all arcs of nine contiguous ring pixels of the smallest pixel of the arc; with Min and Max
// exchanged, the smallest of the largest. Two arcs that start one apart share eight pixels: those eight with
// the better of the two ends.
template <typename Inner, typename Outer>
HWY_INLINE Vector best_arc(const Vector (&ring)[16], const Inner& inner, const Outer& outer) {
  Vector two[8], four[8];
  for (int i = 0; i < 8; ++i) two[i] = inner(ring[2 * i + 1], ring[(2 * i + 2) % 16]);
  for (int i = 0; i < 8; ++i) four[i] = inner(two[i], two[(i + 1) % 8]);
  const auto arc = [&](int i) HWY_ATTR {
    return inner(outer(ring[2 * i], ring[(2 * i + 9) % 16]), inner(four[i], four[(i + 2) % 8]));
  };
  Vector best = arc(0);
  for (int i = 1; i < 8; ++i) best = outer(best, arc(i));
  return best;
}

// By how much the best arc is brighter or darker than the centre, whichever is more.
HWY_INLINE Vector contrast(Vector centre, Vector brightest, Vector darkest) {
  return hn::Max(hn::SaturatedSub(brightest, centre), hn::SaturatedSub(centre, darkest));
}

// scores[x] for x in [begin, end): contrast - 1 where that is >= threshold, else 0. May write a vector too
// far.
void score_row(const std::uint8_t* row, std::ptrdiff_t stride, int begin, int end, int threshold,
               std::uint8_t* scores) {
  const Bytes d;
  const auto limit = hn::Set(d, static_cast<std::uint8_t>(threshold));
  const auto smaller = [](Vector a, Vector b) HWY_ATTR { return hn::Min(a, b); };
  const auto larger = [](Vector a, Vector b) HWY_ATTR { return hn::Max(a, b); };
  for (int x = begin; x < end; x += static_cast<int>(hn::Lanes(d))) {
    const auto centre = hn::LoadU(d, row + x);
    Vector ring[16];
    const auto load = [&](int i) HWY_ATTR {
      ring[i] = hn::LoadU(d, row + x + kCircle[i][1] * stride + kCircle[i][0]);
    };
    for (int i = 0; i < 16; i += 4) load(i);
    // Every arc of nine holds the north or south and the east or west pixel: those bound its extremes.
    const auto bound = contrast(centre, hn::Min(hn::Max(ring[0], ring[8]), hn::Max(ring[4], ring[12])),
                                hn::Max(hn::Min(ring[0], ring[8]), hn::Min(ring[4], ring[12])));
    if (hn::AllTrue(d, hn::Eq(hn::SaturatedSub(bound, limit), hn::Zero(d)))) {
      hn::StoreU(hn::Zero(d), d, scores + x);
      continue;
    }
    for (int i = 0; i < 16; ++i) {
      if (i % 4 != 0) load(i);
    }
    const auto best = contrast(centre, best_arc(ring, smaller, larger), best_arc(ring, larger, smaller));
    const auto reaches = hn::Gt(best, limit);
    hn::StoreU(hn::IfThenElseZero(reaches, hn::Sub(best, hn::Set(d, 1))), d, scores + x);
  }
}

// Appends the local maxima of the middle one of three rows of scores.
void collect_maxima(const std::uint8_t* const rows[3], int begin, int end, int y,
                    std::vector<Corner>& corners) {
  const Bytes d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int x = begin; x < end; x += lanes) {
    const auto load = [&](int row, int dx) HWY_ATTR { return hn::LoadU(d, rows[row] + x + dx); };
    const auto centre = load(1, 0);
    if (hn::AllTrue(d, hn::Eq(centre, hn::Zero(d)))) continue;
    const auto before = hn::Max(hn::Max(load(0, -1), load(0, 0)), hn::Max(load(0, 1), load(1, -1)));
    const auto after = hn::Max(hn::Max(load(2, -1), load(2, 0)), hn::Max(load(2, 1), load(1, 1)));
    const auto maximal = hn::And(hn::Gt(centre, before), hn::Eq(hn::Max(centre, after), centre));
    alignas(8) std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, maximal, bytes);
    std::uint64_t bits = 0;
    std::memcpy(&bits, bytes, 8);
    for (; bits != 0; bits &= bits - 1) {
      const int at = x + std::countr_zero(bits);
      corners.push_back({static_cast<std::int16_t>(at), static_cast<std::int16_t>(y), rows[1][at]});
    }
  }
}

void fast_corners(const ImageView& image, int border, int threshold, std::vector<Corner>& corners) {
  const int begin = border, end = image.width - border;
  corners.clear();
  if (end <= begin || image.height <= 2 * border) return;
  // Three rows of scores in turn; zero outside [begin, end), so that nothing outside suppresses.
  const std::size_t row_size = static_cast<std::size_t>(image.width) + 2 * PaddedImage::kPadding;
  std::vector<std::uint8_t> buffer(3 * row_size);
  const auto scores = [&](int y) { return buffer.data() + static_cast<std::size_t>(y % 3) * row_size + 1; };
  const int last = image.height - border - 1;
  for (int y = border; y <= last + 1; ++y) {
    if (y <= last) {
      score_row(image.row(y), image.stride, begin, end, threshold, scores(y));
      std::memset(scores(y) + end, 0, PaddedImage::kPadding);
    } else {
      std::memset(scores(y), 0, row_size - 1);
    }
    if (y == border) continue;
    const std::uint8_t* rows[3] = {scores(y - 2 + 3), scores(y - 1), scores(y)};
    collect_maxima(rows, begin, end, y - 1, corners);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace stdc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stdc {
HWY_EXPORT(fast_corners);

void find_fast_corners(const ImageView& image, int border, int threshold, std::vector<Corner>& corners) {
  HWY_DYNAMIC_DISPATCH(fast_corners)(image, border, threshold, corners);
}

}  // namespace stdc
#endif
