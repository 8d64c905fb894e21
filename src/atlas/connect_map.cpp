#include "atlas/connect_map.hpp"

#include <algorithm>

namespace stdc {
namespace {

/// The maps are numbered in the order of their roots, and each is a tree of its own.
void check_maps(const RecordReader& in, const std::vector<Keyframe>& keyframes) {
  std::uint32_t maps = 0;
  for (const Keyframe& keyframe : keyframes) {
    if (keyframe.parent.valid()) {
      in.check(keyframes[keyframe.parent.value].map == keyframe.map, "a parent is of another map");
    } else {
      in.check(keyframe.map.value == maps++, "a map has not one root");
    }
  }
}

/// What a keyframe says of others holds: they are there and of its map, and loop edges are mutual.
void check_relations(const RecordReader& in, const std::vector<Keyframe>& keyframes) {
  for (const Keyframe& keyframe : keyframes) {
    const auto check_there = [&](KeyframeId id) {
      in.check(id.value < keyframes.size(), "a keyframe is missing");
      in.check(keyframes[id.value].map == keyframe.map, "a keyframe knows one of another map");
    };
    for (const Covisible& c : keyframe.covisible) check_there(c.keyframe);
    for (const KeyframeId other : keyframe.loops) {
      check_there(other);
      const auto& back = keyframes[other.value].loops;
      in.check(std::binary_search(back.begin(), back.end(), keyframe.id), "a loop edge is not mutual");
    }
  }
}

/// Notes the keyframes' observations on the landmarks' side, and checks what is said about landmarks.
void note_observations(const RecordReader& in, const std::vector<Keyframe>& keyframes,
                       std::vector<Landmark>& landmarks) {
  for (const Keyframe& keyframe : keyframes) {
    for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
      const LandmarkId id = keyframe.landmarks[i];
      if (!id.valid()) continue;
      in.check(id.value < landmarks.size(), "a landmark is missing");
      auto& observations = landmarks[id.value].observations;
      if (!observations.empty()) {
        const Keyframe& last = keyframes[observations.back().keyframe.value];
        in.check(last.id != keyframe.id, "a keyframe sees a landmark twice");
        in.check(last.map == keyframe.map, "a landmark is of two maps");
      }
      observations.push_back({keyframe.id, static_cast<std::int32_t>(i)});
    }
  }
  for (const Landmark& landmark : landmarks) {
    in.check(!landmark.observations.empty(), "nobody sees a landmark");
    in.check(landmark.created_by.value < keyframes.size(), "a keyframe is missing");
  }
}

}  // namespace

void connect_map(const RecordReader& in, const std::vector<Keyframe>& keyframes,
                 std::vector<Landmark>& landmarks) {
  check_maps(in, keyframes);
  check_relations(in, keyframes);
  note_observations(in, keyframes, landmarks);
}

}  // namespace stdc
