#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <opencv2/core/types.hpp>
#include <vector>

#include "segmentation/segmenter.hpp"

namespace stdc {

/// What an ONNX file does not say about its model. Defaults: torchvision's models trained on VOC's classes.
struct OnnxModel {
  cv::Size input_size{512, 384};                    ///< [px]
  std::array<double, 3> mean{0.485, 0.456, 0.406};  ///< of RGB in 0..1
  std::array<double, 3> deviation{0.229, 0.224, 0.225};
  std::vector<int> dynamic_classes{15};  ///< channels of the output; 15: person
};

/// Reads the JSON file beside a model ("net.onnx": "net.json"), if there is one; all entries are optional:
///
///     {"input_width": 512, "input_height": 384, "mean": [0, 0, 0], "std": [1, 1, 1], "dynamic_classes":
///     [15]}
///
/// Throws Error naming the file and the entry.
OnnxModel read_onnx_description(const std::filesystem::path& model);

/// Finds dynamic pixels with any ONNX model for semantic segmentation, by OpenCV's dnn module. The model
/// takes one normalised RGB image [1, 3, height, width] and gives class logits [1, classes, h, w] of any
/// size, or the class of each pixel [1, h, w].
class OnnxSegmenter : public Segmenter {
 public:
  /// Throws Error for a missing or damaged file, and if the program was built without OpenCV's dnn module.
  OnnxSegmenter(const std::filesystem::path& file, const OnnxModel& model);
  ~OnnxSegmenter() override;

  /// Throws Error if the model's output is of another kind or has fewer classes than its description.
  cv::Mat segment(const SegmenterInput& input) override;
  /// True if the program was built with OpenCV's dnn module (CMake option STDC_ONNX).
  static bool available();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace stdc
