#include "segmentation/srm/refinement_kernel.hpp"

#include <algorithm>
#include <cstring>

#include "segmentation/srm/refinement_rows.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "segmentation/srm/refinement_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "segmentation/srm/refinement_lanes.inl"

// A pixel joins if any claimant (dynamic, with depth) in its window is within tau of its depth. Most pixels
// are settled by the largest and the smallest depth among the claimants: within tau of either, it joins; not
// between the two, it does not. Those come from running maxima along the rows, then down the columns (van
// Herk 1992). Only where a depth lies between the extremes but near neither are the claimants compared one by
// one, a vector of pixels at a time.

HWY_BEFORE_NAMESPACE();
namespace stdc {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <typename Kind>
HWY_INLINE hn::Mask<typename Kind::D> load_dynamic(const std::uint8_t* mask) {
  const typename Kind::D d;
  const hn::RebindToUnsigned<decltype(d)> du;
  const hn::Rebind<std::uint8_t, decltype(d)> d8;
  return hn::RebindMask(d, hn::Ne(hn::PromoteTo(du, hn::LoadU(d8, mask)), hn::Zero(du)));
}

bool copy_row(const std::uint8_t* mask, int width, std::uint8_t* result, std::uint8_t* columns) {
  const hn::ScalableTag<std::uint8_t> d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  auto any = hn::Zero(d);
  int x = 0;
  for (; x + lanes <= width; x += lanes) {
    const auto dynamic = hn::VecFromMask(d, hn::Ne(hn::LoadU(d, mask + x), hn::Zero(d)));
    hn::StoreU(dynamic, d, result + x);
    hn::StoreU(hn::Or(hn::LoadU(d, columns + x), dynamic), d, columns + x);
    any = hn::Or(any, dynamic);
  }
  bool found = !hn::AllTrue(d, hn::Eq(any, hn::Zero(d)));
  for (; x < width; ++x) {
    result[x] = mask[x] != 0 ? 255 : 0;
    columns[x] |= result[x];
    found |= result[x] != 0;
  }
  return found;
}

// Copies the task's part of a row to where whole vectors may be read.
template <typename T>
void fetch_row(const RefinementTask& task, int y, RefinementRows<T>& rows) {
  const auto count = static_cast<std::size_t>(rows.width);
  std::memcpy(rows.mask.row(0), task.mask + y * task.mask_stride + task.left, count);
  std::memcpy(rows.depth.row(0),
              task.depth + y * task.depth_stride + task.left * static_cast<std::ptrdiff_t>(sizeof(T)),
              count * sizeof(T));
}

// The claimants of a row, with none on either side.
template <typename Kind>
void find_claimants(RefinementRows<typename Kind::T>& rows, int radius, typename Kind::T* claimants) {
  const typename Kind::D d;
  const auto none = hn::Set(d, Kind::none());
  const auto* depth = rows.depth.row(0);
  const std::uint8_t* mask = rows.mask.row(0);
  std::fill_n(claimants, rows.claimants.stride(), Kind::none());
  const int width = rows.width;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d))) {
    const auto z = hn::LoadU(d, depth + x);
    const auto claims = hn::And(load_dynamic<Kind>(mask + x), Kind::present(z));
    hn::StoreU(hn::IfThenElse(claims, z, none), d, claimants + radius + x);
  }
  std::fill_n(claimants + radius + width, radius + 1, Kind::none());
}

// values[x] becomes the largest of values[x .. x + window - 1], for x < width: spans of 1, 2, 4 ... pixels
// grow until two of them cover the window.
template <typename Kind>
void run_along(typename Kind::T* values, int width, int window) {
  const typename Kind::D d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto widen = [&](int end, int step) HWY_ATTR {
    for (int x = 0; x < end; x += lanes) {
      hn::StoreU(hn::Max(hn::LoadU(d, values + x), hn::LoadU(d, values + x + step)), d, values + x);
    }
  };
  int span = 1;
  for (; 2 * span <= window; span *= 2) widen(width + window - 2 * span, span);
  if (span < window) widen(width, window - span);
}

template <typename Kind>
void larger_row(const typename Kind::T* a, const typename Kind::T* b, int width, typename Kind::T* result) {
  const typename Kind::D d;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d))) {
    hn::StoreU(hn::Max(hn::LoadU(d, a + x), hn::LoadU(d, b + x)), d, result + x);
  }
}

// Takes a row whose maxima along it are in the scratch row into a block, at index i of it; leaves the maxima
// of the window that ends with this row in the scratch row. Until row i comes, the block's rows from i on
// hold the maxima from there to the end of the block before.
template <typename Kind>
void run_down(RowBuffer<typename Kind::T>& block, int window, int i, int width) {
  auto *running = block.row(window), *scratch = block.row(window + 1);
  const auto bytes = static_cast<std::size_t>(width) * sizeof(typename Kind::T);
  std::memcpy(block.row(i), scratch, bytes);
  if (i == 0) {
    std::memcpy(running, scratch, bytes);
  } else {
    larger_row<Kind>(running, scratch, width, running);
  }
  if (i < window - 1) {
    larger_row<Kind>(block.row(i + 1), running, width, scratch);
    return;
  }
  std::memcpy(scratch, running, bytes);
  for (int k = window - 2; k >= 0; --k) larger_row<Kind>(block.row(k), block.row(k + 1), width, block.row(k));
}

// Which of the pixels in doubt have a claimant within tau: looks at all in the window, the middle rows first.
template <typename Kind>
HWY_INLINE hn::Mask<typename Kind::D> search(RowBuffer<typename Kind::T>& claimants, int window, int middle,
                                             int x, hn::Vec<typename Kind::D> depth,
                                             hn::Vec<typename Kind::D> tau,
                                             hn::Mask<typename Kind::D> doubtful) {
  const typename Kind::D d;
  const typename Kind::Gauge gauge(depth, tau);
  auto found = hn::MaskFromVec(hn::Zero(d));
  for (int k = 0; k < window; ++k) {
    // middle, middle + 1, middle - 1, middle + 2 ...
    const int offset = k % 2 == 1 ? (k + 1) / 2 : -(k / 2);
    const auto* row = claimants.row((middle + offset + window) % window) + x;
    auto nearest = gauge.measure(hn::LoadU(d, row));
    for (int i = 1; i < window; ++i) nearest = hn::Min(nearest, gauge.measure(hn::LoadU(d, row + i)));
    found = hn::Or(found, hn::And(doubtful, Kind::at_most(nearest, gauge.range)));
    if (hn::AllFalse(d, hn::AndNot(found, doubtful))) break;
  }
  return found;
}

// Adds to a row of the result. The rows' scratch rows hold the extremes of the windows; `middle` is the
// index of this row's claimants.
template <typename Kind>
void join_row(RefinementRows<typename Kind::T>& rows, int middle, typename Kind::T max_difference,
              std::uint8_t* result) {
  const typename Kind::D d;
  const hn::RebindToSigned<decltype(d)> di;
  const hn::Rebind<std::int8_t, decltype(d)> d8;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const auto tau = hn::Set(d, max_difference), none = hn::Set(d, Kind::none());
  const auto* max_depth = rows.max_depth.row(rows.window + 1);
  const auto* min_depth = rows.min_depth.row(rows.window + 1);
  std::uint8_t* mask = rows.mask.row(0);
  for (int x = 0; x < rows.width; x += lanes) {
    const auto high = hn::LoadU(d, max_depth + x);
    if (hn::AllFalse(d, hn::Ne(high, none))) continue;
    const auto z = hn::LoadU(d, rows.depth.row(0) + x);
    const auto open = hn::AndNot(load_dynamic<Kind>(mask + x), hn::And(Kind::present(z), hn::Ne(high, none)));
    if (hn::AllFalse(d, open)) continue;
    const auto low = Kind::mirrored(hn::LoadU(d, min_depth + x));
    const auto near =
        hn::Or(Kind::at_most(Kind::distance(z, high), tau), Kind::at_most(Kind::distance(z, low), tau));
    auto joins = hn::And(open, near);
    const auto between = hn::And(hn::Lt(low, z), hn::Lt(z, high));
    const auto doubtful = hn::And(open, hn::AndNot(near, between));
    if (!hn::AllFalse(d, doubtful)) {
      joins = hn::Or(joins, search<Kind>(rows.claimants, rows.window, middle, x, z, tau, doubtful));
    }
    // The mask's row is done with: what joins is noted there, so that whole vectors can be written.
    const auto bytes = hn::DemoteTo(d8, hn::BitCast(di, hn::VecFromMask(d, joins)));
    const auto before = hn::LoadU(d8, reinterpret_cast<const std::int8_t*>(mask + x));
    hn::StoreU(hn::Or(before, bytes), d8, reinterpret_cast<std::int8_t*>(mask + x));
  }
  copy_row(mask, rows.width, result, rows.columns.row(0));
}

template <typename Kind>
void refine_rows(const RefinementTask& task, typename Kind::T tau) {
  RefinementRows<typename Kind::T> rows(task);
  const int window = rows.window, radius = task.radius;
  // The window of row y reaches from y - radius to y + radius; rows come in at its lower end.
  const int first = task.top - radius;
  for (int y = first; y < task.bottom + radius; ++y) {
    const int i = (y - first) % window;
    auto *claimants = rows.claimants.row(i), *max_depth = rows.max_depth.row(window + 1);
    auto* min_depth = rows.min_depth.row(window + 1);
    const int row_size = rows.width + 2 * radius;
    if (y >= task.top && y < task.bottom) {
      fetch_row(task, y, rows);
      find_claimants<Kind>(rows, radius, claimants);
      std::memcpy(max_depth, claimants, static_cast<std::size_t>(row_size) * sizeof *max_depth);
      const typename Kind::D d;
      const auto none = hn::Set(d, Kind::none());
      for (int x = 0; x < row_size; x += static_cast<int>(hn::Lanes(d))) {
        const auto z = hn::LoadU(d, claimants + x);
        hn::StoreU(hn::IfThenElse(hn::Eq(z, none), none, Kind::mirrored(z)), d, min_depth + x);
      }
      run_along<Kind>(max_depth, rows.width, window);
      run_along<Kind>(min_depth, rows.width, window);
    } else {
      for (auto* row : {claimants, max_depth, min_depth}) std::fill_n(row, row_size, Kind::none());
    }
    run_down<Kind>(rows.max_depth, window, i, rows.width);
    run_down<Kind>(rows.min_depth, window, i, rows.width);
    const int middle = y - radius;
    if (middle < task.top) continue;
    fetch_row(task, middle, rows);
    join_row<Kind>(rows, (middle - first) % window, tau,
                   task.result + middle * task.result_stride + task.left);
  }
}

void refine_units(const RefinementTask& task, std::uint16_t tau) { refine_rows<Units>(task, tau); }
void refine_metres(const RefinementTask& task, float tau) { refine_rows<Metres>(task, tau); }

}  // namespace HWY_NAMESPACE
}  // namespace stdc
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace stdc {
HWY_EXPORT(copy_row);
HWY_EXPORT(refine_units);
HWY_EXPORT(refine_metres);

bool copy_mask_row(const std::uint8_t* mask, int width, std::uint8_t* result, std::uint8_t* columns) {
  return HWY_DYNAMIC_DISPATCH(copy_row)(mask, width, result, columns);
}

void refine_task(const RefinementTask& task, std::uint16_t tau) {
  HWY_DYNAMIC_DISPATCH(refine_units)(task, tau);
}

void refine_task(const RefinementTask& task, float tau) { HWY_DYNAMIC_DISPATCH(refine_metres)(task, tau); }

}  // namespace stdc
#endif
