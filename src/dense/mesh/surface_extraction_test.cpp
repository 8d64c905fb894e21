#include "dense/mesh/surface_extraction.hpp"

#include <gtest/gtest.h>

#include "dense/fusion/field_windows.hpp"
#include "dense/fusion/rectifier.hpp"
#include "dense/fusion/test_views.hpp"

namespace stdc {
namespace {

TriangleMesh surface_of(std::size_t window_blocks) {
  std::vector<PlacedView> views;
  for (const double x : {-1.5, -0.8, 0.0, 0.8, 1.5}) views.push_back(test::ball_and_wall({x, 0.1, 0}));
  SurfaceExtraction surface(test::coarse_settings().min_weight);
  for_each_window(views, pinhole_of(test::dense_camera()), test::coarse_settings(), 1, window_blocks,
                  [&](const DistanceField& field, BlockRange blocks) { surface.add(field, blocks); });
  return surface.take();
}

TEST(SurfaceExtraction, OfPartsOfAFieldIsThatOfTheWhole) {
  const TriangleMesh whole = surface_of(1000000);
  ASSERT_GT(whole.triangles.size(), 10000U);
  for (const std::size_t window_blocks : {1U, 30U, 150U}) {
    const TriangleMesh parts = surface_of(window_blocks);
    EXPECT_EQ(parts.positions, whole.positions) << window_blocks;
    EXPECT_EQ(parts.triangles, whole.triangles) << window_blocks;
  }
}

TEST(SurfaceExtraction, OfNothingIsEmpty) { EXPECT_TRUE(SurfaceExtraction(3).take().empty()); }

}  // namespace
}  // namespace stdc
