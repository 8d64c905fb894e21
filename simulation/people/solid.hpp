#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <vector>

namespace stdc {

/// A soft body given by its signed distance (negative inside): simple shapes that flow into each other, added
/// or carved away one after the other. Blends are quadratic (Ricci 1973 has the idea); distances of
/// ellipsoids are of first order (Taubin 1991). Metres.
class Solid {
 public:
  using Vector3f = Eigen::Vector3f;
  using Displacement = std::function<float(const Vector3f&)>;

  /// A rod that grows from radius_a at a to radius_b at b. `blend` is the width of the seam with what is
  /// there.
  void cone(const Vector3f& a, const Vector3f& b, float radius_a, float radius_b, float blend);
  void ellipsoid(const Vector3f& centre, const Vector3f& radii, float blend,
                 const Eigen::Quaternionf& turn = Eigen::Quaternionf::Identity());
  void ball(const Vector3f& centre, float radius, float blend) {
    ellipsoid(centre, {radius, radius, radius}, blend);
  }
  /// A ring of the given thickness (radius of its rim) about an axis.
  void ring(const Vector3f& centre, const Vector3f& axis, float radius, float thickness, float blend);
  /// Takes an ellipsoid away.
  void carve(const Vector3f& centre, const Vector3f& radii, float blend,
             const Eigen::Quaternionf& turn = Eigen::Quaternionf::Identity());
  /// Takes away what lies beyond a plane, on the side of its normal.
  void cut(const Vector3f& point, const Vector3f& normal, float blend);
  /// Swells the finished surface outward by a small amount that depends on the place.
  void displace(Displacement amount, float largest);

  float distance(const Vector3f& p) const;
  /// Unit vector outward.
  Vector3f normal(const Vector3f& p) const;
  Eigen::AlignedBox3f bounds() const { return bounds_; }

 private:
  enum class Kind { cone, ellipsoid, ring, plane };
  struct Shape {
    Kind kind = Kind::cone;
    bool add = true;
    float blend = 0;
    Vector3f a, b;  ///< cone: ends; ellipsoid: centre, radii; ring, plane: centre, axis
    float radius_a = 0, radius_b = 0;
    Eigen::Matrix3f to_local = Eigen::Matrix3f::Identity();
    Vector3f middle = Vector3f::Zero();
    float reach = 0;  ///< radius of a ball about `middle` that holds the shape
  };
  static float distance(const Shape& shape, const Vector3f& p);
  void add(Shape shape, const Vector3f& middle, float reach);

  std::vector<Shape> shapes_;
  Displacement displacement_;
  Eigen::AlignedBox3f bounds_;
};

}  // namespace stdc
