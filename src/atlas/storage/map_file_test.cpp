#include "atlas/storage/map_file.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "atlas/storage/record_stream.hpp"
#include "atlas/storage/test_map_file.hpp"
#include "core/files/test_folder.hpp"
#include "core/files/text_file.hpp"

namespace stdc {
namespace {

using test::bytes_of;
using test::expect_same;
using test::map_of;
using test::MappedScene;
using test::message_of;
using test::Scene;
using test::TestFolder;

/// A map with everything in it: patches, rolling shutter, removed keyframes and landmarks.
MappedScene make_scene(int points = 150, bool removed = true) {
  Scene room(points);
  room.camera.readout_time = 0.02;
  room.camera.k1 = 0.1;
  MappedScene mapped(room);
  for (int k = 0; k < 5; ++k) {
    const Pose pose = test::camera_at(0.1 * k, 0, 0.05 * k, 0, 0.03 * k);
    Pyramid pyramid;
    if (k == 1) pyramid.build(room.render(pose), test::scene_feature_settings());
    test::ViewOptions options;
    options.seed = 1 + k;
    options.twist << 0.1, 0.2, -0.1, 0.3, 0.2, -0.1;
    options.pyramid = k == 1 ? &pyramid : nullptr;
    mapped.add(room.look(pose, options));
    mapped.atlas.count_visible(mapped.atlas.landmark_ids()[k], 3);
    mapped.atlas.count_found(mapped.atlas.landmark_ids()[k], 2);
  }
  if (removed) {
    mapped.atlas.remove(KeyframeId{2});
    mapped.atlas.remove(mapped.atlas.landmark_ids()[3]);
    mapped.atlas.add_landmark({1, 2, 3}, KeyframeId{2});  // seen by nobody
  }
  return mapped;
}

TEST(MapFile, EverythingComesBack) {
  const TestFolder folder;
  const MappedScene mapped = make_scene();
  const auto path = folder / "room.atlas";
  save_map(path, mapped.scene.camera, mapped.atlas);
  const StoredMap stored = load_map(path);
  EXPECT_EQ(stored.camera.fx, mapped.scene.camera.fx);
  EXPECT_EQ(stored.camera.k1, mapped.scene.camera.k1);
  EXPECT_EQ(stored.camera.readout_time, mapped.scene.camera.readout_time);
  EXPECT_EQ(stored.camera.height, mapped.scene.camera.height);
  expect_same(mapped.atlas, stored.atlas);
  test::expect_consistent(stored.atlas);
  EXPECT_EQ(stored.atlas.keyframe_id_limit(), 4U) << "without gaps";
  EXPECT_EQ(static_cast<int>(stored.atlas.landmark_id_limit()), mapped.atlas.landmark_count() - 1)
      << "what nobody sees is left out";
}

TEST(MapFile, SavedAgainItHasTheSameBytes) {
  const MappedScene mapped = make_scene();
  const std::string bytes = bytes_of(mapped.scene.camera, mapped.atlas);
  const StoredMap stored = map_of(bytes);
  EXPECT_EQ(bytes_of(stored.camera, stored.atlas), bytes);
}

TEST(MapFile, AMapThatWasLoadedCanGrow) {
  const MappedScene mapped = make_scene();
  StoredMap stored = map_of(bytes_of(mapped.scene.camera, mapped.atlas));
  const KeyframeId first = stored.atlas.keyframe_ids().front();
  const test::View view = mapped.scene.look(test::camera_at(0.3, 0, 0));
  const KeyframeId added =
      stored.atlas.add_keyframe({99, 3.3, view.cam_from_world, view.motion, view.features,
                                 measure_keypoints(mapped.scene.camera, view.motion, *view.features)});
  EXPECT_EQ(added.value, 4U);
  const auto landmarks = stored.atlas.landmark_ids();
  for (int i = 0; i < view.features->size(); ++i) EXPECT_TRUE(stored.atlas.observe(added, i, landmarks[i]));
  stored.atlas.update_covisibility(added);
  EXPECT_TRUE(stored.atlas.keyframe(added).parent.valid());
  stored.atlas.remove(KeyframeId{1});
  stored.atlas.remove(stored.atlas.landmark_ids().front());
  test::expect_consistent(stored.atlas);
  EXPECT_EQ(stored.atlas.resolve(KeyframeId{1}).keyframe, first);
}

TEST(MapFile, AnEmptyMapIsAMapToo) {
  const StoredMap stored = map_of(bytes_of(Camera(), Atlas()));
  EXPECT_EQ(stored.atlas.keyframe_count(), 0);
  EXPECT_EQ(stored.atlas.landmark_count(), 0);
}

TEST(MapFile, CutShortAnywhereItIsRefused) {
  const MappedScene mapped = make_scene(40, false);
  const std::string bytes = bytes_of(mapped.scene.camera, mapped.atlas);
  for (std::size_t size = 0; size < bytes.size(); size += size < 200 ? 1 : 37) {
    const std::string message = message_of([&] { map_of(bytes.substr(0, size)); });
    EXPECT_EQ(message, size < 16
                           ? "some.map: is not a map file; give one that was written by --save-map"
                           : "some.map: is damaged (it ends too early); use a copy of it, or make the map "
                             "again")
        << size;
  }
  EXPECT_NE(message_of([&] { map_of(bytes + "x"); }), "");
}

TEST(MapFile, AFlippedBitAnywhereIsNoticed) {
  const MappedScene mapped = make_scene(40, false);
  std::string bytes = bytes_of(mapped.scene.camera, mapped.atlas);
  for (std::size_t i = 0; i < bytes.size(); i += i < 300 ? 1 : 11) {
    bytes[i] = static_cast<char>(bytes[i] ^ (1 << (i % 8)));
    EXPECT_NE(message_of([&] { map_of(bytes); }), "") << "byte " << i;
    bytes[i] = static_cast<char>(bytes[i] ^ (1 << (i % 8)));
  }
  EXPECT_EQ(message_of([&] { map_of(bytes); }), "");
}

/// The same map as version 1 had it: without k4, k5, k6 and the lens model.
std::string as_version_1(std::string bytes) {
  constexpr std::size_t kHead = 16, kPayload = kHead + 16, kNow = 2 * 4 + 15 * 8 + 4, kThen = 2 * 4 + 12 * 8;
  const auto put = [&](std::size_t at, auto value) { std::memcpy(bytes.data() + at, &value, sizeof value); };
  bytes.erase(kPayload + kThen, kNow - kThen);
  put(8, std::uint32_t{1});
  put(12, check_sum(bytes.data(), 12));
  put(kHead + 4, check_sum(bytes.data() + kPayload, kThen));
  put(kHead + 8, std::uint64_t{kThen});
  return bytes;
}

TEST(MapFile, AnOlderVersionIsRead) {
  const MappedScene mapped = make_scene(40, false);
  const StoredMap stored = map_of(as_version_1(bytes_of(mapped.scene.camera, mapped.atlas)));
  EXPECT_EQ(stored.version, 1U);
  EXPECT_EQ(stored.camera, mapped.scene.camera);
  expect_same(mapped.atlas, stored.atlas);
}

TEST(MapFile, KeepsTheLens) {
  Camera camera;
  camera.k1 = 0.1, camera.k4 = 0.2, camera.k5 = 0.01, camera.k6 = 0.02;
  EXPECT_EQ(map_of(bytes_of(camera, Atlas())).camera, camera);
  camera.k5 = camera.k6 = 0, camera.lens = LensModel::equidistant;
  EXPECT_EQ(map_of(bytes_of(camera, Atlas())).camera, camera);
}

TEST(MapFile, ANewerVersionIsNamed) {
  std::string bytes = bytes_of(Camera(), Atlas());
  const std::uint32_t version = kMapFileVersion + 1;
  std::memcpy(bytes.data() + 8, &version, 4);
  const std::uint32_t sum = check_sum(bytes.data(), 12);
  std::memcpy(bytes.data() + 12, &sum, 4);
  EXPECT_EQ(
      message_of([&] { map_of(bytes); }),
      "some.map: is a map of version 4, this program reads up to 3; use a newer program, or make the map "
      "again");
}

TEST(MapFile, WhatCannotBeReadIsNamed) {
  const TestFolder folder;
  EXPECT_NE(message_of([&] { load_map(folder / "none.map"); }).find("none.map: cannot be opened"),
            std::string::npos);
  EXPECT_NE(message_of([&] { load_map(folder.path()); }).find("is a folder"), std::string::npos);
  const auto other = folder.write("photo.png", std::string("\x89PNG and a great many other bytes"));
  EXPECT_NE(message_of([&] { load_map(other); }).find("photo.png: is not a map file"), std::string::npos);
}

TEST(MapFile, AFileThatCannotBeWrittenLeavesTheOldOne) {
  const TestFolder folder;
  EXPECT_NE(message_of([&] {
              save_map(folder / "no/such/folder.map", Camera(), Atlas());
            }).find("folder.map: cannot be written (No such file or directory); check that"),
            std::string::npos);
  const auto path = folder / "a.map";
  save_map(path, Camera(), Atlas());
  const MappedScene mapped = make_scene(40, false);
  save_map(path, mapped.scene.camera, mapped.atlas);
  EXPECT_EQ(load_map(path).atlas.keyframe_count(), 5) << "an older map is replaced";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    files += entry.exists() ? 1 : 0;
  EXPECT_EQ(files, 1) << "nothing is left beside it";
}

}  // namespace
}  // namespace stdc
