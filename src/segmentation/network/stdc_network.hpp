#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

#include "segmentation/network/network_weights.hpp"

namespace stdc {

/// How the network computes.
enum class NetworkPrecision {
  automatic,  ///< int8 if the weights are calibrated for it: faster on all processors
  fp32,       ///< 32-bit floating point
  int8,       ///< 8-bit activations and weights
};

/// What the network says about each pixel of its output, an eighth of the input's size.
struct Logits {
  std::span<const float> planes;  ///< [class][y][x]
  int classes = 0, height = 0, width = 0;
};

/// One step of the network, for reports.
struct NetworkStep {
  std::string name;    ///< layer, or what is done between layers
  std::string kernel;  ///< who does it, e.g. "jit:avx2"
  double multiplications = 0;
};

/// STDC1-Seg or STDC2-Seg on the CPU. Everything is made at load; running allocates nothing.
class StdcNetwork {
 public:
  /// @param input    size of the input [px], multiples of 32
  /// @param threads  of oneDNN; see InferenceThread
  /// Throws Error for a bad size, for int8 with weights that are not calibrated, and if a layer has no fast
  /// kernel on this processor. `weights` are not needed any more afterwards.
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
