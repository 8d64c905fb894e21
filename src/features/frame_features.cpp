#include "features/frame_features.hpp"

namespace stdc {

float depth_at(const cv::Mat& depth, double units_per_metre, int x, int y) {
  if (x < 0 || y < 0 || x >= depth.cols || y >= depth.rows) return 0;
  const float z = depth.type() == CV_32FC1
                      ? depth.at<float>(y, x)
                      : static_cast<float>(depth.at<std::uint16_t>(y, x) / units_per_metre);
  return std::isfinite(z) && z > 0 ? z : 0;
}

float surface_depth_at(const cv::Mat& depth, double units_per_metre, int x, int y, float max_step) {
  constexpr int kRadius = 3;
  const float z = depth_at(depth, units_per_metre, x, y);
  if (z <= 0) return 0;
  float nearest = z, furthest = z;
  for (int dy = -kRadius; dy <= kRadius; ++dy) {
    for (int dx = -kRadius; dx <= kRadius; ++dx) {
      const float beside = depth_at(depth, units_per_metre, x + dx, y + dy);
      if (beside <= 0) continue;
      nearest = std::min(nearest, beside);
      furthest = std::max(furthest, beside);
    }
  }
  return furthest - nearest <= max_step * z ? z : 0;
}

namespace {

/// In a wide or small image a pixel spans a larger angle, and a slanted surface falls off faster.
float max_step_of(const Camera& camera) {
  constexpr float kMaxStep = 0.03F;  // of the depth, over the window: a surface seen at 60 degrees has less
  constexpr double kStepTimesFocal = 12;  // [px], of a surface seen at 60 degrees over the window
  return std::max(kMaxStep, static_cast<float>(kStepTimesFocal / std::min(camera.fx, camera.fy)));
}

float median_of_positive(std::vector<float> values, float otherwise) {
  std::erase_if(values, [](float value) { return value <= 0; });
  if (values.empty()) return otherwise;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Drops the keypoints that a wide fisheye sees beside or behind the camera: they have no ideal pixel.
Features with_ideal_pixels(const Camera& camera, Features features) {
  if (camera.lens != LensModel::equidistant) return features;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < features.keypoints.size(); ++i) {
    if (!camera.has_ideal({features.keypoints[i].x, features.keypoints[i].y})) continue;
    features.keypoints[kept] = features.keypoints[i];
    features.descriptors[kept++] = features.descriptors[i];
  }
  features.keypoints.resize(kept);
  features.descriptors.resize(kept);
  return features;
}

}  // namespace

FrameFeatures::FrameFeatures(const Camera& camera, Features features, const cv::Mat& depth,
                             double scale_factor, int levels, const Pyramid* pyramid)
    : scale_factor_(scale_factor) {
  features = with_ideal_pixels(camera, std::move(features));
  keypoints_ = std::move(features.keypoints);
  descriptors_ = std::move(features.descriptors);
  const std::size_t count = keypoints_.size();
  pixels_.reserve(count);
  depths_.reserve(count);
  const float max_step = max_step_of(camera);
  for (const Keypoint& keypoint : keypoints_) {
    pixels_.push_back(camera.undistort({keypoint.x, keypoint.y}).cast<float>());
    depths_.push_back(surface_depth_at(depth, camera.depth_units_per_metre,
                                       static_cast<int>(std::lround(keypoint.x)),
                                       static_cast<int>(std::lround(keypoint.y)), max_step));
  }
  complete(camera, levels);
  if (pyramid != nullptr) cut_patches(*pyramid);
}

FrameFeatures::FrameFeatures(const Camera& camera, StoredFeatures stored)
    : keypoints_(std::move(stored.keypoints)),
      descriptors_(std::move(stored.descriptors)),
      pixels_(std::move(stored.pixels)),
      depths_(std::move(stored.depths)),
      scale_factor_(stored.scale_factor),
      patches_(std::move(stored.patches)) {
  complete(camera, stored.levels);
}

/// Computes what follows from the rest.
void FrameFeatures::complete(const Camera& camera, int levels) {
  log_scale_factor_ = static_cast<float>(std::log(scale_factor_));
  for (int level = 0; level < levels; ++level) {
    scales_.push_back(static_cast<float>(std::pow(scale_factor_, level)));
  }
  usual_depth_ = median_of_positive(depths_, 1);
  build_index(camera);
}

void FrameFeatures::cut_patches(const Pyramid& pyramid) {
  patches_.reserve(keypoints_.size());
  for (const Keypoint& keypoint : keypoints_) {
    const float scale = scales_[keypoint.level];
    patches_.push_back(cut_patch(pyramid.level(keypoint.level).view(),
                                 static_cast<int>(std::lround(image_to_level(keypoint.x, scale))),
                                 static_cast<int>(std::lround(image_to_level(keypoint.y, scale)))));
  }
}

int FrameFeatures::nearest_level(float scale) const {
  return std::clamp(static_cast<int>(std::lround(std::log(scale) / log_scale_factor_)), 0, levels() - 1);
}

int FrameFeatures::count(KeypointQuality quality) const {
  return static_cast<int>(std::count_if(keypoints_.begin(), keypoints_.end(),
                                        [&](const Keypoint& k) { return k.quality == quality; }));
}

void FrameFeatures::build_index(const Camera& camera) {
  columns_ = static_cast<int>(std::ceil(static_cast<float>(camera.width) / kCellSize));
  rows_ = static_cast<int>(std::ceil(static_cast<float>(camera.height) / kCellSize));
  cell_start_.assign(columns_ * rows_ + 1, 0);
  // Counting sort by cell; ideal pixels outside the image go to the nearest cell.
  const auto cell_of = [&](std::size_t i) {
    return cell(pixels_[i].y(), rows_) * columns_ + cell(pixels_[i].x(), columns_);
  };
  for (std::size_t i = 0; i < pixels_.size(); ++i) ++cell_start_[cell_of(i) + 1];
  for (std::size_t c = 1; c < cell_start_.size(); ++c) cell_start_[c] += cell_start_[c - 1];
  std::vector<std::uint32_t> next(cell_start_.begin(), cell_start_.end() - 1);
  by_cell_.resize(pixels_.size());
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    by_cell_[next[cell_of(i)]++] = {pixels_[i].x(), pixels_[i].y(), static_cast<std::uint32_t>(i),
                                    keypoints_[i].level};
  }
}

}  // namespace stdc
