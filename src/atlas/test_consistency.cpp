#include "atlas/test_consistency.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace stdc::test {

void expect_separate_maps(const Atlas& atlas) {
  int keyframes = 0;
  for (MapId map{0}; map < atlas.next_map(); ++map.value) {
    const std::vector<KeyframeId> ids = atlas.keyframe_ids(map);
    EXPECT_EQ(atlas.keyframe_count(map), static_cast<int>(ids.size()));
    EXPECT_EQ(atlas.root(map), ids.empty() ? KeyframeId() : ids.front());
    keyframes += atlas.keyframe_count(map);
    for (const KeyframeId id : ids) {
      const Keyframe& keyframe = atlas.keyframe(id);
      const auto lies_here = [&](KeyframeId other) {
        return other != id && atlas.has(other) && atlas.keyframe(other).map == map;
      };
      EXPECT_EQ(atlas.map_of(id), map);
      if (keyframe.parent.valid()) {
        EXPECT_TRUE(id != ids.front() && lies_here(keyframe.parent) && keyframe.parent < id);
      } else {
        EXPECT_TRUE(id == ids.front() || keyframe.covisible.empty()) << "only a bare one may have no parent";
      }
      for (const Covisible& c : keyframe.covisible) EXPECT_TRUE(lies_here(c.keyframe));
      EXPECT_TRUE(std::is_sorted(keyframe.loops.begin(), keyframe.loops.end()));
      for (const KeyframeId other : keyframe.loops) {
        ASSERT_TRUE(lies_here(other));
        const auto& back = atlas.keyframe(other).loops;
        EXPECT_EQ(std::count(back.begin(), back.end(), id), 1);
      }
    }
  }
  EXPECT_EQ(keyframes, atlas.keyframe_count());
}

void expect_consistent(const Atlas& atlas) {
  std::size_t seen = 0, noted = 0;
  for (const KeyframeId id : atlas.keyframe_ids()) {
    const Keyframe& keyframe = atlas.keyframe(id);
    ASSERT_EQ(keyframe.measurements.size(), keyframe.landmarks.size());
    for (int i = 0; i < static_cast<int>(keyframe.landmarks.size()); ++i) {
      if (!keyframe.landmarks[i].valid()) continue;
      ++seen;
      ASSERT_TRUE(atlas.has(keyframe.landmarks[i]));
      EXPECT_EQ(atlas.keypoint_of(keyframe.landmarks[i], id), i);
    }
    for (const Covisible& c : keyframe.covisible) EXPECT_TRUE(atlas.has(c.keyframe));
  }
  for (const LandmarkId id : atlas.landmark_ids()) {
    ASSERT_FALSE(atlas.landmark(id).observations.empty());
    const MapId map = atlas.keyframe(atlas.landmark(id).observations.front().keyframe).map;
    for (const Observation& o : atlas.landmark(id).observations)
      EXPECT_EQ(atlas.keyframe(o.keyframe).map, map);
    noted += atlas.landmark(id).observations.size();
  }
  EXPECT_EQ(noted, seen);
  expect_separate_maps(atlas);
}

}  // namespace stdc::test
