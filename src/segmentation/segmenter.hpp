#pragma once

#include <opencv2/core/mat.hpp>

namespace stdc {

/// Input of a segmenter.
struct SegmenterInput {
  cv::Mat colour;        ///< BGR (CV_8UC3) or grey (CV_8UC1)
  double timestamp = 0;  ///< [s]
  int frame = 0;         ///< index in the sequence
};

/// Finds the pixels of a colour image that belong to classes that move by themselves. The interface
/// of all segmenters: the network, any ONNX model, masks from files.
class Segmenter {
 public:
  virtual ~Segmenter() = default;
  /// @returns CV_8UC1 of the image's size, 255 = dynamic, else 0; empty: the frame could not be segmented.
  /// May be called from one thread at a time, any thread. Throws Error for an image of another type.
  virtual cv::Mat segment(const SegmenterInput& input) = 0;
  /// Delay in calls: a mask is that of the frame so many calls before.
  virtual int delay() const { return 0; }
};

}  // namespace stdc
