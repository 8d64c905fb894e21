#include "viewer/frame_history.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace stdc {
namespace {

FrameRecord record_of(std::uint32_t frame) {
  FrameRecord record;
  record.frame = frame;
  record.timestamp = frame / 30.0;
  record.milliseconds = 10;
  record.inliers = 300;
  record.status = TrackingStatus::ok;
  record.tracked = 1;
  record.flags = FrameRecord::kPose;
  return record;
}

/// A day has 2.6 million frames; a hundred times fewer in a hundredth of the room do here.
constexpr std::uint32_t kFrames = 26'000, kSlow = 1234, kLost = 5000, kFound = 5400;
constexpr std::size_t kRoom = 400;

FrameHistory history_of_a_day() {
  FrameHistory history(kRoom);
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    FrameRecord record = record_of(frame);
    if (frame == kSlow) record.milliseconds = 400, record.flags |= FrameRecord::kLoop;
    if (frame >= kLost && frame < kFound) record.status = TrackingStatus::lost, record.tracked = 0;
    history.add(record);
    EXPECT_LE(history.record_count(), kRoom);
  }
  return history;
}

TEST(FrameHistory, OfADayIsBoundedAndStandsForEachFrameOnce) {
  const FrameHistory history = history_of_a_day();
  EXPECT_EQ(history.frame_count(), kFrames);
  const auto [first, records] = history.from(0, 1'000'000);
  EXPECT_EQ(first, 0U);
  EXPECT_EQ(records.size(), history.record_count());
  std::uint32_t frames = 0, tracked = 0, largest = 0;
  for (const FrameRecord& record : records) {
    frames += record.frames, tracked += record.tracked;
    largest = std::max(largest, record.frames);
    EXPECT_EQ(record.frame, frames - 1);  // the last that it stands for
  }
  EXPECT_EQ(frames, kFrames);
  EXPECT_EQ(tracked, kFrames - (kFound - kLost));
  EXPECT_LE(largest, 2 * 4 * kFrames / kRoom);  // evenly over the run
  for (std::size_t i = records.size() - kRoom / 2; i < records.size(); ++i) EXPECT_EQ(records[i].frames, 1U);
}

TEST(FrameHistory, KeepsPeaksAndLosses) {
  const auto records = history_of_a_day().from(0, 1'000'000).records;
  const auto slow =
      std::find_if(records.begin(), records.end(), [](const auto& r) { return r.frame >= kSlow; });
  EXPECT_EQ(slow->milliseconds, 400);
  EXPECT_TRUE(slow->flags & FrameRecord::kLoop);
  std::uint32_t lost = 0;
  for (const FrameRecord& record : records) lost += record.status == TrackingStatus::lost ? record.frames : 0;
  EXPECT_GE(lost, kFound - kLost);
  EXPECT_LE(lost, kFound - kLost + 2 * 4 * 2 * kFrames / kRoom);  // and what is beside them in a record
}

TEST(FrameHistory, GoesOnWhereAPageWas) {
  FrameHistory history(8);
  for (std::uint32_t frame = 0; frame < 6; ++frame) history.add(record_of(frame));
  auto part = history.from(0, 4);
  EXPECT_EQ(part.first, 0U);
  EXPECT_EQ(part.records.size(), 4U);
  EXPECT_EQ(history.from(4, 4).records.size(), 2U);
  EXPECT_TRUE(history.from(6, 4).records.empty());
  for (std::uint32_t frame = 6; frame < 12; ++frame) history.add(record_of(frame));
  part = history.from(3, 100);  // what a slow page has not been sent is merged with what it has
  EXPECT_GE(part.first, 3U);
  std::uint32_t frames = part.first;
  for (const FrameRecord& record : part.records) frames += record.frames;
  EXPECT_EQ(frames, 12U);
}

}  // namespace
}  // namespace stdc
