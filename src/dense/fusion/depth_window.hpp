#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "core/pose.hpp"
#include "dense/fusion/depth_cleaning.hpp"
#include "dense/fusion/pinhole.hpp"

namespace stdc {

/// Depth that several frames agree on, in the camera of the first.
struct FusedDepth {
  /// Frames that agree, in the low bits of `support`.
  static constexpr std::uint8_t kCount = 0x7F;
  /// The first frame itself has seen the surface there: what lies before it is free.
  static constexpr std::uint8_t kDirect = 0x80;
  /// Something moves there in the first frame: what lies before it is free, and so is where it stands.
  static constexpr std::uint8_t kMoving = 0x80;  ///< that is: direct, and no frame to support it

  cv::Mat depth;    ///< CV_32FC1 [m], 0: nothing
  cv::Mat support;  ///< CV_8UC1, see above
};

/// Fuses the depths of frames that follow each other into one image, so that a dense map needs to take in,
/// keep and move a tenth of the images, and each with less noise (keyframe fusion: Maier, Schaefer and
/// Cremers, 'Efficient Online Surface Correction for Real-time Large-Scale 3D Reconstruction', BMVC 2017).
///
/// Each pixel has a depth and a number of frames that support it. A frame that sees the surface where it
/// should be adds to both; one that sees through it, or finds that it moves, takes away, so that what left,
/// or what a mask missed for a moment, goes again; one that sees something nearer says nothing. Pixels that
/// have none take a depth from wherever a later frame's pixels fall.
class DepthWindow {
 public:
  /// @param depth  of the first frame
  DepthWindow(const Pinhole& pinhole, const CleanDepth& depth);

  /// @param depth  of a further frame
  void add(const CleanDepth& depth, const Pose& frame_from_window);
  int frames() const { return frames_; }
  const FusedDepth& fused() const { return fused_; }

 private:
  void update(const CleanDepth& depth, const Pose& frame_from_window);
  void fill(const cv::Mat& depth, const Pose& window_from_frame);

  Pinhole pinhole_;
  FusedDepth fused_;
  cv::Mat fresh_;  ///< CV_8UC1: pixels filled by the present frame
  int frames_ = 1;
};

}  // namespace stdc
