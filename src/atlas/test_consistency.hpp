#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "atlas/atlas.hpp"

/// What holds of every map, for tests.
namespace stdc::test {

/// Each map is a tree of its own whose root is its oldest keyframe; nothing leads from one to another.
inline void expect_separate_maps(const Atlas& atlas) {
  int keyframes = 0;
  for (int number = 0; number < map.map_count(); ++number) {
    const std::vector<KeyframeId> ids = map.keyframe_ids(number);
    EXPECT_EQ(map.keyframe_count(number), static_cast<int>(ids.size()));
    EXPECT_EQ(map.root(number), ids.empty() ? KeyframeId() : ids.front());
    keyframes += map.keyframe_count(number);
    for (const KeyframeId id : ids) {
      const Keyframe& keyframe = map.keyframe(id);
      const auto lies_here = [&](KeyframeId other) {
        return other != id && map.has(other) && map.keyframe(other).map == number;
      };
      EXPECT_EQ(map.map_of(id), number);
      if (keyframe.parent.valid()) {
        EXPECT_TRUE(id != ids.front() && lies_here(keyframe.parent) && keyframe.parent < id);
      } else {
        EXPECT_TRUE(id == ids.front() || keyframe.covisible.empty()) << "only a bare one may have no parent";
      }
      for (const Covisible& c : keyframe.covisible) EXPECT_TRUE(lies_here(c.keyframe));
      EXPECT_TRUE(std::is_sorted(keyframe.loops.begin(), keyframe.loops.end()));
      for (const KeyframeId other : keyframe.loops) {
        ASSERT_TRUE(lies_here(other));
        const auto& back = map.keyframe(other).loops;
        EXPECT_EQ(std::count(back.begin(), back.end(), id), 1);
      }
    }
  }
  EXPECT_EQ(keyframes, map.keyframe_count());
}

/// Both sides of every observation agree, and all that is named exists.
inline void expect_consistent(const Atlas& atlas) {
  std::size_t seen = 0, noted = 0;
  for (const KeyframeId id : map.keyframe_ids()) {
    const Keyframe& keyframe = map.keyframe(id);
    ASSERT_EQ(keyframe.measurements.size(), keyframe.landmarks.size());
    for (int i = 0; i < static_cast<int>(keyframe.landmarks.size()); ++i) {
      if (!keyframe.landmarks[i].valid()) continue;
      ++seen;
      ASSERT_TRUE(map.has(keyframe.landmarks[i]));
      EXPECT_EQ(map.keypoint_of(keyframe.landmarks[i], id), i);
    }
    for (const Covisible& c : keyframe.covisible) EXPECT_TRUE(map.has(c.keyframe));
  }
  for (const LandmarkId id : map.landmark_ids()) {
    ASSERT_FALSE(map.landmark(id).observations.empty());
    const int number = map.keyframe(map.landmark(id).observations.front().keyframe).map;
    for (const Observation& o : map.landmark(id).observations)
      EXPECT_EQ(map.keyframe(o.keyframe).map, number);
    noted += map.landmark(id).observations.size();
  }
  EXPECT_EQ(noted, seen);
  expect_separate_maps(map);
}

}  // namespace stdc::test
