#include "dense/fusion/field_windows.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "dense/fusion/rectifier.hpp"
#include "dense/fusion/test_views.hpp"

namespace stdc {
namespace {

/// Cameras beside each other, so that none sees all of the wall; the last knows that the ball moves.
std::vector<PlacedView> views_along_a_wall() {
  std::vector<PlacedView> views;
  for (const double x : {-1.5, -0.8, 0.0, 0.8, 1.5}) views.push_back(test::ball_and_wall({x, 0, 0}));
  views.push_back(test::moving_ball());
  return views;
}

struct WholeField {
  std::vector<std::int32_t> sums;
  std::vector<std::uint16_t> weights;
  std::vector<BlockKey> keys;
  std::size_t windows = 0, most_held = 0, largest_layer = 0;
};

WholeField field_of(std::size_t window_blocks, int threads = 1) {
  WholeField whole;
  for_each_window(views_along_a_wall(), pinhole_of(test::dense_camera()), test::coarse_settings(), threads,
                  window_blocks, [&](const DistanceField& field, BlockRange blocks) {
                    ++whole.windows;
                    whole.most_held = std::max(whole.most_held, field.held().size());
                    EXPECT_EQ(blocks.first, whole.keys.size()) << "in order, and none left out";
                    for (std::size_t block = blocks.first; block < blocks.last; ++block) {
                      const auto sums = field.sums(block);
                      const auto weights = field.weights(block);
                      whole.sums.insert(whole.sums.end(), sums.begin(), sums.end());
                      whole.weights.insert(whole.weights.end(), weights.begin(), weights.end());
                      whole.keys.push_back(field.blocks().keys()[block]);
                      whole.largest_layer =
                          std::max(whole.largest_layer, field.blocks().end_of_layer(block) - block);
                    }
                    // What touches these blocks is there, too.
                    EXPECT_TRUE(blocks.first == 0 || field.held().contains(blocks.first - 1));
                    EXPECT_TRUE(blocks.last == field.blocks().size() || field.held().contains(blocks.last));
                  });
  return whole;
}

TEST(FieldWindows, HoldTheVoxelsThatTheWholeFieldHas) {
  const WholeField whole = field_of(1000000);
  ASSERT_EQ(whole.windows, 1U);
  ASSERT_GT(whole.keys.size(), 200U);
  EXPECT_TRUE(std::is_sorted(whole.keys.begin(), whole.keys.end()));
  for (const std::size_t window_blocks : {1U, 40U, 100U}) {
    const WholeField parts = field_of(window_blocks, 2);
    EXPECT_GT(parts.windows, 2U) << window_blocks;
    EXPECT_EQ(parts.keys, whole.keys);
    EXPECT_EQ(parts.sums, whole.sums) << window_blocks;
    EXPECT_EQ(parts.weights, whole.weights) << window_blocks;
  }
}

TEST(FieldWindows, HoldNoMoreThanTheyAreAllowed) {
  for (const std::size_t window_blocks : {1U, 40U, 100U}) {
    const WholeField parts = field_of(window_blocks);
    // A window may be half as large again, rather than that there is one more, and has whole layers: two from
    // before, and one to fill it up.
    EXPECT_LE(parts.most_held, window_blocks * 3 / 2 + 3 * parts.largest_layer) << window_blocks;
  }
}

TEST(FieldWindows, NoViewsGiveNoWindow) {
  for_each_window({}, pinhole_of(test::dense_camera()), test::coarse_settings(), 1, 100,
                  [](const DistanceField&, BlockRange) { ADD_FAILURE(); });
}

}  // namespace
}  // namespace stdc
