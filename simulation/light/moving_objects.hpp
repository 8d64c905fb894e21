#pragma once

#include "simulation/light/surface_shader.hpp"

namespace stdc::simulation {

/// People and moving objects at one moment: what RayRenderer needs to know of them.
class MovingObjects {
 public:
  virtual ~MovingObjects() = default;
  /// As RayScene::trace.
  virtual bool trace(const Eigen::Vector3f& origin, const Eigen::Vector3f* directions, int count,
                     Hit* hits) const = 0;
  virtual Shade shade(const Hit& hit, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                      float pixel_angle) const = 0;
  /// Edges between surfaces of different number are antialiased.
  virtual std::uint32_t surface(const Hit& hit) const = 0;
  /// Whether the surface hit is moving now: 255 in the mask.
  virtual bool dynamic(const Hit& hit) const = 0;
  /// Whether it moves at any time of the sequence.
  virtual bool ever_dynamic(const Hit& hit) const { return dynamic(hit); }
  /// Share of the light that reaches a point of the static scene, 0..1.
  virtual float shadow(const Eigen::Vector3f& position, const Eigen::Vector3f& normal) const = 0;
};

}  // namespace stdc::simulation
