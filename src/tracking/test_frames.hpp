#pragma once

#include <vector>

#include "atlas/test_scene.hpp"
#include "tracking/local_map.hpp"
#include "tracking/tracked_frame.hpp"

/// Frames of a scene whose landmarks are known, for the tests of the tracking.
namespace stdc::test {

/// A view as a frame that is tracked: pose and motion known, its landmarks those that are mapped.
TrackedFrame tracked_frame(const MappedScene& mapped, const View& view, int index);

/// The point of the scene that a landmark is, or -1.
int point_of(const MappedScene& mapped, LandmarkId landmark);

}  // namespace stdc::test
