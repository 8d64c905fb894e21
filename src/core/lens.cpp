#include "core/lens.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace stdc {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// The denominator of the rational model.
double denominator(const Camera& c, double r2) { return 1 + r2 * (c.k4 + r2 * (c.k5 + r2 * c.k6)); }

/// Brown 1966 with OpenCV's denominator. Without k4..k6 the denominator is 1 and changes no bit.
Vector2d distort_brown(const Camera& c, const Vector2d& n, Matrix2d* jacobian) {
  const double x = n.x(), y = n.y(), r2 = x * x + y * y;
  const double above = 1 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3)), below = denominator(c, r2);
  const double radial = above / below;
  if (jacobian != nullptr) {
    const double above_slope = c.k1 + r2 * (2 * c.k2 + 3 * c.k3 * r2);
    const double below_slope = c.k4 + r2 * (2 * c.k5 + 3 * c.k6 * r2);
    const double slope = 2 * (above_slope - radial * below_slope) / below;  // d radial / d r2, times 2
    *jacobian << radial + x * x * slope + 2 * c.p1 * y + 6 * c.p2 * x,      //
        x * y * slope + 2 * c.p1 * x + 2 * c.p2 * y,                        //
        x * y * slope + 2 * c.p1 * x + 2 * c.p2 * y,                        //
        radial + y * y * slope + 6 * c.p1 * y + 2 * c.p2 * x;
  }
  return {x * radial + 2 * c.p1 * x * y + c.p2 * (r2 + 2 * x * x),
          y * radial + c.p1 * (r2 + 2 * y * y) + 2 * c.p2 * x * y};
}

/// Distance from the centre of what is `theta` [rad] off the axis, and its derivative.
double equidistant_radius(const Camera& c, double theta, double& slope) {
  const double t2 = theta * theta;
  slope = 1 + t2 * (3 * c.k1 + t2 * (5 * c.k2 + t2 * (7 * c.k3 + t2 * 9 * c.k4)));
  return theta * (1 + t2 * (c.k1 + t2 * (c.k2 + t2 * (c.k3 + t2 * c.k4))));
}

Vector2d distort_equidistant(const Camera& c, const Vector2d& n, Matrix2d* jacobian) {
  const double r = n.norm();
  if (r < 1e-9) {
    if (jacobian != nullptr) jacobian->setIdentity();
    return n;
  }
  double slope = 1;
  const double radius = equidistant_radius(c, std::atan(r), slope);
  if (jacobian != nullptr) {
    const Vector2d outwards = n / r;
    const double along = slope / (1 + r * r), across = radius / r;
    *jacobian = across * Matrix2d::Identity() + (along - across) * outwards * outwards.transpose();
  }
  return n * (radius / r);
}

Vector2d undistort_equidistant(const Camera& c, const Vector2d& raw) {
  const double radius = raw.norm();
  if (radius < 1e-9) return raw;
  // Bisection keeps Newton between angles whose radii lie on both sides.
  double low = 0, high = Camera::kMaxAngle, slope = 1;
  if (equidistant_radius(c, high, slope) <= radius) return raw * (std::tan(high) / radius);
  double theta = std::min(radius, high);
  constexpr int kMaxIterations = 60;
  for (int i = 0; i < kMaxIterations; ++i) {
    const double error = equidistant_radius(c, theta, slope) - radius;
    (error > 0 ? high : low) = theta;
    double next = theta - error / slope;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    const double step = next - theta;
    theta = next;
    if (std::abs(step) < 1e-14) break;
  }
  return raw * (std::tan(theta) / radius);
}

/// Newton's method from `n`, each step halved until it comes nearer. True if it arrived without leaving the
/// region where the determinant is positive.
bool solve_brown(const Camera& c, const Vector2d& raw, Vector2d& n) {
  constexpr int kMaxIterations = 20, kMaxHalvings = 8;
  Matrix2d jacobian, next_jacobian;
  Vector2d error = distort_brown(c, n, &jacobian) - raw;
  for (int i = 0; i < kMaxIterations; ++i) {
    if (!(jacobian.determinant() > 1e-9)) return false;
    Vector2d step = jacobian.inverse() * error;
    if (step.squaredNorm() < 1e-20) {
      n -= step;
      return true;
    }
    Vector2d next = n - step;
    Vector2d next_error = distort_brown(c, next, &next_jacobian) - raw;
    for (int halving = 0; halving < kMaxHalvings && !(next_error.squaredNorm() < error.squaredNorm());
         ++halving) {
      step *= 0.5;
      next = n - step;
      next_error = distort_brown(c, next, &next_jacobian) - raw;
    }
    n = next, error = next_error, jacobian = next_jacobian;
  }
  return false;
}

/// Follows the lens from the centre: slow, and does not get onto another branch.
Vector2d follow_brown(const Camera& c, const Vector2d& raw) {
  constexpr int kSteps = 64;
  Vector2d n = Vector2d::Zero();
  for (int i = 1; i <= kSteps; ++i) {
    Vector2d next = n;
    if (!solve_brown(c, raw * (static_cast<double>(i) / kSteps), next)) break;
    n = next;
  }
  return n;
}

struct Ray {
  Vector2d normalised, raw;
};

/// Looks for folds and poles; `fault` gets the first of the direction. `last`: out, the ray before the edge.
std::optional<LensFault> follow_ray(const Camera& c, const Vector2d& direction) {
  constexpr double kStep = 0.005;  // [rad]
  Vector2d last(c.cx, c.cy);
  for (double theta = kStep; theta <= Camera::kMaxAngle; theta += kStep) {
    const Vector2d n = direction * std::tan(theta);
    Matrix2d jacobian;
    const Vector2d d = distort_normalised(c, n, &jacobian);
    const Vector2d raw(c.fx * d.x() + c.cx, c.fy * d.y() + c.cy);
    const bool brown = c.lens == LensModel::brown_conrady;
    if (brown && !(denominator(c, n.squaredNorm()) > 0))
      return LensFault{last, "the lens distortion has a pole"};
    if (!(jacobian.determinant() > 0) || !(d.dot(direction) > 0))
      return LensFault{last, "the lens distortion folds back"};
    if (raw.x() < 0 || raw.y() < 0 || raw.x() > c.width - 1 || raw.y() > c.height - 1) return {};
    last = raw;
  }
  if (c.lens == LensModel::equidistant) return {};  // what is beyond has no ideal pixel and is not used
  return LensFault{last, "the lens distortion reaches no further"};
}

}  // namespace

Vector2d distort_normalised(const Camera& camera, const Vector2d& ideal, Matrix2d* jacobian) {
  return camera.lens == LensModel::equidistant ? distort_equidistant(camera, ideal, jacobian)
                                               : distort_brown(camera, ideal, jacobian);
}

Vector2d undistort_normalised(const Camera& camera, const Vector2d& raw) {
  if (camera.lens == LensModel::equidistant) return undistort_equidistant(camera, raw);
  Vector2d n = raw;
  return solve_brown(camera, raw, n) ? n : follow_brown(camera, raw);
}

std::optional<LensFault> find_lens_fault(const Camera& camera) {
  if (!camera.has_distortion()) return {};
  const Vector2d centre(camera.cx, camera.cy), focal(camera.fx, camera.fy);
  const auto nearer = [&](const LensFault& a, const std::optional<LensFault>& b) {
    return !b || (a.raw - centre).squaredNorm() < (b->raw - centre).squaredNorm();
  };
  std::optional<LensFault> worst;
  const auto follow = [&](const Vector2d& direction) {
    const auto fault = follow_ray(camera, direction.normalized());
    if (fault && nearer(*fault, worst)) worst = fault;
  };
  constexpr int kDirections = 180;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2 * std::numbers::pi * i / kDirections;
    follow({std::cos(angle), std::sin(angle)});
  }
  for (const double x : {0.0, camera.width - 1.0}) {
    for (const double y : {0.0, camera.height - 1.0}) follow((Vector2d(x, y) - centre).cwiseQuotient(focal));
  }
  if (worst) return worst;
  constexpr int kColumns = 32, kRows = 24;
  for (int i = 0; i <= kColumns * kRows + kRows; ++i) {
    const Vector2d raw((camera.width - 1.0) * (i % (kColumns + 1)) / kColumns,
                       (camera.height - 1.0) * std::min(i / (kColumns + 1), kRows) / kRows);
    if (camera.has_ideal(raw) && !((camera.distort(camera.undistort(raw)) - raw).norm() < 1e-6))
      return LensFault{raw, "the lens distortion cannot be inverted"};
  }
  return {};
}

}  // namespace stdc
