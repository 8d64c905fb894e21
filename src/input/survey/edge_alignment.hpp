#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

namespace stdc {

/// Where the edges of depth images lie in the colour images.
struct EdgeShift {
  double x = 0, y = 0;  ///< by how much depth edges lie to the right of colour edges, and below them [px]
  double gain = 0;      ///< how much more colour edge they would meet there than where they are: 0 = as much
  double clarity = 0;   ///< standard deviations of the best shift above all shifts
};

/// Finds by how much depth edges have to be moved to lie on colour edges: what stands in front of something
/// ends in both images. Adds over images; a few that show some edges are enough.
class EdgeAlignment {
 public:
  /// @param max_shift  [px] of an image of 640 pixels; others in proportion
  explicit EdgeAlignment(int max_shift = 32) : max_shift_(max_shift) {}

  /// @param colour  CV_8UC1 or CV_8UC3
  /// @param depth   CV_16UC1 or CV_32FC1, of the same size
  void add(const cv::Mat& colour, const cv::Mat& depth);
  /// Of all images; nothing if they have too few depth edges.
  std::optional<EdgeShift> shift() const;
  /// Of the left and of the right third alone: they differ if the focal lengths do.
  std::optional<EdgeShift> left_shift() const;
  std::optional<EdgeShift> right_shift() const;

 private:
  struct Votes {
    cv::Mat sums;  ///< CV_64FC1: colour edge met by each shift
    double edges = 0;
  };
  void vote(const cv::Mat& colour_edges, const cv::Mat& depth_edges, cv::Range columns, Votes& votes) const;
  std::optional<EdgeShift> best(const Votes& votes) const;

  int max_shift_;
  double pixels_ = 1;  ///< of the image for one of the small ones that are compared
  Votes all_, left_, right_;
};

}  // namespace stdc
