#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "viewer/frame_record.hpp"

namespace stdc {

/// The records of a run's frames, in bounded memory: of the last frames a record each, of older ones a record
/// for several, evenly over the run, which says the worst of them (see merge()). So the curves of a robot's
/// whole day keep their peaks and what was lost. Not for several threads.
class FrameHistory {
 public:
  static constexpr std::size_t kMaxRecords = 40'000;  ///< 22 minutes at 30 frames a second, 4 MB

  explicit FrameHistory(std::size_t max_records = kMaxRecords) : max_records_(max_records) {}

  void add(const FrameRecord& record);

  struct Part {
    std::uint32_t first = 0;  ///< number of the first frame that the records stand for
    std::vector<FrameRecord> records;
  };
  /// Records of the `first` frame and those after it, at most `max`. A record that also stands for earlier
  /// frames is left out.
  Part from(std::uint32_t first, std::size_t max) const;

  std::uint32_t frame_count() const { return frames_; }
  std::size_t record_count() const { return records_.size(); }

 private:
  void thin_out();

  std::size_t max_records_;
  std::vector<FrameRecord> records_;
  std::vector<std::uint32_t> starts_;  ///< number of each record's first frame
  std::uint32_t frames_ = 0;
  std::uint32_t frames_per_record_ = 1;  ///< of old frames
};

}  // namespace stdc
