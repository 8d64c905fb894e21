#pragma once

#include <memory>

#include "segmentation/network/kernels/dnnl_convolution.hpp"
#include "segmentation/network/kernels/tensor.hpp"
#include "segmentation/network/network_weights.hpp"

namespace stdc {

/// A convolution by its definition, for processors that oneDNN has no fast kernels for: 64-bit ARM without
/// SVE. Any kernel, stride and layout. The sums of levels are exact. One thread.
class DirectConvolution {
 public:
  /// True if levels of this layout are multiplied by ARM's dot product instructions.
  static bool has_dot_products(const TensorView& source);

  /// The target's numbers are those of DnnlConvolution.
  DirectConvolution(const ConvolutionWeights& layer, const TensorView& source, const TensorView& target,
                    const ConvolutionOptions& options);
  ~DirectConvolution();

  /// Reads the source, writes the target. Allocates nothing.
  void run();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace stdc
