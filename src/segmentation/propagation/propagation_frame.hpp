#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace stdc {

/// A small grey image with its border repeated around it, so that patches may hang over the edge.
class SmallImage {
 public:
  static constexpr int kBorder = 8;  ///< [px]

  void resize(int width, int height);
  /// Repeats the outermost pixels outward; to be called when the inside is written.
  void fill_border();
  int width() const { return width_; }
  int height() const { return height_; }
  int stride() const { return width_ + 2 * kBorder; }
  /// Row y >= -kBorder; columns from -kBorder to width + kBorder - 1 may be read.
  std::uint8_t* row(int y) { return pixels_.data() + offset(y); }
  const std::uint8_t* row(int y) const { return pixels_.data() + offset(y); }

 private:
  std::size_t offset(int y) const {
    return static_cast<std::size_t>(y + kBorder) * static_cast<std::size_t>(stride()) + kBorder;
  }
  int width_ = 0, height_ = 0;
  std::vector<std::uint8_t> pixels_;
};

/// What the propagation of masks keeps of a frame: the picture at about 160 pixels' width and two halvings of
/// that, and the depth. A pixel of the largest level is a `cell` of the frame.
struct SmallFrame {
  static constexpr int kLevels = 3;

  int number = 0;  ///< of the frame in its sequence
  int scale = 1;   ///< side of a cell in pixels of the frame
  std::array<SmallImage, kLevels> levels;
  std::vector<float> depth;  ///< of each cell [m]; 0: missing

  int width() const { return levels[0].width(); }
  int height() const { return levels[0].height(); }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width() && y < height(); }
  float depth_at(int x, int y) const {
    return depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) +
                 static_cast<std::size_t>(x)];
  }
};

/// Side of a cell for frames of that width [px].
int cell_size(int frame_width);

/// Shrinks a frame. `grey`: CV_8UC1; `depth`: CV_16UC1 in 1/`units_per_metre` m or CV_32FC1 in metres, of the
/// same size. Memory of `small` is used again.
void shrink_frame(const cv::Mat& grey, const cv::Mat& depth, double units_per_metre, SmallFrame& small);

/// The depth only; the picture has its size, but its pixels mean nothing.
void shrink_depth(const cv::Mat& depth, double units_per_metre, SmallFrame& small);

/// Depth of a pixel in metres; 0 if it is missing.
float metres_at(const cv::Mat& depth, int x, int y, float metres_per_unit);

}  // namespace stdc
