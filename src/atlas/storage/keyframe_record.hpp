#pragma once

#include <vector>

#include "atlas/keyframe.hpp"
#include "atlas/storage/record_stream.hpp"
#include "core/camera.hpp"

namespace stdc {

/// New numbers of keyframes and landmarks, by old id; Id::kNone: not written. And of maps; -1: there is none.
struct NewIds {
  std::vector<std::uint32_t> keyframes, landmarks;
  std::vector<int> maps;
};

void put_pose(RecordWriter& out, const Pose& pose);
Pose get_pose(RecordReader& in);

/// A keyframe with its features, all but its id, which is its place in the file.
void put_keyframe(RecordWriter& out, const Keyframe& keyframe, const NewIds& ids);
/// @param id  that it gets; ids of other keyframes and of landmarks are not checked against the whole, but
///            what is said of one keyframe alone holds: parents and maps are older, loop edges in order
Keyframe get_keyframe(RecordReader& in, const Camera& camera, KeyframeId id);

}  // namespace stdc
