#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "segmentation/network/kernels/class_map.hpp"
#include "segmentation/network/network_settings.hpp"
#include "segmentation/network/stdc_network.hpp"
#include "segmentation/segmenter.hpp"

namespace stdc {

/// What else is wanted of an image.
struct SegmentationRequest {
  bool classes = false, probability = false;
};

/// What there is to know about the pixels of an image, each of the image's size.
struct SegmentedPixels {
  cv::Mat mask;         ///< CV_8UC1, 255 = of a dynamic class, else 0
  cv::Mat classes;      ///< CV_8UC1, number of the class; empty if not asked for
  cv::Mat probability;  ///< CV_32FC1, 0..1 that it is of a dynamic class; empty if not asked for
};

/// Finds people and other dynamic classes with the STDC network.
class NetworkSegmenter : public Segmenter {
 public:
  /// Reads the weights and makes the network. Throws Error for a missing or wrong file, a size that is no
  /// multiple of 32, and what StdcNetwork refuses.
  NetworkSegmenter(const std::filesystem::path& weights, const NetworkSettings& settings);
  NetworkSegmenter(const NetworkWeights& weights, const NetworkSettings& settings);

  /// The colour image may have any size; it is resized to the network's.
  cv::Mat segment(const SegmenterInput& input) override;
  /// The same mask, and what else is asked for. Throws Error as segment() does, and for the class map of a
  /// network of more than 256 classes.
  SegmentedPixels segment_pixels(const SegmenterInput& input, const SegmentationRequest& request);

  /// In the order of their numbers.
  const std::vector<std::string>& classes() const { return classes_; }
  /// [class]
  const std::vector<bool>& dynamic_classes() const { return dynamic_classes_; }

  /// One line on what computes: architecture, precision, size, oneDNN's version and instruction set, and
  /// whether the weights lack a checksum.
  std::string description() const;
  StdcNetwork& network() { return network_; }

 private:
  /// The image as BGR in the network's size: the image itself or `resized_`.
  const cv::Mat& prepare(const cv::Mat& image);

  std::string architecture_;
  bool has_checksum_;
  std::vector<std::string> classes_;
  std::vector<bool> dynamic_classes_;
  ProbabilityCalibration probability_;
  StdcNetwork network_;
  cv::Mat resized_, colour_;
  std::optional<ClassMap> map_;
};

/// Of the weights that ship, those that are used if none are named.
inline constexpr const char* kDefaultWeights = "slim";

/// Where weights are that ship with the program: `models/stdc1-person-NAME.safetensors` in the folder named
/// by the environment variable STDC_SLAM_MODELS, in share/stdc-slam/ beside the program's folder, or in the
/// program's folder or one of the four above it (a source tree), or where this build would be installed. NAME
/// is the variant, "slim", "wide" or "permissive"; empty: kDefaultWeights. Throws Error naming all places if
/// there is none.
std::filesystem::path find_network_weights(const std::string& variant = {});

}  // namespace stdc
