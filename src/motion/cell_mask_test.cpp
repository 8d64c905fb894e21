#include "motion/cell_mask.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>

namespace stdc {
namespace {

TEST(CellMask, SquaresBecomePixelsAndBack) {
  const Camera camera;
  const GridGeometry geometry(camera);
  std::vector<std::uint8_t> squares(static_cast<std::size_t>(geometry.size()), 0);
  for (int y = 40; y < 60; ++y) {
    for (int x = 30; x < 50; ++x) squares[static_cast<std::size_t>(y * geometry.width() + x)] = 1;
  }
  const cv::Mat depth(camera.height, camera.width, CV_16UC1, cv::Scalar(0));
  const cv::Mat mask = mask_of_squares(squares, geometry.scale(), camera, depth);
  EXPECT_EQ(cv::countNonZero(mask), 20 * 20 * geometry.scale() * geometry.scale());
  const auto back = squares_of_mask(mask, geometry.scale(), camera);
  const auto cells = cells_of_mask(mask, geometry);
  for (std::size_t i = 0; i < squares.size(); ++i) {
    EXPECT_EQ(back[i] != 0, squares[i] != 0);
    EXPECT_EQ(cells[i] != 0, squares[i] != 0);  // without distortion cells are squares
  }
  EXPECT_EQ(squares_of_cells(squares, geometry), squares);
}

TEST(CellMask, NoMaskIsNothing) {
  const auto squares = squares_of_mask({}, 4, Camera());
  EXPECT_EQ(std::count(squares.begin(), squares.end(), 0), static_cast<std::ptrdiff_t>(squares.size()));
}

}  // namespace
}  // namespace stdc
