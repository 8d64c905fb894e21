#include "motion/cell_mask.hpp"

#include <algorithm>
#include <cmath>

#include "segmentation/propagation/mask_settling.hpp"

namespace stdc {

cv::Mat draw_squares(const std::vector<std::uint8_t>& squares, int scale, const Camera& camera) {
  cv::Mat mask(camera.height, camera.width, CV_8UC1, cv::Scalar(0));
  const auto columns = static_cast<std::size_t>(camera.width / scale);
  for (std::size_t i = 0; i < squares.size(); ++i) {
    if (squares[i] == 0) continue;
    // The first row of pixels of each row of squares, which is then repeated: there may be thousands of
    // squares.
    std::fill_n(mask.ptr<std::uint8_t>(static_cast<int>(i / columns) * scale) +
                    i % columns * static_cast<std::size_t>(scale),
                scale, std::uint8_t{255});
  }
  for (std::size_t row = 0; row < squares.size() / columns; ++row) {
    const auto* first = mask.ptr<std::uint8_t>(static_cast<int>(row) * scale);
    for (int y = 1; y < scale; ++y)
      std::copy_n(first, mask.cols, mask.ptr<std::uint8_t>(static_cast<int>(row) * scale + y));
  }
  return mask;
}

cv::Mat mask_of_squares(const std::vector<std::uint8_t>& squares, int scale, const Camera& camera,
                        const cv::Mat& depth) {
  cv::Mat mask = draw_squares(squares, scale, camera);
  const bool any =
      std::any_of(squares.begin(), squares.end(), [](std::uint8_t square) { return square != 0; });
  return any ? settle_by_depth(mask, depth, camera.depth_units_per_metre) : mask;
}

std::vector<std::uint8_t> squares_of_cells(const std::vector<std::uint8_t>& cells,
                                           const GridGeometry& geometry) {
  std::vector<std::uint8_t> squares(cells.size(), 0);
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const int cell = geometry.cell_of_square()[i];
    if (cell >= 0) squares[i] = cells[static_cast<std::size_t>(cell)];
  }
  return squares;
}

std::vector<std::uint8_t> squares_of_mask(const cv::Mat& mask, int scale, const Camera& camera) {
  const int columns = camera.width / scale, rows = camera.height / scale;
  std::vector<std::uint8_t> squares(static_cast<std::size_t>(columns * rows), 0);
  if (mask.empty()) return squares;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      squares[static_cast<std::size_t>(y * columns + x)] =
          mask.at<std::uint8_t>(y * scale + scale / 2, x * scale + scale / 2);
    }
  }
  return squares;
}

std::vector<std::uint8_t> cells_of_mask(const cv::Mat& mask, const GridGeometry& geometry) {
  std::vector<std::uint8_t> cells(static_cast<std::size_t>(geometry.size()), 0);
  if (mask.empty()) return cells;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Eigen::Vector2f& raw = geometry.raw_pixels()[i];
    const int x = static_cast<int>(std::lround(raw.x())), y = static_cast<int>(std::lround(raw.y()));
    if (x >= 0 && y >= 0 && x < mask.cols && y < mask.rows) cells[i] = mask.at<std::uint8_t>(y, x);
  }
  return cells;
}

}  // namespace stdc
