// Files of several maps.
#include <gtest/gtest.h>
#include <libdeflate.h>

#include <cstring>

#include "atlas/storage/test_map_file.hpp"
#include "core/files/test_folder.hpp"

namespace stdc {
namespace {

using test::bytes_of;
using test::expect_same;
using test::map_of;
using test::MappedScene;
using test::message_of;
using test::Scene;

/// Three maps, of which the second was joined to the first; keyframes 0 and 3 tied, 4 and 8 removed.
MappedScene make_atlas() {
  MappedScene mapped(Scene(60));
  for (int k = 0; k < 9; ++k) {
    if (k > 0 && k % 3 == 0) mapped.start_map();
    mapped.add(mapped.scene.look(test::camera_at(0.05 * k, 0, 0)));
  }
  mapped.atlas.join({1}, {0});
  mapped.atlas.add_loop_edge({0}, {3});
  mapped.atlas.add_loop_edge({3}, {2});
  mapped.atlas.remove(KeyframeId{4});
  mapped.atlas.remove(KeyframeId{8});
  return mapped;
}

TEST(AtlasFile, SeveralMapsComeBackNumberedAnew) {
  const MappedScene mapped = make_atlas();
  const std::string bytes = bytes_of(mapped.scene.camera, mapped.atlas);
  StoredMap stored = map_of(bytes);
  expect_same(mapped.atlas, stored.atlas);
  test::expect_consistent(stored.atlas);
  EXPECT_EQ(stored.atlas.map_count(), 2) << "the one that was joined to another is none";
  EXPECT_EQ(stored.atlas.keyframe_count({0}), 5);
  EXPECT_EQ(stored.atlas.keyframe_count({1}), 2);
  EXPECT_EQ(stored.atlas.root({1}), KeyframeId{5});
  EXPECT_EQ(stored.atlas.keyframe({3}).loops, (std::vector<KeyframeId>{{0}, {2}}));
  EXPECT_EQ(bytes_of(stored.camera, stored.atlas), bytes);
  stored.atlas.join({1}, {0});
  test::expect_consistent(stored.atlas);
  EXPECT_EQ(map_of(bytes_of(stored.camera, stored.atlas)).atlas.map_count(), 1);
}

/// What the reader says of an atlas whose keyframes were changed in some way; "" if it takes it.
template <typename Change>
std::string complaint(const Change& change) {
  const MappedScene mapped = make_atlas();
  const StoredMap stored = map_of(bytes_of(mapped.scene.camera, mapped.atlas));
  std::vector<Keyframe> keyframes;
  std::vector<Landmark> landmarks;
  for (const KeyframeId id : stored.atlas.keyframe_ids()) keyframes.push_back(stored.atlas.keyframe(id));
  for (const LandmarkId id : stored.atlas.landmark_ids()) landmarks.push_back(stored.atlas.landmark(id));
  change(keyframes);
  const Atlas changed(std::move(keyframes), std::move(landmarks));
  const std::string message = message_of([&] { map_of(bytes_of(stored.camera, changed)); });
  const std::size_t first = message.find('('), last = message.rfind(')');
  return first == std::string::npos ? message : message.substr(first + 1, last - first - 1);
}

TEST(AtlasFile, WhatMapsSayOfEachOtherIsChecked) {
  using Keyframes = std::vector<Keyframe>;
  // Keyframes 0 to 4 are map 0, 5 and 6 are map 1; 3 is tied to 0 and 2.
  EXPECT_EQ(complaint([](Keyframes&) {}), "");
  EXPECT_EQ(complaint([](Keyframes& k) { k[6].parent = {3}; }), "a parent is of another map");
  EXPECT_EQ(complaint([](Keyframes& k) { k[6].parent = {}; }), "a map has not one root");
  EXPECT_EQ(complaint([](Keyframes& k) { k[5].parent = {1}; }), "a number is out of range");
  EXPECT_EQ(complaint([](Keyframes& k) { k[2].map = {1}; }), "a parent is of another map");
  EXPECT_EQ(complaint([](Keyframes& k) {
              for (Keyframe& keyframe : k) keyframe.map = {0};
            }),
            "a map has not one root");
  EXPECT_EQ(complaint([](Keyframes& k) {
              k[2].covisible.push_back({{6}, 20});
            }),
            "a keyframe knows one of another map");
  EXPECT_EQ(complaint([](Keyframes& k) { k[0].loops = {}; }), "a loop edge is not mutual");
  EXPECT_EQ(complaint([](Keyframes& k) { k[1].loops = {{1}}; }), "a keyframe has a loop edge to itself");
  EXPECT_EQ(complaint([](Keyframes& k) {
              k[3].loops = {{2}, {0}};
            }),
            "a keyframe's loop edges are out of order");
  EXPECT_EQ(complaint([](Keyframes& k) {
              k[3].loops = {{0}, {0}, {2}};
            }),
            "a keyframe's loop edges are out of order");
  EXPECT_EQ(complaint([](Keyframes& k) {
              k[0].loops = {{3}, {5}};
              k[5].loops = {{0}};
            }),
            "a keyframe knows one of another map");
  EXPECT_EQ(complaint([](Keyframes& k) {
              for (LandmarkId& landmark : k[6].landmarks) {
                if (!landmark.valid()) continue;
                landmark = k[0].landmarks[0];
                break;
              }
            }),
            "a landmark is of two maps");
}

TEST(AtlasFile, AMapNumberBeyondTheKeyframesIsRefused) {
  // The number stands behind the pose and the motion of the first keyframe, whose record follows the
  // camera's.
  const MappedScene mapped = make_atlas();
  std::string bytes = bytes_of(mapped.scene.camera, mapped.atlas);
  constexpr std::size_t kCamera = 16 + 2 * 4 + 15 * 8 + 4, kNumber = 4 + 8 + 7 * 8 + 8 * 8;
  const std::size_t payload = 16 + kCamera + 16;
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data() + payload - 8, sizeof(size));
  for (const std::int32_t number : {-1, 1, 1 << 30}) {
    std::memcpy(bytes.data() + payload + kNumber, &number, sizeof(number));
    const std::uint32_t sum = libdeflate_crc32(0, bytes.data() + payload, size);
    std::memcpy(bytes.data() + payload - 12, &sum, sizeof(sum));
    EXPECT_NE(message_of([&] { map_of(bytes); }).find("a number is out of range"), std::string::npos)
        << number;
  }
}

}  // namespace
}  // namespace stdc
