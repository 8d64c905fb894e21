#pragma once

#include <memory>

#include "atlas/dense_view.hpp"
#include "core/pose.hpp"

namespace stdc {

/// A view and where it was taken, as now known.
struct PlacedView {
  std::shared_ptr<const DenseView> view;
  Pose cam_from_world;
};

}  // namespace stdc
