#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/camera.hpp"
#include "motion/depth_grid.hpp"

namespace stdc {

/// The mask of some squares of raw pixels as they are.
/// @param squares  not 0 = dynamic: camera.width / scale of them in a row, row by row
/// @returns CV_8UC1 of the camera's size, 255 = dynamic
cv::Mat draw_squares(const std::vector<std::uint8_t>& squares, int scale, const Camera& camera);

/// The same, its outline drawn by the depth image.
/// @param depth    as in RgbdImage, of the camera's size
/// @returns CV_8UC1 of the camera's size, 255 = dynamic
cv::Mat mask_of_squares(const std::vector<std::uint8_t>& squares, int scale, const Camera& camera,
                        const cv::Mat& depth);

/// The squares that show the given cells of a depth grid.
std::vector<std::uint8_t> squares_of_cells(const std::vector<std::uint8_t>& cells,
                                           const GridGeometry& geometry);

/// Of each square whether its middle is in a mask (CV_8UC1 of the camera's size; empty: nothing is).
std::vector<std::uint8_t> squares_of_mask(const cv::Mat& mask, int scale, const Camera& camera);

/// Of each cell of a grid whether its middle is in a mask.
std::vector<std::uint8_t> cells_of_mask(const cv::Mat& mask, const GridGeometry& geometry);

}  // namespace stdc
