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
double denominator(const Lens& c, double r2) { return 1 + r2 * (c.k4 + r2 * (c.k5 + r2 * c.k6)); }

/// Brown 1966 with OpenCV's denominator.
Vector2d distort_brown(const Lens& c, const Vector2d& n, Matrix2d* jacobian) {
  const double x = n.x(), y = n.y(), r2 = x * x + y * y;
  const double above = 1 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
  const bool rational = c.k4 != 0 || c.k5 != 0 || c.k6 != 0;  // the usual lens is spared the divisions
  const double below = rational ? denominator(c, r2) : 1;
  const double radial = rational ? above / below : above;
  if (jacobian != nullptr) {
    const double above_slope = c.k1 + r2 * (2 * c.k2 + 3 * c.k3 * r2);
    double slope = 2 * above_slope;  // d radial / d r2, times 2
    if (rational) {
      const double below_slope = c.k4 + r2 * (2 * c.k5 + 3 * c.k6 * r2);
      slope = 2 * (above_slope - radial * below_slope) / below;
    }
    *jacobian << radial + x * x * slope + 2 * c.p1 * y + 6 * c.p2 * x,  //
        x * y * slope + 2 * c.p1 * x + 2 * c.p2 * y,                    //
        x * y * slope + 2 * c.p1 * x + 2 * c.p2 * y,                    //
        radial + y * y * slope + 6 * c.p1 * y + 2 * c.p2 * x;
  }
  return {x * radial + 2 * c.p1 * x * y + c.p2 * (r2 + 2 * x * x),
          y * radial + c.p1 * (r2 + 2 * y * y) + 2 * c.p2 * x * y};
}

/// Distance from the centre of what is `theta` [rad] off the axis, and its derivative.
double equidistant_radius(const Lens& c, double theta, double& slope) {
  const double t2 = theta * theta;
  slope = 1 + t2 * (3 * c.k1 + t2 * (5 * c.k2 + t2 * (7 * c.k3 + t2 * 9 * c.k4)));
  return theta * (1 + t2 * (c.k1 + t2 * (c.k2 + t2 * (c.k3 + t2 * c.k4))));
}

Vector2d distort_equidistant(const Lens& c, const Vector2d& n, Matrix2d* jacobian) {
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

Vector2d undistort_equidistant(const Lens& c, const Vector2d& raw) {
  const double radius = raw.norm();
  if (radius < 1e-9) return raw;
  // Bisection keeps Newton between angles whose radii lie on both sides.
  double low = 0, high = c.max_angle, slope = 1;
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
bool solve_brown(const Lens& c, const Vector2d& raw, Vector2d& n) {
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
Vector2d follow_brown(const Lens& c, const Vector2d& raw) {
  constexpr int kSteps = 64;
  Vector2d n = Vector2d::Zero();
  for (int i = 1; i <= kSteps; ++i) {
    Vector2d next = n;
    if (!solve_brown(c, raw * (static_cast<double>(i) / kSteps), next)) break;
    n = next;
  }
  return n;
}

/// The first fold or pole in a direction, if it lies inside the image.
std::optional<LensFault> follow_ray(const Lens& c, const LensImage& image, const Vector2d& direction) {
  constexpr double kStep = 0.005;  // [rad]
  Vector2d last = image.centre;
  for (double theta = kStep; theta <= c.max_angle; theta += kStep) {
    const Vector2d n = direction * std::tan(theta);
    Matrix2d jacobian;
    const Vector2d d = distort_normalised(c, n, &jacobian);
    const Vector2d raw = image.centre + image.focal.cwiseProduct(d);
    const bool brown = !c.equidistant;
    if (brown && !(denominator(c, n.squaredNorm()) > 0))
      return LensFault{last, "the lens distortion has a pole"};
    if (!(jacobian.determinant() > 0) || !(d.dot(direction) > 0))
      return LensFault{last, "the lens distortion folds back"};
    if (raw.x() < 0 || raw.y() < 0 || raw.x() > image.size.x() - 1 || raw.y() > image.size.y() - 1) return {};
    last = raw;
  }
  if (c.equidistant) return {};  // what is beyond has no ideal pixel and is not used
  return LensFault{last, "the lens distortion reaches no further"};
}

/// The first pixel of a grid whose ray is not found.
std::optional<LensFault> find_lost_pixel(const Lens& lens, const LensImage& image) {
  constexpr int kColumns = 32, kRows = 24;
  const double rim = distort_normalised(lens, {std::tan(lens.max_angle), 0}, nullptr).x();
  for (int row = 0; row <= kRows; ++row) {
    for (int column = 0; column <= kColumns; ++column) {
      const Vector2d share(static_cast<double>(column) / kColumns, static_cast<double>(row) / kRows);
      const Vector2d pixel = share.cwiseProduct(image.size - Vector2d::Ones());
      const Vector2d raw = (pixel - image.centre).cwiseQuotient(image.focal);
      if (lens.equidistant && raw.norm() >= rim) continue;
      const Vector2d again = distort_normalised(lens, undistort_normalised(lens, raw), nullptr);
      if (!((again - raw).cwiseProduct(image.focal).norm() < 1e-6))
        return LensFault{pixel, "the lens distortion cannot be inverted"};
    }
  }
  return {};
}

}  // namespace

Vector2d distort_normalised(const Lens& lens, const Vector2d& ideal, Matrix2d* jacobian) {
  return lens.equidistant ? distort_equidistant(lens, ideal, jacobian) : distort_brown(lens, ideal, jacobian);
}

Vector2d undistort_normalised(const Lens& lens, const Vector2d& raw) {
  if (lens.equidistant) return undistort_equidistant(lens, raw);
  Vector2d n = raw;
  return solve_brown(lens, raw, n) ? n : follow_brown(lens, raw);
}

std::optional<LensFault> find_lens_fault(const Lens& lens, const LensImage& image) {
  std::optional<LensFault> worst;
  const auto follow = [&](const Vector2d& direction) {
    const auto fault = follow_ray(lens, image, direction.normalized());
    const auto distance = [&](const LensFault& f) { return (f.raw - image.centre).squaredNorm(); };
    if (fault && (!worst || distance(*fault) < distance(*worst))) worst = fault;
  };
  constexpr int kDirections = 180;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2 * std::numbers::pi * i / kDirections;
    follow({std::cos(angle), std::sin(angle)});
  }
  const Vector2d corner = image.size - Vector2d::Ones();
  for (const double x : {0.0, corner.x()}) {
    for (const double y : {0.0, corner.y()})
      follow((Vector2d(x, y) - image.centre).cwiseQuotient(image.focal));
  }
  return worst ? worst : find_lost_pixel(lens, image);
}

}  // namespace stdc
