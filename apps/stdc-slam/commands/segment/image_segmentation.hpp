#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands/segment/segment_images.hpp"
#include "commands/segment/truth_masks.hpp"
#include "core/camera.hpp"
#include "report/segment_report.hpp"
#include "run/output_folder.hpp"
#include "segmentation/network/network_segmenter.hpp"

namespace stdc::app {

/// Segments images one by one and writes what is found.
class ImageSegmentation {
 public:
  /// @param camera        whose `rotation` says which way up the images are, in place of EXIF
  /// @param is_of_images  the camera must have their size
  ImageSegmentation(Segmenter& segmenter, const SegmentationRequest& wanted,
                    const std::optional<Camera>& camera, bool is_of_images, bool overlays,
                    OutputFolder& output);

  /// Segments one image, writes the results and tells about it.
  SegmentedImage segment(const SegmentImage& image, int frame, std::optional<TruthMasks>& truths);
  /// Names of the dynamic classes if there are several.
  const std::vector<std::string>& shared_classes() const { return shared_classes_; }

 private:
  Orientation orientation_of(const StoredImage& stored, const SegmentImage& image) const;
  SegmentedPixels segment_pixels(const SegmenterInput& input);
  void write(const std::string& name, const SegmentedPixels& upright, Orientation orientation);
  void write_overlay(const std::string& name, const cv::Mat& image, const SegmentedPixels& pixels);
  std::vector<double> class_shares(const cv::Mat& classes) const;

  Segmenter& segmenter_;
  NetworkSegmenter* network_;  ///< the same; null for an ONNX model
  SegmentationRequest wanted_;
  std::vector<std::string> shared_classes_;
  std::optional<Camera> camera_;
  bool is_of_images_, overlays_;
  OutputFolder& output_;
};

}  // namespace stdc::app
