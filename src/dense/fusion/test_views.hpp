#pragma once

#include <functional>
#include <vector>

#include "core/camera.hpp"
#include "dense/dense_settings.hpp"
#include "dense/fusion/placed_view.hpp"

namespace stdc::test {

/// A camera of 160 x 120 pixels without distortion.
Camera dense_camera();

/// A view of depths given by a function of the ray (x / z, y / z): z [m], 0 for none; grey-blue all over.
/// @param frames  that support it
std::shared_ptr<const DenseView> view_of(const std::function<float(float, float)>& depth, int frames = 15);

/// The depth of a ball before a wall in a camera at `centre` that looks along z; the ball's radius 0.3 m, at
/// (0, 0, 1.5), the wall at z = 2.5 m of the world.
PlacedView ball_and_wall(const Eigen::Vector3d& camera, bool with_ball = true);

/// The same ball from the origin, known to move, and nothing else.
PlacedView moving_ball();

/// Settings for tests: voxels of 2 cm.
DenseSettings coarse_settings();

}  // namespace stdc::test
