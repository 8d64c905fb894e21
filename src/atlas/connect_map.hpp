#pragma once

#include <vector>

#include "atlas/keyframe.hpp"
#include "atlas/landmark.hpp"
#include "atlas/storage/record_stream.hpp"

namespace stdc {

/// Makes one whole of keyframes and landmarks that were read one by one: notes the keyframes' observations on
/// the landmarks' side. Throws Error of the file that is read if what they say of each other does not hold:
/// what is named must be there, and of the same map; each map is a tree with one root, its oldest keyframe.
/// @param keyframes  by id; parents are older than their children, ties are in order
void connect_map(const RecordReader& in, const std::vector<Keyframe>& keyframes,
                 std::vector<Landmark>& landmarks);

}  // namespace stdc
