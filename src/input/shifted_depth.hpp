#pragma once

#include <memory>

#include "input/frame_source.hpp"

namespace stdc {

/// The frames of a source whose depth images were taken `offset` [s] later than their stamps say: each colour
/// image gets the depth image that was taken nearest to it, at most `max_difference` [s] apart; where the
/// times of the two lie half a period apart, a depth image may serve two. Colour images that find none count
/// as those without depth. Depth images that belong to no frame of the source are lost.
std::unique_ptr<FrameSource> shift_depth(std::unique_ptr<FrameSource> source, double offset,
                                         double max_difference = 0.02);

}  // namespace stdc
