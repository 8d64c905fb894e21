#pragma once

#include <memory>

#include "segmentation/network/kernels/dnnl_convolution.hpp"
#include "segmentation/network/kernels/tensor.hpp"
#include "segmentation/network/network_weights.hpp"

namespace stdc {

/// A 3x3 convolution of 8-bit levels with stride 1, a border of zeros, bias and ReLU, by Winograd's minimal
/// filtering F(2x2, 3x3): 16 multiplications for 4 outputs instead of 36 (Lavin and Gray, 'Fast Algorithms
/// for Convolutional Neural Networks', CVPR 2016). Its transforms of levels and weights fit 16 bits and the
/// sums 32, so the sums are exactly those of the definition. Where pairs of 16-bit products are summed by one
/// instruction (VPMADDWD), but 8-bit ones need three (no VNNI), it takes 0.7 of the time of oneDNN's direct
/// kernels. One thread.
class IntegerWinograd {
 public:
  /// True if it can do this layer in these layouts, and is the faster way on this processor.
  static bool suits(const ConvolutionWeights& layer, const TensorView& source, const TensorView& target);
  /// True if it can do this layer in these layouts.
  static bool fits(const ConvolutionWeights& layer, const TensorView& source, const TensorView& target);

  /// Memory of one run, which all layers of a network share: they run one after another.
  struct Scratch {
    std::size_t bytes = 0;
    std::shared_ptr<void> memory;
  };

  /// The target's numbers are those of DnnlConvolution; one padding of zeros and ReLU, whatever `options`
  /// say.
  IntegerWinograd(const ConvolutionWeights& layer, const TensorView& source, const TensorView& target,
                  const ConvolutionOptions& options, std::shared_ptr<Scratch> scratch);
  ~IntegerWinograd();

  /// Reads the source, writes the target. Allocates nothing.
  void run();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace stdc
