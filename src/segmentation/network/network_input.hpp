#pragma once

#include <array>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>

#include "segmentation/network/kernels/tensor.hpp"
#include "segmentation/network/network_precision.hpp"
#include "segmentation/network/network_weights.hpp"

namespace stdc {

/// The network's input. For fp32: normalised planes, (x / 255 - mean) / deviation. For int8: the pixels as
/// they are, with the normalisation put into the weights of the first layer, so that nothing is lost by
/// quantising. There the zeros around the normalised image are pixels of the mean colour; the layer needs
/// only those above and to the left, and they are stored.
class NetworkInput {
 public:
  NetworkInput(const NetworkWeights& weights, cv::Size size, NetworkPrecision precision);

  cv::Size size() const { return size_; }
  /// What the first layer reads, and how much zero padding it still has to add above and to the left.
  const TensorView& view() const { return view_; }
  int padding() const { return is_int8() ? 0 : 1; }
  /// The first layer, for this input.
  ConvolutionWeights adapt(const ConvolutionWeights& first) const;
  /// Levels of its weights; `levels`: of activations. 255 * 64 * 2 < 2^15, see DnnlEngine.
  int weight_levels(int levels) const { return levels == 255 ? 127 : 64; }

  /// Takes a BGR image (CV_8UC3) of this size. Throws Error for another.
  void set(const cv::Mat& bgr);
  /// Takes a normalised image, [3][height][width]. Throws Error for another length and for int8.
  void set(std::span<const float> normalised);

 private:
  bool is_int8() const { return view_.type == ElementType::u8; }

  cv::Size size_;
  std::array<float, 3> mean_, deviation_;
  std::array<std::array<float, 256>, 3> normalised_;  ///< [channel][pixel value]
  std::shared_ptr<void> memory_;
  TensorView view_;
};

}  // namespace stdc
