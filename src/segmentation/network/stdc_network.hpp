#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

#include "segmentation/network/logits.hpp"
#include "segmentation/network/network_precision.hpp"
#include "segmentation/network/network_step.hpp"
#include "segmentation/network/network_weights.hpp"

namespace stdc {

/// STDC1-Seg or STDC2-Seg on the CPU. All memory is allocated at load; running allocates nothing.
class StdcNetwork {
 public:
  /// @param input    size of the input [px], multiples of 32
  /// @param threads  of oneDNN; see ThreadStateGuard
  /// Throws Error for a bad size, for int8 with weights that are not calibrated, and if a layer has no fast
  /// kernel on this processor. `weights` may be freed afterwards.
  StdcNetwork(const NetworkWeights& weights, cv::Size input, NetworkPrecision precision, int threads = 1);
  ~StdcNetwork();
  StdcNetwork(const StdcNetwork&) = delete;
  StdcNetwork& operator=(const StdcNetwork&) = delete;

  cv::Size input_size() const;
  /// fp32 or int8.
  NetworkPrecision precision() const;
  /// Runs on a BGR image (CV_8UC3) of the input's size. The same image gives the same bytes. The result is
  /// valid until the next run.
  Logits run(const cv::Mat& bgr);
  /// Runs on a normalised image, [3][height][width] in RGB order. Only fp32.
  Logits run(std::span<const float> normalised);

  const std::vector<NetworkStep>& steps() const;
  /// Runs again on the last input; thread CPU milliseconds of each step.
  std::vector<double> profile();
  /// Bytes of all activations.
  std::size_t activation_bytes() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace stdc
