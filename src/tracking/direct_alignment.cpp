#include "tracking/direct_alignment.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "features/frame_features.hpp"

namespace stdc {

namespace {

using Vector8d = Eigen::Matrix<double, 8, 1>;  // twist, gain, offset
using Matrix8d = Eigen::Matrix<double, 8, 8>;

constexpr int kStep = 8;         // [px] between the points of the grid
constexpr float kFinest = 1.4F;  // scale of the finest image, at least: exact enough for what is blurred
constexpr int kHalvings = 2;     // of that image: the coarsest has about 110 columns
constexpr int kMinPoints = 300;  // that are seen in both images
constexpr int kIterations = 20;
constexpr double kDegrees = 5;       // of freedom of the t-distribution (Kerl et al.)
constexpr double kMinSigma = 2;      // [grey levels]
constexpr double kMaxSigma = 14;     // [grey levels] where both images show the same
constexpr double kConverged = 1e-4;  // [m, rad]
constexpr double kCorrelated = 100;  // residuals of neighbours that say one thing
constexpr double kMinAgreement = 0.6;

/// Both images at one size.
struct Stage {
  cv::Mat last, frame;
  float level_scale = 1;
  int halvings = 0;

  /// Pixel of a pixel of the full image; pyrDown puts pixel 2x of an image to x.
  Eigen::Vector2d pixel(const Eigen::Vector2d& raw) const {
    return ((raw.array() + 0.5) / level_scale - 0.5) / (1 << halvings);
  }
  double scale() const { return static_cast<double>(level_scale) * (1 << halvings); }
};

/// A point of the last frame.
struct Point {
  Eigen::Vector3d position;  ///< in its camera frame
  double brightness = 0;
  Vector8d jacobian;  ///< of its brightness: by twist, gain, offset
};

struct Residuals {
  std::vector<int> point;
  std::vector<double> value;  ///< brightness now less that in the last frame
};

bool inside(const cv::Mat& image, const Eigen::Vector2d& pixel, double border) {
  return pixel.x() >= border && pixel.y() >= border && pixel.x() < image.cols - 1 - border &&
         pixel.y() < image.rows - 1 - border;
}

double brightness_at(const cv::Mat& image, const Eigen::Vector2d& pixel) {
  const int x = static_cast<int>(pixel.x()), y = static_cast<int>(pixel.y());
  const double u = pixel.x() - x, v = pixel.y() - y;
  const std::uint8_t* upper = image.ptr<std::uint8_t>(y) + x;
  const std::uint8_t* lower = image.ptr<std::uint8_t>(y + 1) + x;
  return (1 - v) * ((1 - u) * upper[0] + u * upper[1]) + v * ((1 - u) * lower[0] + u * lower[1]);
}

cv::Mat copy_of(const PaddedImage& image) {
  cv::Mat copy(image.height(), image.width(), CV_8UC1);
  for (int y = 0; y < copy.rows; ++y) std::copy_n(image.row(y), copy.cols, copy.ptr<std::uint8_t>(y));
  return copy;
}

/// From coarse to fine.
std::vector<Stage> stages_of(const Pyramid& last, const Pyramid& frame) {
  int level = 0;
  const auto scale = [&](int i) {
    return static_cast<float>(last.sizes()[0].width) /
           static_cast<float>(last.sizes()[static_cast<std::size_t>(i)].width);
  };
  while (level + 1 < last.levels() && scale(level) < kFinest) ++level;
  std::vector<Stage> stages{{copy_of(last.level(level)), copy_of(frame.level(level)), scale(level), 0}};
  for (int i = 1; i <= kHalvings; ++i) {
    Stage halved{{}, {}, scale(level), i};
    cv::pyrDown(stages.front().last, halved.last);
    cv::pyrDown(stages.front().frame, halved.frame);
    stages.insert(stages.begin(), halved);
  }
  return stages;
}

/// Derivative of a point's ideal pixel by a left perturbation of its frame. The bend of the lens is left out:
/// it changes the way to the minimum, not the minimum.
Eigen::Matrix<double, 2, 6> pixel_by_twist(const Camera& camera, const Eigen::Vector3d& p) {
  Eigen::Matrix<double, 2, 3> by_point;
  by_point << camera.fx / p.z(), 0, -camera.fx * p.x() / (p.z() * p.z()), 0, camera.fy / p.z(),
      -camera.fy * p.y() / (p.z() * p.z());
  Eigen::Matrix<double, 2, 6> by_twist;
  by_twist << by_point, -by_point * skew(p);
  return by_twist;
}

/// The centre of a cell of the grid.
Eigen::Vector2d centre_of(int index, int columns) {
  return {index % columns * kStep + kStep / 2, index / columns * kStep + kStep / 2};
}

std::vector<Point> points_of(const Camera& camera, const Stage& stage,
                             const std::vector<Eigen::Vector3d>& rays, int columns,
                             const std::vector<float>& depths) {
  const Eigen::Vector2d x(1, 0), y(0, 1);
  std::vector<Point> points;
  for (int i = 0; i < static_cast<int>(rays.size()); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const Eigen::Vector2d pixel = stage.pixel(centre_of(i, columns));
    if (depths[at] <= 0 || rays[at].z() == 0 || !inside(stage.last, pixel, 1)) continue;
    Point point;
    point.position = rays[at] * static_cast<double>(depths[at]);
    point.brightness = brightness_at(stage.last, pixel);
    const Eigen::RowVector2d gradient(
        0.5 * (brightness_at(stage.last, pixel + x) - brightness_at(stage.last, pixel - x)),
        0.5 * (brightness_at(stage.last, pixel + y) - brightness_at(stage.last, pixel - y)));
    point.jacobian << (gradient / stage.scale() * pixel_by_twist(camera, point.position)).transpose(),
        point.brightness - 128, 1;
    points.push_back(point);
  }
  return points;
}

Eigen::Vector2d raw_pixel(const Camera& camera, const Eigen::Vector3d& point) {
  const Eigen::Vector2d ideal = camera.project(point);
  return camera.has_distortion() ? camera.distort(ideal) : ideal;
}

Residuals residuals_of(const Camera& camera, const Stage& stage, const std::vector<Point>& points,
                       const Pose& frame_from_last) {
  Residuals residuals;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p = frame_from_last * points[i].position;
    if (p.z() <= 0.05) continue;
    const Eigen::Vector2d pixel = stage.pixel(raw_pixel(camera, p));
    if (!inside(stage.frame, pixel, 0)) continue;
    residuals.point.push_back(static_cast<int>(i));
    residuals.value.push_back(brightness_at(stage.frame, pixel) - points[i].brightness);
  }
  return residuals;
}

/// Robust: 1.4826 times the median of the absolute values.
double sigma_of(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return std::max(1.4826 * *middle, kMinSigma);
}

/// Alignment at one size.
struct Aligned {
  bool usable = false;
  double sigma = 0;  ///< of the brightness left over [grey levels]
  Matrix6d information = Matrix6d::Zero();
};

Aligned align_stage(const Camera& camera, const Stage& stage, const std::vector<Point>& points, Pose& pose) {
  Aligned aligned;
  Eigen::Vector2d light = Eigen::Vector2d::Zero();  // gain and offset that the last step found
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Residuals residuals = residuals_of(camera, stage, points, pose);
    if (static_cast<int>(residuals.value.size()) < kMinPoints) return {};
    std::vector<double> left = residuals.value;
    for (std::size_t k = 0; k < left.size(); ++k) {
      left[k] -= points[static_cast<std::size_t>(residuals.point[k])].jacobian.tail<2>().dot(light);
    }
    aligned.sigma = sigma_of(left);
    Matrix8d normal = Matrix8d::Zero();
    Vector8d right = Vector8d::Zero();
    for (std::size_t k = 0; k < left.size(); ++k) {
      const double r = left[k] / aligned.sigma;
      const double weight = (kDegrees + 1) / (kDegrees + r * r);
      const Vector8d& jacobian = points[static_cast<std::size_t>(residuals.point[k])].jacobian;
      normal.noalias() += weight * jacobian * jacobian.transpose();
      right.noalias() += weight * residuals.value[k] * jacobian;
    }
    const Eigen::LLT<Matrix8d> factor(normal);
    if (factor.info() != Eigen::Success) return {};
    const Vector8d step = factor.solve(right);
    if (!step.allFinite()) return {};
    light = step.tail<2>();
    // The step moves the last frame's image; undone in front, it moves the frame (Baker and Matthews,
    // sec. 3.2).
    pose = pose * Pose::exp(step.head<6>()).inverse();
    aligned.information = normal.topLeftCorner<6, 6>() / (aligned.sigma * aligned.sigma * kCorrelated);
    aligned.usable = true;
    if (step.head<6>().norm() < kConverged) break;
  }
  return aligned;
}

}  // namespace

DirectAligner::DirectAligner(const Camera& camera)
    : camera_(camera), columns_(camera.width / kStep), rows_(camera.height / kStep) {
  rays_.reserve(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const Eigen::Vector2d raw(column * kStep + kStep / 2, row * kStep + kStep / 2);
      rays_.push_back(camera.has_ideal(raw) ? camera.unproject(camera.undistort(raw), 1)
                                            : Eigen::Vector3d::Zero());
    }
  }
}

std::vector<float> DirectAligner::sample(const cv::Mat& depth) const {
  std::vector<float> depths;
  if (depth.empty()) return depths;
  depths.reserve(rays_.size());
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const float z =
          depth_at(depth, camera_.depth_units_per_metre, column * kStep + kStep / 2, row * kStep + kStep / 2);
      depths.push_back(z > 0 ? z : 0);
    }
  }
  return depths;
}

void DirectAligner::forget(const cv::Mat& mask, std::vector<float>& depths) const {
  if (mask.empty() || depths.empty()) return;
  for (int row = 0; row < rows_; ++row) {
    const auto* line = mask.ptr<std::uint8_t>(row * kStep + kStep / 2) + kStep / 2;
    for (int column = 0; column < columns_; ++column) {
      if (line[column * kStep] != 0) depths[static_cast<std::size_t>(row * columns_ + column)] = 0;
    }
  }
}

std::optional<DirectAlignment> DirectAligner::align(const DirectView& last, const DirectView& frame,
                                                    const Pose& initial) const {
  if (!last.pyramid || !frame.pyramid || last.depths.size() != rays_.size()) return {};
  DirectAlignment result;
  result.frame_from_last = initial;
  Aligned aligned;
  for (const Stage& stage : stages_of(*last.pyramid, *frame.pyramid)) {
    const std::vector<Point> points = points_of(camera_, stage, rays_, columns_, last.depths);
    aligned = align_stage(camera_, stage, points, result.frame_from_last);
    if (!aligned.usable) return {};
  }
  if (aligned.sigma > kMaxSigma) return {};
  result.information = aligned.information;
  result.depth_agreement = agreement(last, frame, result.frame_from_last);
  if (result.depth_agreement < kMinAgreement) return {};
  return result;
}

/// Of the points that both frames have a depth for.
double DirectAligner::agreement(const DirectView& last, const DirectView& frame,
                                const Pose& frame_from_last) const {
  if (frame.depths.size() != rays_.size()) return 0;
  int compared = 0, agreeing = 0;
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    if (last.depths[i] <= 0 || rays_[i].z() == 0) continue;
    const Eigen::Vector3d p = frame_from_last * (rays_[i] * static_cast<double>(last.depths[i]));
    if (p.z() <= 0.05) continue;
    const Eigen::Vector2d raw = raw_pixel(camera_, p);
    const int column = static_cast<int>(std::floor(raw.x() / kStep)),
              row = static_cast<int>(std::floor(raw.y() / kStep));
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_) continue;
    const double seen = static_cast<double>(frame.depths[static_cast<std::size_t>(row * columns_ + column)]);
    if (seen <= 0) continue;
    ++compared;
    // A cell of the grid is half a step off at most: a wall seen askew has another depth there.
    if (std::abs(seen - p.z()) < 0.03 + 0.04 * p.z()) ++agreeing;
  }
  return compared >= kMinPoints ? static_cast<double>(agreeing) / compared : 0;
}

}  // namespace stdc
