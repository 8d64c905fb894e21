#pragma once

#include "simulation/light/surface_shader.hpp"

namespace stdc {

/// People and moved things in one moment.
class MovingThings {
 public:
  virtual ~MovingThings() = default;
  /// As RayScene::trace.
  virtual bool trace(const Eigen::Vector3f& origin, const Eigen::Vector3f* directions, int count,
                     Hit* hits) const = 0;
  virtual Shade shade(const Hit& hit, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                      float pixel_angle) const = 0;
  /// A number that differs between surfaces that want a smoothed edge between them.
  virtual std::uint32_t surface(const Hit& hit) const = 0;
  virtual bool dynamic(const Hit& hit) const = 0;
  /// What is left of the light at a point of a still surface, 0..1.
  virtual float shadow(const Eigen::Vector3f& position, const Eigen::Vector3f& normal) const = 0;
};

}  // namespace stdc
