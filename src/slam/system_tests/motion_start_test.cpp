// A map that begins while things come in and the camera sets off: whatever part of the room it turns to, a
// pose that is called ok is right.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include "slam/system_tests/test_board.hpp"
#include "slam/system_tests/test_walk.hpp"

namespace stdc {
namespace {

using test::Board;
using test::Walk;

/// Two boards that come in from the left and from the right, again and again, each round with another print.
struct BusyStart {
  int seed;
  int left_width, right_width;     ///< [px]
  int left_step, right_step;       ///< [px/frame]
  double left_depth, right_depth;  ///< [m]
  double contrast;                 ///< of their prints
  int still_frames;                ///< before they come in
  int from, to;                    ///< places between which the camera goes to and fro
};

void PrintTo(const BusyStart& start, std::ostream* stream) {
  *stream << "boards " << start.seed << ", camera from " << start.from << " to " << start.to;
}

class MotionStart : public testing::TestWithParam<BusyStart> {};

TEST_P(MotionStart, NoPoseThatIsCalledOkIsWrong) {
  const BusyStart& start = GetParam();
  Settings settings;
  settings.segmentation.source = SegmentationSource::off;
  Walk walk(settings);
  int frame = 0;
  for (int round = 0; round < 4; ++round) {
    const Board left(start.left_width, 200, start.left_depth, start.seed + round, start.contrast);
    const Board right(start.right_width, 200, start.right_depth, start.seed + 20 + round, start.contrast);
    const auto busy = [&](RgbdImage& image) {
      const int i = frame++ - start.still_frames;
      if (i < 0) return;
      const int left_period = (320 + start.left_width) / start.left_step + 3;
      const int right_period = (320 + start.right_width) / start.right_step + 3;
      left.paste(image, -start.left_width + start.left_step * (i % left_period), 30);
      right.paste(image, 320 - start.right_step * (i % right_period), 40);
    };
    walk.go(round % 2 == 0 ? start.from : start.to, round % 2 == 0 ? start.to : start.from, busy);
  }
  const std::vector<double> errors = walk.live_errors();
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (walk.results[i].status != TrackingStatus::ok) continue;
    EXPECT_LT(errors[i], 0.05) << "frame " << i << ", map " << walk.results[i].map.value;
  }
  EXPECT_LT(walk.worst_error_of_all(), 0.05) << "nor is one of the trajectory in the end";
  EXPECT_GT(walk.count(TrackingStatus::ok), 0.5 * static_cast<double>(errors.size()));
}

// In the first, boards pass as fast as the picture does: what comes in with the view that the camera turns
// to.
INSTANTIATE_TEST_SUITE_P(Rooms, MotionStart,
                         testing::Values(BusyStart{20, 70, 60, 8, 7, 1.00, 1.20, 1.0, 1, 0, 40},
                                         BusyStart{106, 98, 92, 11, 3, 1.23, 1.18, 1.0, 5, 2, 42},
                                         BusyStart{112, 143, 55, 11, 12, 1.19, 1.30, 1.0, 1, 80, 40},
                                         BusyStart{119, 150, 96, 10, 8, 0.78, 1.14, 1.0, 0, 43, 83},
                                         BusyStart{123, 145, 137, 10, 3, 1.39, 1.00, 1.0, 3, 55, 95},
                                         BusyStart{129, 133, 129, 10, 8, 0.78, 1.35, 0.4, 3, 66, 106}));

}  // namespace
}  // namespace stdc
