#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/camera.hpp"
#include "features/description/patch_alignment.hpp"
#include "features/detection/pyramid.hpp"
#include "features/keypoint.hpp"

namespace stdc {

/// What makes a FrameFeatures, once the images are gone.
struct StoredFeatures {
  std::vector<Keypoint> keypoints;
  std::vector<Descriptor> descriptors;
  std::vector<Eigen::Vector2f> pixels;
  std::vector<float> depths;
  std::vector<Patch> patches;  ///< one for each keypoint, or none at all
  double scale_factor = 1.2;   ///< of the pyramid
  int levels = 1;
};

/// What a frame observed: its features in ideal (undistorted) pixels, with their depths, and an index by
/// position. Immutable once built, so that a keyframe can share it with the frame it was made of.
class FrameFeatures {
 public:
  /// @param features      of the image, in raw pixels
  /// @param depth         registered depth image (CV_16UC1 or CV_32FC1), or empty: all depths missing
  /// @param scale_factor  of the pyramid that the features come from
  /// @param levels        of that pyramid
  /// @param pyramid       to cut the keypoints' patches from; null: they have none
  FrameFeatures(const Camera& camera, Features features, const cv::Mat& depth, double scale_factor,
                int levels, const Pyramid* pyramid);
  /// The same again from what was stored of it; all lists have one length, patches may have none.
  FrameFeatures(const Camera& camera, StoredFeatures stored);

  int size() const { return static_cast<int>(keypoints_.size()); }
  /// In raw pixels, as extracted.
  const Keypoint& keypoint(int i) const { return keypoints_[i]; }
  const Descriptor& descriptor(int i) const { return descriptors_[i]; }
  /// Ideal pixel.
  const Eigen::Vector2f& pixel(int i) const { return pixels_[i]; }
  /// z in the camera frame [m]; 0: missing or not sure.
  float depth(int i) const { return depths_[i]; }
  /// Level-0 pixels per pixel of a pyramid level.
  float scale(int level) const { return scales_[level]; }
  float scale_of(int i) const { return scales_[keypoints_[i].level]; }
  int levels() const { return static_cast<int>(scales_.size()); }
  float log_scale_factor() const { return log_scale_factor_; }
  double scale_factor() const { return scale_factor_; }
  const std::vector<Keypoint>& keypoints() const { return keypoints_; }
  const std::vector<Descriptor>& descriptors() const { return descriptors_; }
  const std::vector<Eigen::Vector2f>& pixels() const { return pixels_; }
  const std::vector<float>& depths() const { return depths_; }
  const std::vector<Patch>& patches() const { return patches_; }
  /// The median of the depths; 1 if there is none.
  float usual_depth() const { return usual_depth_; }
  int count(KeypointQuality quality) const;
  /// The keypoint's surroundings on its level, or null.
  const Patch* patch(int i) const { return patches_.empty() ? nullptr : &patches_[i]; }
  /// The level on which something seen at this scale looks most similar.
  int nearest_level(float scale) const;

  /// Calls visit(i) for the keypoints within `radius` [px] of an ideal pixel along each axis (a square
  /// window) whose level lies in [min_level, max_level], in a fixed order.
  template <typename Visit>
  void for_each_in_window(float x, float y, float radius, int min_level, int max_level, Visit&& visit) const {
    const int x0 = cell(x - radius, columns_), x1 = cell(x + radius, columns_);
    const int y0 = cell(y - radius, rows_), y1 = cell(y + radius, rows_);
    for (int row = y0; row <= y1; ++row) {
      // Cells of a row lie one after the other: one run of indices per row.
      const std::uint32_t end = cell_start_[row * columns_ + x1 + 1];
      for (std::uint32_t k = cell_start_[row * columns_ + x0]; k < end; ++k) {
        const Indexed& entry = by_cell_[k];
        if (entry.level < min_level || entry.level > max_level) continue;
        if (std::abs(entry.x - x) <= radius && std::abs(entry.y - y) <= radius) {
          visit(static_cast<int>(entry.index));
        }
      }
    }
  }

 private:
  static constexpr float kCellSize = 16;  ///< [px]
  struct Indexed {
    float x, y;
    std::uint32_t index;
    std::int32_t level;
  };

  static int cell(float coordinate, int cells) {
    return std::clamp(static_cast<int>(coordinate * (1 / kCellSize)), 0, cells - 1);
  }
  void complete(const Camera& camera, int levels);
  void build_index(const Camera& camera);
  void cut_patches(const Pyramid& pyramid);

  std::vector<Keypoint> keypoints_;
  std::vector<Descriptor> descriptors_;
  std::vector<Eigen::Vector2f> pixels_;
  std::vector<float> depths_;
  float usual_depth_ = 1;
  double scale_factor_ = 1;
  std::vector<Patch> patches_;
  std::vector<float> scales_;
  float log_scale_factor_ = 0;
  int columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t>
      cell_start_;  ///< first entry of each cell in by_cell_, row by row; one more at the end
  std::vector<Indexed> by_cell_;
};

/// Depth [m] at a pixel of a registered depth image; 0 where missing, not finite or outside.
float depth_at(const cv::Mat& depth, double units_per_metre, int x, int y);

/// The same where the pixels around lie on one surface; 0 at the edges of things. There the depth image,
/// taken some milliseconds before or after the colour image and a pixel or more beside it, cannot tell which
/// of the two surfaces the corner belongs to.
/// @param max_step  of the depth over those pixels, as a share of it
float surface_depth_at(const cv::Mat& depth, double units_per_metre, int x, int y, float max_step);

}  // namespace stdc
