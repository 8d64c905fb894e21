#include "report/map_export.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <nlohmann/json.hpp>

#include "atlas/storage/test_map_file.hpp"
#include "report/map_report.hpp"

namespace stdc::app {
namespace {

using stdc::test::MappedScene;

/// Two maps of three keyframes each, the second with patches.
MappedScene make_maps() {
  MappedScene mapped(stdc::test::Scene(80));
  for (int k = 0; k < 6; ++k) {
    if (k == 3) mapped.start_map();
    const Pose pose = stdc::test::camera_at(0.05 * k, 0, 0);
    Pyramid pyramid;
    if (k >= 3) pyramid.build(mapped.scene.render(pose), stdc::test::scene_feature_settings());
    stdc::test::ViewOptions options;
    options.pyramid = k >= 3 ? &pyramid : nullptr;
    mapped.add(mapped.scene.look(pose, options));
  }
  return mapped;
}

template <typename T>
T take(const std::string& bytes, std::size_t& at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  at += sizeof(T);
  return value;
}

TEST(PointCloud, HoldsEveryLandmark) {
  const MappedScene mapped = make_maps();
  const std::string ply = point_cloud_ply(mapped.atlas);
  const std::string end = "end_header\n";
  std::size_t at = ply.find(end) + end.size();
  EXPECT_EQ(ply.substr(0, 36), "ply\nformat binary_little_endian 1.0\n");
  EXPECT_NE(ply.find("\nelement vertex " + std::to_string(mapped.atlas.landmark_count()) + "\n"),
            std::string::npos);
  constexpr std::size_t kPointBytes = 3 * 4 + 3 + 2 * 4;
  ASSERT_EQ(ply.size() - at, kPointBytes * static_cast<std::size_t>(mapped.atlas.landmark_count()));
  int greys = 0;
  for (const LandmarkId id : mapped.atlas.landmark_ids()) {
    const Landmark& landmark = mapped.atlas.landmark(id);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(take<float>(ply, at), static_cast<float>(landmark.position[axis]));
    }
    const auto red = take<std::uint8_t>(ply, at);
    EXPECT_EQ(take<std::uint8_t>(ply, at), red);
    EXPECT_EQ(take<std::uint8_t>(ply, at), red);
    const Observation& first = landmark.observations.front();
    const Keyframe& keyframe = mapped.atlas.keyframe(first.keyframe);
    if (keyframe.map == MapId{0}) {
      EXPECT_EQ(red, 128) << "there are no patches";
    } else {
      EXPECT_EQ(red, keyframe.features->patch(first.keypoint)->view().row(Patch::kCentre)[Patch::kCentre]);
      greys += red != 128 ? 1 : 0;
    }
    EXPECT_EQ(take<std::int32_t>(ply, at), static_cast<std::int32_t>(landmark.observations.size()));
    EXPECT_EQ(take<std::int32_t>(ply, at), static_cast<std::int32_t>(keyframe.map.value));
  }
  EXPECT_GT(greys, 30);
}

TEST(PointCloud, OfNothingIsOneToo) {
  EXPECT_NE(point_cloud_ply(Atlas()).find("\nelement vertex 0\n"), std::string::npos);
}

TEST(KeyframesOfAMap, AreInOrderOfTimeAndOfThatMapOnly) {
  const MappedScene mapped = make_maps();
  const Trajectory second = keyframes_of(mapped.atlas, {1});
  ASSERT_EQ(second.size(), 3U);
  EXPECT_EQ(second[0].timestamp, mapped.atlas.keyframe({3}).timestamp);
  EXPECT_LT(stdc::test::centre_error(second[2].world_from_cam.inverse(), mapped.views[5].cam_from_world),
            1e-12);
  EXPECT_EQ(file_of_map("keyframes", {0}), "keyframes.txt");
  EXPECT_EQ(file_of_map("keyframes", {2}), "keyframes-map-2.txt");
}

TEST(KeyframesOfAMap, OfASequenceMappedTwiceEachTimeStandsOnce) {
  MappedScene mapped(stdc::test::Scene(80));
  for (const double time : {1.0, 2.0, 3.0, 1.0, 1.5, 3.0}) {
    const auto view = mapped.scene.look(stdc::test::camera_at(0.01 * mapped.atlas.keyframe_count(), 0, 0));
    mapped.atlas.add_keyframe({mapped.atlas.keyframe_count(), time, view.cam_from_world, view.motion,
                               view.features,
                               measure_keypoints(mapped.scene.camera, view.motion, *view.features)});
  }
  const Trajectory trajectory = keyframes_of(mapped.atlas, {0});
  ASSERT_EQ(trajectory.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(trajectory[i].timestamp, (std::array{1.0, 1.5, 2.0, 3.0}[i]));
  EXPECT_NEAR(trajectory[0].world_from_cam.translation.x(), 0.03, 1e-12) << "the youngest";
}

TEST(MapReport, TellsWhatIsThere) {
  const MappedScene mapped = make_maps();
  const StoredMap stored = stdc::test::map_of(stdc::test::bytes_of(mapped.scene.camera, mapped.atlas));
  const MapReport report = describe_map("a.map", 1234567, stored);
  ASSERT_EQ(report.maps.size(), 2U);
  int landmarks = 0, observations = 0;
  for (const LandmarkId id : stored.atlas.landmark_ids()) {
    const Landmark& landmark = stored.atlas.landmark(id);
    ++landmarks;
    observations += static_cast<int>(landmark.observations.size());
    bool inside = false;
    for (const MapContent& map : report.maps) inside = inside || map.box.contains(landmark.position);
    EXPECT_TRUE(inside);
  }
  EXPECT_EQ(report.maps[0].landmarks + report.maps[1].landmarks, landmarks);
  EXPECT_EQ(report.maps[0].observations + report.maps[1].observations, observations);
  EXPECT_EQ(report.maps[1].keyframes, 3);
  EXPECT_EQ(report.maps[1].first_timestamp, 1.0);
  EXPECT_NEAR(report.maps[1].last_timestamp, 50 / 30.0, 1e-12);

  const std::string text = map_report_text(report);
  EXPECT_NE(text.find("a.map: map file of version 2, 1.2 MB\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\nmap 1: 3 keyframes, "), std::string::npos) << text;
  const auto json = nlohmann::json::parse(map_report_json(report));
  EXPECT_EQ(json["maps"][0]["keyframes"], 3);
  EXPECT_EQ(json["landmarks"], landmarks);
  EXPECT_EQ(json["camera"]["fx"], mapped.scene.camera.fx);
  EXPECT_EQ(json["maps"][1]["bounding_box_m"]["min"][2], report.maps[1].box.min().z());
}

TEST(MapReport, AnEmptyMapHasNoBox) {
  const MapReport empty = describe_map("a.map", 200, StoredMap());
  EXPECT_NE(map_report_text(empty).find("0 maps, 0 keyframes"), std::string::npos);
  EXPECT_TRUE(nlohmann::json::parse(map_report_json(empty))["maps"].empty());
  MappedScene bare(stdc::test::Scene(80));
  bare.add_bare(bare.scene.look(Pose()));
  const MapReport report =
      describe_map("a.map", 200, {bare.scene.camera, std::move(bare.atlas), kMapFileVersion, {}});
  EXPECT_EQ(map_report_text(report).find("inf"), std::string::npos);
  EXPECT_TRUE(nlohmann::json::parse(map_report_json(report))["maps"][0]["bounding_box_m"].is_null());
}

}  // namespace
}  // namespace stdc::app
