#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <vector>

namespace stdc::simulation {

/// A solid given by its signed distance (negative inside): simple shapes added or carved away one after the
/// other, with smooth blends (quadratic; the idea is Ricci 1973). Distances of ellipsoids are first-order
/// (Taubin 1991). Metres.
class Solid {
 public:
  using Vector3f = Eigen::Vector3f;
  using Displacement = std::function<float(const Vector3f&)>;

  /// A rod with round ends, of radius_a at a and radius_b at b. `blend` is the width of the blend with what
  /// is there.
  void cone(const Vector3f& a, const Vector3f& b, float radius_a, float radius_b, float blend);
  void ellipsoid(const Vector3f& centre, const Vector3f& radii, float blend,
                 const Eigen::Quaternionf& rotation = Eigen::Quaternionf::Identity());
  void ball(const Vector3f& centre, float radius, float blend) {
    ellipsoid(centre, {radius, radius, radius}, blend);
  }
  /// A torus about an axis; `thickness` is the radius of the tube.
  void ring(const Vector3f& centre, const Vector3f& axis, float radius, float thickness, float blend);
  /// Carves away an ellipsoid.
  void carve(const Vector3f& centre, const Vector3f& radii, float blend,
             const Eigen::Quaternionf& rotation = Eigen::Quaternionf::Identity());
  /// Carves away the side of a plane that its normal points to.
  void cut(const Vector3f& point, const Vector3f& normal, float blend);
  /// Displaces the finished surface outward by a small amount, at most max_amount, that depends on the
  /// position.
  void displace(Displacement amount, float max_amount);

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

}  // namespace stdc::simulation
