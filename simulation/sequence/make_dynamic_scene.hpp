#pragma once

#include <cstdint>
#include <optional>

#include "simulation/scene/room.hpp"
#include "simulation/sequence/dynamic_scene.hpp"
#include "simulation/sequence/preset.hpp"

namespace stdc::simulation {

/// The people and objects of a preset; none if nothing moves in it. `room` and `light` must outlive it.
/// @param with_movers  false: only the furniture that the preset adds to the room, at rest
std::optional<DynamicScene> make_dynamic_scene(Preset preset, std::uint64_t seed, bool with_movers,
                                               const Room& room, const BakedLight& light);

}  // namespace stdc::simulation
