#pragma once

namespace stdc::simulation {

/// Layout of the room, for cameras and people that move in it. Metres; x east, y north, floor at z = 0.
struct RoomPlan {
  static constexpr double kHalfWidth = 3.8, kHalfDepth = 3.2, kHeight = 2.7;
  /// The island of four desks in the middle: x in [-kIslandX, kIslandX], y in [kIslandSouth, kIslandNorth].
  static constexpr double kIslandX = 1.4, kIslandSouth = 0.2, kIslandNorth = 1.8;
};

}  // namespace stdc::simulation
