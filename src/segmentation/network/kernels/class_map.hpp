#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "segmentation/network/logits.hpp"

namespace stdc {

/// Makes masks directly from the small logits. By definition: each class's logits are upsampled bilinearly to
/// the mask's size (half-pixel centres, the border repeated), and a pixel is dynamic if its greatest class
/// is. Here no class is ever upsampled as a whole: between two neighbouring logits of a row all classes are
/// linear, so if the same class wins at both, it wins in between, and only pixels where a border passes are
/// looked at.
class ClassMap {
 public:
  /// @param dynamic  [class]; a class that is named first wins ties
  ClassMap(cv::Size logits, cv::Size mask, std::vector<bool> dynamic);

  cv::Size size() const { return size_; }
  /// CV_8UC1, 255 = dynamic, else 0.
  cv::Mat draw(const Logits& logits);

 private:
  /// Where a line of the mask lies between two of the logits: (1 - weight) * first + weight * second.
  struct Sample {
    int first = 0, second = 0;
    float weight = 0;
  };
  static std::vector<Sample> samples(int count, int of);
  void blend_row(const Logits& logits, const Sample& sample);
  void draw_row(std::uint8_t* row) const;
  std::uint8_t pixel(const Sample& sample) const;

  cv::Size logits_size_, size_;
  std::vector<bool> dynamic_;
  bool two_classes_;  ///< one row: dynamic minus static
  std::vector<Sample> rows_, columns_;
  std::vector<float> blended_;           ///< [class][column of the logits]
  std::vector<int> winners_;             ///< [column of the logits]
  std::vector<float> best_;              ///< [column of the logits] of the winner
  std::vector<std::size_t> cell_begin_;  ///< [column of the logits] first mask column between it and the next
};

}  // namespace stdc
