#pragma once

#include <memory>
#include <string>

#include "segmentation/network/kernels/tensor.hpp"
#include "segmentation/network/network_weights.hpp"

namespace stdc {

/// The engine of oneDNN and what all its convolutions share. This file pair is the only one that knows
/// oneDNN; it builds with versions 2.6 and 3.
class DnnlEngine {
 public:
  DnnlEngine();
  ~DnnlEngine();
  DnnlEngine(const DnnlEngine&) = delete;
  DnnlEngine& operator=(const DnnlEngine&) = delete;

  /// Largest activation level of int8: 255 where products of 8-bit numbers are summed in 32 bits (AVX-512
  /// VNNI, if ONEDNN_MAX_CPU_ISA allows it). Elsewhere pairs of products are summed in 16 bits with
  /// saturation (VPMADDUBSW), and 127 keeps clear of that: 2 * 127 * 127 < 2^15.
  static int activation_levels();
  /// Channels per block of the layout that is best for fp32: 16 with AVX-512, else 8.
  static int preferred_block();
  /// False on processors where it has only reference kernels: 64-bit ARM without SVE.
  static bool has_fast_kernels();
  /// oneDNN's version and instruction set, e.g. "oneDNN 2.6.3, AVX2".
  static std::string description();

 private:
  friend class DnnlConvolution;
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// How a convolution treats its border and its numbers. Real numbers are scale * level in u8 tensors; the
/// weights of u8 sources are quantised here, symmetrically and by output channel.
struct ConvolutionOptions {
  int padding_before = 0;  ///< rows above and columns left of the source that count as zero
  int padding_after = 0;   ///< rows below and columns to the right
  bool relu = true;
  float source_scale = 1;   ///< of a u8 source
  float target_scale = 1;   ///< of a u8 target
  int weight_levels = 127;  ///< weights of a u8 source become -levels..levels
};

/// A convolution with bias and ReLU by oneDNN, made once for fixed places in memory. The layouts are those of
/// the views where oneDNN has a fast kernel for them, else its own choice with reorders before and after.
class DnnlConvolution {
 public:
  /// Null if oneDNN has only a reference kernel for it. `engine` must outlive the convolution.
  static std::unique_ptr<DnnlConvolution> make(DnnlEngine& engine, const ConvolutionWeights& layer,
                                               const TensorView& source, const TensorView& target,
                                               const ConvolutionOptions& options);
  ~DnnlConvolution();
  DnnlConvolution(DnnlConvolution&&) noexcept;

  /// Reads the source, writes the target. Allocates nothing.
  void run();
  /// oneDNN's name of the kernel, e.g. "jit:avx2"; with "+reorder" where the layouts had to be changed.
  const std::string& kernel() const { return kernel_; }

 private:
  struct Implementation;
  DnnlConvolution();
  std::unique_ptr<Implementation> implementation_;
  std::string kernel_;
};

}  // namespace stdc
