#pragma once

#include <opencv2/core/mat.hpp>

#include "features/extractor.hpp"
#include "run/frame_observer.hpp"
#include "run/output_folder.hpp"
#include "slam/slam.hpp"

namespace stdc::app {

/// Draws keypoints over the image in grey, twice its size: the colour says inlier, outlier or unmatched, a
/// filled disc is of high quality and a ring of low quality. What is dynamic is tinted.
cv::Mat draw_keypoints(const cv::Mat& colour, int frame, const TrackingResult& result);
/// Draws the quadtree cells of one level with the keypoints that were chosen from them.
cv::Mat draw_cells(const cv::Mat& colour, const cv::Mat& dynamic_mask, int frame,
                   const FeatureSettings& settings);

/// The pictures of --debug-images, all written at the end like other results.
class DebugImages : public FrameObserver {
 public:
  /// @param every  draws every n-th frame, and the lost ones
  DebugImages(const std::filesystem::path& folder, int every, const FeatureSettings& settings);
  /// The result must have its keypoints; a frame without an image is passed over.
  void on_frame(const ObservedFrame& frame) override;
  void commit();

 private:
  OutputFolder folder_;
  int every_;
  FeatureSettings settings_;
};

}  // namespace stdc::app
