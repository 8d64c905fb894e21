#include "map/map_file.hpp"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <cstring>
#include <sstream>

#include "core/test_folder.hpp"
#include "core/text_file.hpp"
#include "map/test_scene.hpp"

namespace stdc {
namespace {

using test::MappedScene;
using test::Scene;
using testing::message_of;
using testing::TestFolder;

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
    mapped.map.count_visible(mapped.map.landmark_ids()[k], 3);
    mapped.map.count_found(mapped.map.landmark_ids()[k], 2);
  }
  if (removed) {
    mapped.map.remove(KeyframeId{2});
    mapped.map.remove(mapped.map.landmark_ids()[3]);
    mapped.map.add_landmark({1, 2, 3}, KeyframeId{2});  // seen by nobody
  }
  return mapped;
}

std::string bytes_of(const Camera& camera, const Map& map) {
  std::ostringstream stream;
  write_map(stream, camera, map);
  return stream.str();
}

StoredMap map_of(const std::string& bytes) {
  std::istringstream stream(bytes);
  return read_map(stream, "some.map");
}

void expect_same(const FrameFeatures& a, const FrameFeatures& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(a.levels(), b.levels());
  EXPECT_EQ(a.scale_factor(), b.scale_factor());
  EXPECT_EQ(a.usual_depth(), b.usual_depth());
  EXPECT_EQ(a.pixels(), b.pixels());
  EXPECT_EQ(a.depths(), b.depths());
  EXPECT_EQ(a.descriptors(), b.descriptors());
  ASSERT_EQ(a.patches().size(), b.patches().size());
  for (int i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a.keypoint(i).x, b.keypoint(i).x);
    EXPECT_EQ(a.keypoint(i).y, b.keypoint(i).y);
    EXPECT_EQ(a.keypoint(i).angle, b.keypoint(i).angle);
    EXPECT_EQ(a.keypoint(i).response, b.keypoint(i).response);
    EXPECT_EQ(a.keypoint(i).level, b.keypoint(i).level);
    EXPECT_EQ(a.keypoint(i).quality, b.keypoint(i).quality);
    if (a.patch(i) != nullptr) {
      EXPECT_EQ(a.patch(i)->pixels, b.patch(i)->pixels);
    }
  }
}

/// The maps hold the same; ids may differ.
void expect_same(const Map& a, const Map& b) {
  const auto keyframes_a = a.keyframe_ids(), keyframes_b = b.keyframe_ids();
  const auto landmarks_b = b.landmark_ids();
  ASSERT_EQ(keyframes_a.size(), keyframes_b.size());
  for (std::size_t k = 0; k < keyframes_a.size(); ++k) {
    const Keyframe &of_a = a.keyframe(keyframes_a[k]), &of_b = b.keyframe(keyframes_b[k]);
    EXPECT_EQ(of_a.frame, of_b.frame);
    EXPECT_EQ(of_a.timestamp, of_b.timestamp);
    EXPECT_EQ(of_a.cam_from_world.rotation.coeffs(), of_b.cam_from_world.rotation.coeffs());
    EXPECT_EQ(of_a.cam_from_world.translation, of_b.cam_from_world.translation);
    EXPECT_EQ(of_a.motion.twist, of_b.motion.twist);
    EXPECT_EQ(of_a.motion.readout_time, of_b.motion.readout_time);
    EXPECT_EQ(of_a.motion.last_row, of_b.motion.last_row);
    EXPECT_EQ(of_a.parent.valid(), of_b.parent.valid());
    if (of_a.parent.valid()) {
      EXPECT_EQ(a.keyframe(of_a.parent).frame, b.keyframe(of_b.parent).frame);
    }
    ASSERT_EQ(of_a.covisible.size(), of_b.covisible.size());
    for (std::size_t i = 0; i < of_a.covisible.size(); ++i) {
      EXPECT_EQ(a.keyframe(of_a.covisible[i].keyframe).frame, b.keyframe(of_b.covisible[i].keyframe).frame);
      EXPECT_EQ(of_a.covisible[i].shared, of_b.covisible[i].shared);
    }
    expect_same(*of_a.features, *of_b.features);
    ASSERT_EQ(of_a.measurements.size(), of_b.measurements.size());
    for (std::size_t i = 0; i < of_a.measurements.size(); ++i) {
      EXPECT_EQ(of_a.measurements[i].seen, of_b.measurements[i].seen);
      EXPECT_EQ(of_a.measurements[i].pixel, of_b.measurements[i].pixel);
      EXPECT_EQ(of_a.measurements[i].depth, of_b.measurements[i].depth);
      EXPECT_EQ(of_a.measurements[i].scale, of_b.measurements[i].scale);
      ASSERT_EQ(of_a.landmarks[i].valid(), of_b.landmarks[i].valid());
      if (!of_a.landmarks[i].valid()) continue;
      const Landmark &l = a.landmark(of_a.landmarks[i]), &m = b.landmark(of_b.landmarks[i]);
      EXPECT_EQ(l.position, m.position);
      EXPECT_EQ(l.descriptor, m.descriptor);
      EXPECT_EQ(l.direction, m.direction);
      EXPECT_EQ(l.smallest_distance, m.smallest_distance);
      EXPECT_EQ(l.largest_distance, m.largest_distance);
      EXPECT_EQ(l.visible, m.visible);
      EXPECT_EQ(l.found, m.found);
      EXPECT_EQ(l.observations.size(), m.observations.size());
      EXPECT_TRUE(b.has(m.created_by));
    }
  }
  EXPECT_EQ(static_cast<int>(landmarks_b.size()), b.landmark_count());
}

TEST(MapFile, EverythingComesBack) {
  const TestFolder folder;
  const MappedScene mapped = make_scene();
  const auto path = folder / "room.map";
  save_map(path, mapped.scene.camera, mapped.map);
  const StoredMap stored = load_map(path);
  EXPECT_EQ(stored.camera.fx, mapped.scene.camera.fx);
  EXPECT_EQ(stored.camera.k1, mapped.scene.camera.k1);
  EXPECT_EQ(stored.camera.readout_time, mapped.scene.camera.readout_time);
  EXPECT_EQ(stored.camera.height, mapped.scene.camera.height);
  expect_same(mapped.map, stored.map);
  test::expect_consistent(stored.map);
  EXPECT_EQ(stored.map.keyframe_id_limit(), 4U) << "without gaps";
  EXPECT_EQ(static_cast<int>(stored.map.landmark_id_limit()), mapped.map.landmark_count() - 1)
      << "what nobody sees is left out";
}

TEST(MapFile, SavedAgainItHasTheSameBytes) {
  const MappedScene mapped = make_scene();
  const std::string bytes = bytes_of(mapped.scene.camera, mapped.map);
  const StoredMap stored = map_of(bytes);
  EXPECT_EQ(bytes_of(stored.camera, stored.map), bytes);
}

TEST(MapFile, AMapThatWasLoadedCanGrow) {
  const MappedScene mapped = make_scene();
  StoredMap stored = map_of(bytes_of(mapped.scene.camera, mapped.map));
  const KeyframeId first = stored.map.keyframe_ids().front();
  const test::View view = mapped.scene.look(test::camera_at(0.3, 0, 0));
  const KeyframeId added =
      stored.map.add_keyframe({99, 3.3, view.cam_from_world, view.motion, view.features,
                               measure_keypoints(mapped.scene.camera, view.motion, *view.features)});
  EXPECT_EQ(added.value, 4U);
  const auto landmarks = stored.map.landmark_ids();
  for (int i = 0; i < view.features->size(); ++i) EXPECT_TRUE(stored.map.observe(added, i, landmarks[i]));
  stored.map.update_covisibility(added);
  EXPECT_TRUE(stored.map.keyframe(added).parent.valid());
  stored.map.remove(KeyframeId{1});
  stored.map.remove(stored.map.landmark_ids().front());
  test::expect_consistent(stored.map);
  EXPECT_EQ(stored.map.resolve(KeyframeId{1}).keyframe, first);
}

TEST(MapFile, AnEmptyMapIsAMapToo) {
  const StoredMap stored = map_of(bytes_of(Camera(), Map()));
  EXPECT_EQ(stored.map.keyframe_count(), 0);
  EXPECT_EQ(stored.map.landmark_count(), 0);
}

TEST(MapFile, CutShortAnywhereItIsRefused) {
  const MappedScene mapped = make_scene(40, false);
  const std::string bytes = bytes_of(mapped.scene.camera, mapped.map);
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
  std::string bytes = bytes_of(mapped.scene.camera, mapped.map);
  for (std::size_t i = 0; i < bytes.size(); i += i < 300 ? 1 : 11) {
    bytes[i] = static_cast<char>(bytes[i] ^ (1 << (i % 8)));
    EXPECT_NE(message_of([&] { map_of(bytes); }), "") << "byte " << i;
    bytes[i] = static_cast<char>(bytes[i] ^ (1 << (i % 8)));
  }
  EXPECT_EQ(message_of([&] { map_of(bytes); }), "");
}

TEST(MapFile, ANewerVersionIsNamed) {
  std::string bytes = bytes_of(Camera(), Map());
  const std::uint32_t version = kMapFileVersion + 1;
  std::memcpy(bytes.data() + 8, &version, 4);
  const std::uint32_t sum = libdeflate_crc32(0, bytes.data(), 12);
  std::memcpy(bytes.data() + 12, &sum, 4);
  EXPECT_EQ(
      message_of([&] { map_of(bytes); }),
      "some.map: is a map of version 2, this program reads up to 1; use a newer program, or make the map "
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
              save_map(folder / "no/such/folder.map", Camera(), Map());
            }).find("folder.map: cannot be written (No such file or directory); check that"),
            std::string::npos);
  const auto path = folder / "a.map";
  save_map(path, Camera(), Map());
  const MappedScene mapped = make_scene(40, false);
  save_map(path, mapped.scene.camera, mapped.map);
  EXPECT_EQ(load_map(path).map.keyframe_count(), 5) << "an older map is replaced";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    files += entry.exists() ? 1 : 0;
  EXPECT_EQ(files, 1) << "nothing is left beside it";
}

}  // namespace
}  // namespace stdc
