#include "viewer/frame_history.hpp"

#include <algorithm>

namespace stdc {

void FrameHistory::add(const FrameRecord& record) {
  if (records_.size() >= max_records_) thin_out();
  starts_.push_back(frames_);
  records_.push_back(record);
  frames_ += record.frames;
}

/// Merges neighbours in the older half, all to about the same number of frames, until a quarter of the room
/// is free.
void FrameHistory::thin_out() {
  const std::size_t old = records_.size() / 2;
  std::size_t kept = old;
  while (true) {
    std::size_t last = 0;  // the record that the next one may be merged with
    for (std::size_t i = 1; i < kept; ++i) {
      if (records_[last].frames + records_[i].frames <= frames_per_record_) {
        records_[last] = merge(records_[last], records_[i]);
        continue;
      }
      ++last;
      records_[last] = records_[i], starts_[last] = starts_[i];
    }
    kept = last + 1;
    if (kept == 1 || kept <= max_records_ / 4) break;
    frames_per_record_ *= 2;
  }
  const auto gap = [&](auto& list) {
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(kept),
               list.begin() + static_cast<std::ptrdiff_t>(old));
  };
  gap(records_), gap(starts_);
}

FrameHistory::Part FrameHistory::from(std::uint32_t first, std::size_t max) const {
  const auto begin = std::lower_bound(starts_.begin(), starts_.end(), first) - starts_.begin();
  const auto count =
      static_cast<std::ptrdiff_t>(std::min(max, records_.size() - static_cast<std::size_t>(begin)));
  if (count == 0) return {frames_, {}};
  return {starts_[static_cast<std::size_t>(begin)],
          {records_.begin() + begin, records_.begin() + begin + count}};
}

}  // namespace stdc
