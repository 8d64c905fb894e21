#include "simulation/people/solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stdc::simulation {
namespace {

/// The smaller of a and b, rounded where they are less than k apart.
float soft_min(float a, float b, float k) {
  if (k <= 0) return std::min(a, b);
  const float h = std::max(k - std::abs(a - b), 0.0F) / k;
  return std::min(a, b) - 0.25F * k * h * h;
}

}  // namespace

void Solid::add(Shape shape, const Vector3f& middle, float reach) {
  shape.middle = middle;
  shape.reach = reach;
  if (shape.add) {
    const Vector3f margin = Vector3f::Constant(reach + 0.25F * shape.blend + 0.005F);
    bounds_.extend(Vector3f(middle - margin));
    bounds_.extend(Vector3f(middle + margin));
  }
  shapes_.push_back(shape);
}

void Solid::cone(const Vector3f& a, const Vector3f& b, float radius_a, float radius_b, float blend) {
  Shape shape;
  shape.a = a;
  shape.b = b;
  shape.radius_a = radius_a;
  shape.radius_b = radius_b;
  shape.blend = blend;
  add(shape, 0.5F * (a + b), 0.5F * (b - a).norm() + std::max(radius_a, radius_b));
}

void Solid::ellipsoid(const Vector3f& centre, const Vector3f& radii, float blend,
                      const Eigen::Quaternionf& rotation) {
  Shape shape;
  shape.kind = Kind::ellipsoid;
  shape.a = centre;
  shape.b = radii;
  shape.blend = blend;
  shape.to_local = rotation.conjugate().toRotationMatrix();
  add(shape, centre, radii.maxCoeff());
}

void Solid::carve(const Vector3f& centre, const Vector3f& radii, float blend,
                  const Eigen::Quaternionf& rotation) {
  Shape shape;
  shape.kind = Kind::ellipsoid;
  shape.add = false;
  shape.a = centre;
  shape.b = radii;
  shape.blend = blend;
  shape.to_local = rotation.conjugate().toRotationMatrix();
  add(shape, centre, radii.maxCoeff());
}

void Solid::ring(const Vector3f& centre, const Vector3f& axis, float radius, float thickness, float blend) {
  Shape shape;
  shape.kind = Kind::ring;
  shape.a = centre;
  shape.b = axis.normalized();
  shape.radius_a = radius;
  shape.radius_b = thickness;
  shape.blend = blend;
  add(shape, centre, radius + thickness);
}

void Solid::cut(const Vector3f& point, const Vector3f& normal, float blend) {
  Shape shape;
  shape.kind = Kind::plane;
  shape.add = false;
  shape.a = point;
  shape.b = normal.normalized();
  shape.blend = blend;
  add(shape, point, std::numeric_limits<float>::max());
}

void Solid::displace(Displacement amount, float max_amount) {
  displacement_ = std::move(amount);
  bounds_.extend(Vector3f(bounds_.min() - Vector3f::Constant(max_amount)));
  bounds_.extend(Vector3f(bounds_.max() + Vector3f::Constant(max_amount)));
}

float Solid::distance(const Shape& shape, const Vector3f& p) {
  switch (shape.kind) {
    case Kind::cone: {
      const Vector3f axis = shape.b - shape.a, from = p - shape.a;
      const float h = std::clamp(from.dot(axis) / axis.squaredNorm(), 0.0F, 1.0F);
      return (from - h * axis).norm() - (shape.radius_a + h * (shape.radius_b - shape.radius_a));
    }
    case Kind::ellipsoid: {
      const Vector3f local = shape.to_local * (p - shape.a);
      const Vector3f once = local.cwiseQuotient(shape.b);
      const float k0 = once.norm(), k1 = once.cwiseQuotient(shape.b).norm();
      return k1 > 1e-6F ? k0 * (k0 - 1) / k1 : -shape.b.minCoeff();
    }
    case Kind::ring: {
      const Vector3f from = p - shape.a;
      const float up = from.dot(shape.b), out = (from - up * shape.b).norm() - shape.radius_a;
      return std::sqrt(up * up + out * out) - shape.radius_b;
    }
    case Kind::plane:
      break;
  }
  return -(p - shape.a).dot(shape.b);  // negative in the part to carve away
}

float Solid::distance(const Vector3f& p) const {
  float sum = std::numeric_limits<float>::max();
  for (const Shape& shape : shapes_) {
    if (shape.add) {
      const float min_distance = (p - shape.middle).norm() - shape.reach;
      if (min_distance > sum + shape.blend) continue;  // too far away to matter
      sum = sum == std::numeric_limits<float>::max() ? distance(shape, p)
                                                     : soft_min(sum, distance(shape, p), shape.blend);
    } else {
      sum = -soft_min(-sum, distance(shape, p), shape.blend);
    }
  }
  if (displacement_ && std::abs(sum) < 0.05F) sum -= displacement_(p);
  return sum;
}

Eigen::Vector3f Solid::normal(const Vector3f& p) const {
  constexpr float kStep = 1.5e-3F;
  Vector3f gradient;
  for (int i = 0; i < 3; ++i) {
    const Vector3f step = kStep * Vector3f::Unit(i);
    gradient[i] = distance(p + step) - distance(p - step);
  }
  return gradient.normalized();
}

}  // namespace stdc::simulation
