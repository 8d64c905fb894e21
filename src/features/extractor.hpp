#pragma once

#include <memory>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "features/feature_settings.hpp"
#include "features/keypoint.hpp"

namespace stdc {

class Pyramid;

/// The quadtree node that a keypoint was chosen from; for pictures. Edges in raw pixels of the full-size
/// image.
struct SelectionCell {
  int level = 0;
  float left = 0, top = 0, right = 0, bottom = 0;
};

/// Extracts ORB features from one image: pyramid, FAST candidates, quadtree, orientation, steered BRIEF.
///
///     FeatureExtractor extractor({.keypoints = 1000});
///     Features features = extractor.extract(grey);
///
/// The steps can also be called apart: `detect` needs the image only and may run beside segmentation,
/// `reject` drops what lies on dynamic pixels, and `select` spends the whole budget on the static candidates.
/// An extractor keeps its buffers between images; use one per thread. Same image, same bytes.
class FeatureExtractor {
 public:
  /// Throws Error if the settings are invalid.
  explicit FeatureExtractor(const FeatureSettings& settings = {});
  ~FeatureExtractor();
  FeatureExtractor(FeatureExtractor&&) noexcept;
  FeatureExtractor& operator=(FeatureExtractor&&) noexcept;

  /// `grey`: CV_8UC1, any size of at least 64 x 64. Equal to detect() and then select().
  Features extract(const cv::Mat& grey);
  /// Builds the pyramid and finds the candidates (Alg. 2). `grey` is copied.
  void detect(const cv::Mat& grey);
  /// Drops the candidates on or within 4 pixels of their level of pixels where `dynamic_mask` (CV_8UC1, size
  /// of the image; empty: none) is not zero.
  void reject(const cv::Mat& dynamic_mask);
  /// Selects among the candidates that are left (Alg. 3), orients and describes. To be called once after
  /// detect().
  Features select();

  int levels(cv::Size image_size) const;
  /// Scale of a level: level-0 pixels per pixel of that level, scale_factor^level.
  float scale(int level) const;
  const FeatureSettings& settings() const;
  /// The pyramid of the last image. It stays as it is as long as somebody holds it.
  std::shared_ptr<const Pyramid> pyramid() const;
  /// The quadtree cells of the keypoints that the last select() gave, in their order.
  const std::vector<SelectionCell>& cells() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace stdc
