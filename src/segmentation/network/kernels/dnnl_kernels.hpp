#pragma once

#include <oneapi/dnnl/dnnl.hpp>
#include <optional>
#include <string>
#include <vector>

#include "segmentation/network/kernels/tensor.hpp"

namespace stdc {

// What differs between versions 2.6 and 3 of oneDNN, and how its layouts map to ours; for
// dnnl_convolution.cpp only.

/// What oneDNN needs to know of a convolution to choose a kernel.
struct DnnlRequest {
  dnnl::algorithm algorithm = dnnl::algorithm::convolution_direct;
  dnnl::memory::desc source, weights, bias, target;
  dnnl::memory::dims strides, padding_before, padding_after;
  bool relu = true;
  std::vector<float> scales;  ///< [output] real target levels per unit of the sums; empty: fp32
};

/// The view's layout, or a place for oneDNN's own choice.
dnnl::memory::desc dnnl_layout(const TensorView& view);
dnnl::memory::desc dnnl_any_layout(const TensorView& view);
/// True for the names of reference kernels.
bool is_dnnl_reference(const std::string& kernel);
/// Nothing if oneDNN has no kernel at all or only a reference kernel.
std::optional<dnnl::convolution_forward::primitive_desc> find_dnnl_kernel(const dnnl::engine& engine,
                                                                          const DnnlRequest& request);
/// The factor by which oneDNN multiplies the bias together with the sums. Version 3 adds the bias after that.
float dnnl_bias_unit(float scale, float target_scale);

}  // namespace stdc
