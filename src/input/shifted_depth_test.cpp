#include "input/shifted_depth.hpp"

#include <gtest/gtest.h>

#include "input/open_source.hpp"
#include "input/test_layouts.hpp"

namespace stdc {
namespace {

constexpr int kShiftedFrames = 10;

/// Number of the colour and of the depth image of each frame, by what the images hold.
std::vector<std::pair<int, int>> pairs_of(FrameSource& source) {
  std::vector<std::pair<int, int>> pairs;
  while (const auto frame = source.next()) {
    const int colour = frame->images->colour({}, ColourMode::as_stored).at<cv::Vec3b>(0, 0)[0];
    pairs.emplace_back(colour, frame->images->depth({}).at<std::uint16_t>(0, 0) - 5000);
  }
  return pairs;
}

class ShiftedDepth : public testing::Test {
 protected:
  ShiftedDepth() { test::write_tum_folder(folder_, "s", kShiftedFrames); }  // 30 Hz, depth 5 ms after colour
  std::unique_ptr<FrameSource> shifted(double offset) const {
    return shift_depth(open_source(folder_ / "s"), offset);
  }
  test::TestFolder folder_;
};

TEST_F(ShiftedDepth, GivesTheDepthThatWasTakenNearest) {
  for (const int late : {-3, -1, 0, 1, 3}) {
    const auto source = shifted(late / 30.0);
    std::vector<std::pair<int, int>> expected;
    for (int i = 0; i < kShiftedFrames; ++i) {
      if (i - late >= 0 && i - late < kShiftedFrames) expected.emplace_back(i, i - late);
    }
    EXPECT_EQ(pairs_of(*source), expected) << late;
    EXPECT_EQ(source->colour_without_depth(), std::abs(late));
    source->rewind();
    EXPECT_EQ(pairs_of(*source), expected) << "again, " << late;
  }
}

TEST_F(ShiftedDepth, PairsWhatLiesNear) {
  const auto source = shifted(0.010);  // 15 ms after colour: within 20
  EXPECT_EQ(pairs_of(*source).size(), std::size_t{kShiftedFrames});
  const auto far = shifted(5);
  EXPECT_FALSE(far->next());
  EXPECT_EQ(far->colour_without_depth(), kShiftedFrames);
}

}  // namespace
}  // namespace stdc
