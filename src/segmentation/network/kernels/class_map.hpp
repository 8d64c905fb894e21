#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "segmentation/network/logits.hpp"

namespace stdc {

/// Makes masks and class maps directly from the small logits. By definition: each class's logits are
/// upsampled bilinearly to the mask's size (half-pixel centres, the border repeated), and a pixel is of its
/// greatest class. Here no class is ever upsampled as a whole: between two neighbouring logits of a row all
/// classes are linear, so if the same class wins at both, it wins in between, and only pixels where a border
/// passes are looked at.
class ClassMap {
 public:
  /// @param dynamic  [class]; a class that is named first wins ties
  ClassMap(cv::Size logits, cv::Size mask, std::vector<bool> dynamic);

  cv::Size size() const { return size_; }
  /// CV_8UC1, 255 = dynamic, else 0.
  cv::Mat draw(const Logits& logits);
  /// CV_8UC1, the number of each pixel's class; of at most 256.
  cv::Mat draw_classes(const Logits& logits);

 private:
  /// Where a line of the mask lies between two of the logits: (1 - weight) * first + weight * second.
  struct Sample {
    int first = 0, second = 0;
    float weight = 0;
  };
  static std::vector<Sample> samples(int count, int of);
  void blend_row(const Logits& logits, const Sample& sample);
  cv::Mat paint(const Logits& logits, const std::vector<std::uint8_t>& value_of_class);
  void paint_row(const std::vector<std::uint8_t>& value_of_class, std::uint8_t* row) const;
  std::size_t class_at(const Sample& sample) const;
  std::size_t two_class_winner(float difference) const;

  cv::Size logits_size_, size_;
  std::vector<bool> dynamic_;
  bool two_classes_;  ///< one row: dynamic minus static
  std::vector<Sample> rows_, columns_;
  std::vector<float> blended_;           ///< [class][column of the logits]
  std::vector<std::size_t> winners_;     ///< [column of the logits]
  std::vector<float> best_;              ///< [column of the logits] of the winner
  std::vector<std::size_t> cell_begin_;  ///< [column of the logits] first mask column between it and the next
};

}  // namespace stdc
