#include "motion/covered_holes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace stdc {
namespace {

/// A wall of one grey, 2 m ahead; on the left of the frame, `columns` wide, a hole in the depth of another
/// grey.
struct WallWithHole {
  GridGeometry geometry{Camera()};
  StaticScene scene{geometry, MotionSettings()};

  SceneFrame frame(int columns, std::uint8_t grey, double time) const {
    SceneFrame frame;
    frame.timestamp = time;
    frame.map = {0};
    frame.reference = {0};
    const auto cells = static_cast<std::size_t>(geometry.size());
    frame.grid.depth.assign(cells, 2);
    frame.grid.grey.assign(cells, 100);
    for_each_cell_of_hole(columns, [&](std::size_t cell) {
      frame.grid.depth[cell] = 0;
      frame.grid.grey[cell] = grey;
    });
    frame.grid.find_extremes(geometry.width(), geometry.height());
    return frame;
  }
  template <typename Visit>
  void for_each_cell_of_hole(int columns, Visit&& visit) const {
    for (int y = 0; y < geometry.height(); ++y) {
      for (int x = 0; x < columns; ++x) visit(geometry.index(x, y));
    }
  }
  /// Cells found after a view of the same wall with a hole that was `known` columns wide.
  int found(int known, int columns, std::uint8_t grey, int reach = 1) {
    const SceneFrame view = frame(known, 100, 0);
    const auto cells = static_cast<std::size_t>(geometry.size());
    scene.add(view, std::vector<float>(cells, 0), std::vector<std::uint8_t>(cells, 0));
    SceneFrame now = frame(columns, grey, 1);
    now.grid.reach = reach;
    scene.choose(now);
    const std::vector<std::uint8_t> covered = find_covered_holes(scene, geometry, now);
    return static_cast<int>(std::count(covered.begin(), covered.end(), 1));
  }
  /// Cells found to show the wall, of all that are said to move, after a view of the whole wall.
  int uncovered(int columns, std::uint8_t grey) {
    const SceneFrame view = frame(0, 100, 0);
    const auto cells = static_cast<std::size_t>(geometry.size());
    scene.add(view, std::vector<float>(cells, 0), std::vector<std::uint8_t>(cells, 0));
    const SceneFrame now = frame(columns, grey, 1);
    scene.choose(now);
    const std::vector<std::uint8_t> found =
        find_uncovered_holes(scene, geometry, now, std::vector<std::uint8_t>(cells, 255));
    return static_cast<int>(std::count(found.begin(), found.end(), 1));
  }
};

TEST(CoveredHoles, WhatIsTooNearForTheSensorIsFoundByItsLooks) {
  const int width = WallWithHole().geometry.width(), height = WallWithHole().geometry.height();
  EXPECT_GT(WallWithHole().found(0, width / 3, 180), 0.95 * width / 3 * height);
}

TEST(CoveredHoles, OtherHolesTellNothing) {
  const int width = WallWithHole().geometry.width();
  EXPECT_EQ(WallWithHole().found(0, width / 3, 104), 0) << "looks as the wall did";
  EXPECT_EQ(WallWithHole().found(width / 3, width / 3, 180), 0)
      << "the view has the same hole, as of a screen";
  EXPECT_EQ(WallWithHole().found(0, width / 10, 180), 0) << "small";
  EXPECT_EQ(WallWithHole().found(0, width / 3, 180, 3), 0) << "the camera turns fast";
}

TEST(UncoveredHoles, ShowTheWallWhereTheySeemAsItDid) {
  const int width = WallWithHole().geometry.width(), height = WallWithHole().geometry.height();
  EXPECT_EQ(WallWithHole().uncovered(width / 10, 104), width / 10 * height) << "a shadow of the projector";
  EXPECT_EQ(WallWithHole().uncovered(width / 10, 180), 0) << "something stands there";
  EXPECT_EQ(WallWithHole().uncovered(0, 100), 0) << "what has a depth is not for looks to judge";
}

}  // namespace
}  // namespace stdc
