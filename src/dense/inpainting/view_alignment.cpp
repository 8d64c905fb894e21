#include "dense/inpainting/view_alignment.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "dense/sampling.hpp"

namespace stdc {
namespace {

constexpr int kBorder = 4;          ///< [px]
constexpr int kCell = 12;           ///< [px] one pixel of each such square
constexpr int kMinGradient = 8;     ///< [grey levels / 2 px]
constexpr int kMinPixels = 60;      ///< to align by
constexpr float kHuber = 10;        ///< [grey levels]
constexpr double kMaxShift = 0.08;  ///< [m] and
constexpr double kMaxTurn = 0.04;   ///< [rad] between the known pose and the corrected one

/// Of brightness over two pixels each way, squared.
int squared_gradient(const cv::Mat& grey, int x, int y) {
  const int dx = grey.at<std::uint8_t>(y, x + 1) - grey.at<std::uint8_t>(y, x - 1);
  const int dy = grey.at<std::uint8_t>(y + 1, x) - grey.at<std::uint8_t>(y - 1, x);
  return dx * dx + dy * dy;
}

/// Adds nine pixels around one to the sums of the channels. @return whether one of them is saturated
bool add_window(const cv::Mat& image, cv::Point at, double* sums) {
  const int channels = image.channels();
  bool saturated = false;
  for (int dy = -2; dy <= 2; dy += 2) {
    for (int dx = -2; dx <= 2; dx += 2) {
      const std::uint8_t* pixel = image.ptr<std::uint8_t>(at.y + dy) + (at.x + dx) * channels;
      for (int c = 0; c < channels; ++c) {
        saturated = saturated || pixel[c] >= 250;
        sums[c] += pixel[c];
      }
    }
  }
  return saturated;
}

}  // namespace

AlignmentTarget::AlignmentTarget(const BackgroundView& frame, const RayTable& rays)
    : frame_(frame), rays_(rays) {
  for (int top = kBorder; top + kCell + kBorder <= frame.grey.rows; top += kCell) {
    for (int left = kBorder; left + kCell + kBorder <= frame.grey.cols; left += kCell) {
      int max_strength = kMinGradient * kMinGradient;
      cv::Point best(-1, -1);
      for (int y = top; y < top + kCell; ++y) {
        for (int x = left; x < left + kCell; ++x) {
          if (frame.seen_at(x, y) != Seen::surface) continue;
          const int strength = squared_gradient(frame.grey, x, y);
          if (strength <= max_strength) continue;
          max_strength = strength;
          best = {x, y};
        }
      }
      if (best.x >= 0) add(best);
    }
  }
}

void AlignmentTarget::add(cv::Point at) {
  Pixel pixel;
  pixel.x = at.x, pixel.y = at.y;
  pixel.point = rays_.point(at.x, at.y, frame_.depth.at<float>(at));
  const float z = pixel.point.z();
  const float fx = static_cast<float>(rays_.camera().fx) / z, fy = static_cast<float>(rays_.camera().fy) / z;
  Eigen::Matrix<float, 2, 3> projection;  // of the ideal lens: near enough for a gradient
  projection << fx, 0, -fx * pixel.point.x() / z, 0, fy, -fy * pixel.point.y() / z;
  Eigen::Matrix<float, 3, 6> motion;
  motion << Eigen::Matrix3f::Identity(), -skew(pixel.point.cast<double>()).cast<float>();
  for (const int level : {0, 1}) {
    const cv::Mat& image = level == 0 ? frame_.grey : frame_.half_grey;
    const float scale = level == 0 ? 1 : 0.5F;
    const float u = static_cast<float>(at.x) * scale, v = static_cast<float>(at.y) * scale;
    pixel.value[level] = sample_grey(image, u, v);
    const Eigen::RowVector2f slope((sample_grey(image, u + 1, v) - sample_grey(image, u - 1, v)) / 2,
                                   (sample_grey(image, u, v + 1) - sample_grey(image, u, v - 1)) / 2);
    const Eigen::Matrix<float, 1, 6> row = slope * scale * projection * motion;
    pixel.jacobian[level] = row.transpose();
  }
  pixels_.push_back(pixel);
}

std::optional<Eigen::Vector2f> AlignmentTarget::find(const Eigen::Vector3f& point,
                                                     const BackgroundView& view) const {
  if (point.z() < 0.05F) return std::nullopt;
  const Eigen::Vector2f at = rays_.project(point);
  if (!inside(at, view.grey.size(), 3)) return std::nullopt;
  const int x = static_cast<int>(at.x() + 0.5F), y = static_cast<int>(at.y() + 0.5F);
  if (view.seen_at(x, y) == Seen::nothing) return std::nullopt;
  const bool same_surface = std::abs(view.depth.at<float>(y, x) - point.z()) <= 0.05F * point.z();
  return same_surface ? std::optional(at) : std::nullopt;
}

AlignmentTarget::Fit AlignmentTarget::evaluate(const BackgroundView& view, const Pose& view_from_frame,
                                               int level, float gain, Eigen::Matrix<double, 6, 6>* hessian,
                                               Eigen::Matrix<double, 6, 1>* gradient) const {
  const Eigen::Matrix3f rotation = view_from_frame.rotation_matrix().cast<float>();
  const Eigen::Vector3f translation = view_from_frame.translation.cast<float>();
  const cv::Mat& image = level == 0 ? view.grey : view.half_grey;
  const float scale = level == 0 ? 1 : 0.5F;
  Fit fit;
  double sum_frame = 0, sum_view = 0;
  if (hessian != nullptr) hessian->setZero(), gradient->setZero();
  for (const Pixel& pixel : pixels_) {
    const std::optional<Eigen::Vector2f> seen = find(rotation * pixel.point + translation, view);
    if (!seen) continue;
    const Eigen::Vector2f at = *seen;
    const float value = sample_grey(image, at.x() * scale, at.y() * scale);
    const float error = gain * value - pixel.value[level];
    const float size = std::abs(error), weight = size < kHuber ? 1 : kHuber / size;
    fit.cost += size < kHuber ? size : kHuber;
    ++fit.count;
    sum_frame += weight * pixel.value[level];
    sum_view += weight * value;
    if (hessian == nullptr) continue;
    const Eigen::Matrix<double, 6, 1> jacobian = pixel.jacobian[level].cast<double>();
    hessian->noalias() += static_cast<double>(weight) * jacobian * jacobian.transpose();
    *gradient += static_cast<double>(weight * error) * jacobian;
  }
  if (fit.count > 0) fit.cost /= fit.count;
  if (sum_view > 0) fit.gain = static_cast<float>(sum_frame / sum_view);
  return fit;
}

AlignmentTarget::Fit AlignmentTarget::judge(const BackgroundView& view, const Pose& view_from_frame,
                                            float gain) const {
  const Fit fit = evaluate(view, view_from_frame, 0, gain, nullptr, nullptr);
  return evaluate(view, view_from_frame, 0, fit.gain, nullptr, nullptr);
}

/// Gauss-Newton from the half size to the full one. `gain`: in and out.
Pose AlignmentTarget::refine(const BackgroundView& view, Pose view_from_frame, float& gain) const {
  constexpr int kIterations = 5;
  for (const int level : {1, 0}) {
    for (int i = 0; i < kIterations; ++i) {
      Eigen::Matrix<double, 6, 6> hessian;
      Eigen::Matrix<double, 6, 1> gradient;
      const Fit fit = evaluate(view, view_from_frame, level, gain, &hessian, &gradient);
      if (fit.count < kMinPixels) break;
      gain = std::clamp(fit.gain, 0.3F, 3.F);
      hessian.diagonal() *= 1.001;
      const Vector6d step = hessian.ldlt().solve(gradient);
      if (!step.allFinite()) break;
      // The error falls when the frame is moved by `step`; the view moves by its inverse.
      view_from_frame = view_from_frame * Pose::exp(-step);
      if (step.head<3>().norm() < 1e-4 && step.tail<3>().norm() < 5e-5) break;
    }
  }
  return view_from_frame;
}

AlignedView AlignmentTarget::align(const BackgroundView& view, bool align) const {
  AlignedView aligned;
  aligned.view = &view;
  const Pose known = view.at.world_from_cam.inverse() * frame_.at.world_from_cam;
  aligned.view_from_frame = known;
  const Fit before = judge(view, known, 1);
  aligned.residual = before.count >= kMinPixels ? before.cost : kHuber;
  if (align && before.count >= kMinPixels) {
    float gain = before.gain;
    const Pose refined = refine(view, known, gain);
    const Pose change = refined * known.inverse();
    const Fit after = judge(view, refined, gain);
    if (refined.is_finite() && change.translation.norm() < kMaxShift &&
        rotation_log(change.rotation).norm() < kMaxTurn && after.count >= before.count * 8 / 10 &&
        after.cost < before.cost) {
      aligned.view_from_frame = refined;
      aligned.residual = after.cost;
    }
  }
  find_gain(aligned);
  return aligned;
}

/// By the mean of small windows around the pixels, which hardly depend on an error of the pose.
void AlignmentTarget::find_gain(AlignedView& aligned) const {
  const BackgroundView& view = *aligned.view;
  if (view.colour.type() != frame_.colour.type()) return;
  const int channels = view.colour.channels();
  const Eigen::Matrix3f rotation = aligned.view_from_frame.rotation_matrix().cast<float>();
  const Eigen::Vector3f translation = aligned.view_from_frame.translation.cast<float>();
  double sums[2][3] = {};
  int count = 0;
  for (const Pixel& pixel : pixels_) {
    const std::optional<Eigen::Vector2f> at = find(rotation * pixel.point + translation, view);
    if (!at) continue;
    const cv::Point there(static_cast<int>(at->x() + 0.5F), static_cast<int>(at->y() + 0.5F));
    double here[2][3] = {};
    const bool saturated_here = add_window(frame_.colour, {pixel.x, pixel.y}, here[0]),
               saturated_there = add_window(view.colour, there, here[1]);
    // Another thing, or a shadow, is not the exposure.
    if (saturated_here || saturated_there || here[0][0] > 2 * here[1][0] + 90 ||
        here[1][0] > 2 * here[0][0] + 90)
      continue;
    ++count;
    for (int c = 0; c < channels; ++c) sums[0][c] += here[0][c], sums[1][c] += here[1][c];
  }
  if (count < kMinPixels / 3) return;
  for (int c = 0; c < 3; ++c) {
    const int from = channels == 1 ? 0 : c;
    if (sums[1][from] > 0) {
      aligned.gain[c] = static_cast<float>(std::clamp(sums[0][from] / sums[1][from], 0.4, 2.5));
    }
  }
}

}  // namespace stdc
