// Maps that outlive a session: saved, loaded, gone on with, and only localised in.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "atlas/storage/map_file.hpp"
#include "core/error.hpp"
#include "core/files/test_folder.hpp"
#include "slam/system_tests/test_load.hpp"
#include "slam/system_tests/test_walk.hpp"

namespace stdc {
namespace {

using test::Load;
using test::same_bytes;
using test::TestFolder;
using test::TestSequence;
using test::Walk;

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

Settings localising() {
  Settings settings;
  settings.system.localisation_only = true;
  return settings;
}

/// A map of the first 80 places.
std::filesystem::path mapped(const TestFolder& folder) {
  Walk walk;
  walk.go(0, 80);
  walk.slam.save_map(folder / "room.map");
  return folder / "room.map";
}

/// Distance of a result from the truth [m]; the map's world is the camera at place 0.
double session_error(const TrackingResult& result, int place) {
  const auto& truth = TestSequence::of_a_room().frames;
  const Pose expected = truth[0].world_from_cam.inverse() * truth[place].world_from_cam;
  return (expected.translation - result.cam_from_world->inverse().translation).norm();
}

TEST(MapSession, LocalisesInALoadedMapAndLeavesItAsItIs) {
  const TestFolder folder;
  const auto path = mapped(folder);
  Walk walk(localising());
  walk.slam.load_map(path);
  double worst = 0;
  for (int place = 70; place >= 5; --place) {
    const TrackingResult result = walk.see(place);
    ASSERT_EQ(result.status, TrackingStatus::ok) << "from the first frame on: " << place;
    EXPECT_FALSE(result.is_keyframe);
    worst = std::max(worst, session_error(result, place));
  }
  EXPECT_LT(worst, 0.03) << "as well as in memory";
  EXPECT_TRUE(walk.slam.trajectory().empty()) << "bounded memory: poses are not kept";
  walk.slam.save_map(folder / "again.map");
  EXPECT_EQ(bytes_of(path), bytes_of(folder / "again.map"));
}

TEST(MapSession, LocalisationGoesThroughPlacesThatTheMapDoesNotHave) {
  const TestFolder folder;
  Walk walk(localising());
  walk.slam.load_map(mapped(folder));
  walk.go(60, 100);  // 20 places beyond the map
  walk.go(100, 60);
  EXPECT_EQ(walk.results.back().status, TrackingStatus::ok);
  EXPECT_LT(session_error(walk.results.back(), 60), 0.03);
  EXPECT_GE(walk.count(TrackingStatus::ok), 50);
}

TEST(MapSession, ALaterSessionGoesOnWithTheMap) {
  const TestFolder folder;
  const auto path = mapped(folder);
  Walk walk;
  walk.slam.load_map(path);
  const int before = walk.slam.keyframes();
  walk.go(60, 119);
  EXPECT_EQ(walk.count(TrackingStatus::ok), 60);
  EXPECT_GT(walk.slam.keyframes(), before);
  EXPECT_LT(walk.worst_error({0}, 0), 0.03);
  for (const FramePose& pose : walk.slam.keyframe_trajectory()) EXPECT_LT(pose.frame, 60) << "only its own";
  walk.slam.save_map(folder / "larger.map");
  Walk third(localising());
  third.slam.load_map(folder / "larger.map");
  third.go(119, 20);
  EXPECT_EQ(third.count(TrackingStatus::ok), 100);
}

TEST(MapSession, ASessionThatBeginsElsewhereJoinsTheMapWhenItGetsThere) {
  const TestFolder folder;
  Settings settings;
  settings.tracking.new_map_after = 5;
  {
    Walk walk;
    walk.go(0, 40);
    walk.slam.save_map(folder / "room.map");
  }
  Walk walk(settings);
  walk.slam.load_map(folder / "room.map");
  walk.go(100, 10);
  EXPECT_EQ(walk.slam.maps(), 1);
  EXPECT_EQ(walk.results.back().map, MapId{0});
  EXPECT_LT(walk.worst_error({0}, 0), 0.03);
}

TEST(MapSession, RefusesWhatDoesNotFit) {
  const TestFolder folder;
  const auto path = mapped(folder);
  Camera other = TestSequence::of_a_room().camera;
  other.fx += 1;
  Slam slam(other, {});
  try {
    slam.load_map(path);
    FAIL() << "another camera";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("room.map"), std::string::npos) << error.what();
  }
  EXPECT_THROW(slam.load_map(folder / "none.map"), Error);
  EXPECT_THROW(slam.save_map(folder / "no" / "such" / "folder.map"), Error);
  Walk walk;
  walk.see(0);
  EXPECT_THROW(walk.slam.load_map(path), Error) << "too late";
}

TEST(MapSession, LoopsAndMergesGiveTheSameBytesOnALoadedMachine) {
  Settings settings;
  settings.tracking.new_map_after = 5;
  const auto run = [&] {
    Walk walk(settings);
    walk.go(0, 40);
    walk.go(100, 10);
    return walk.slam.trajectory();
  };
  const auto alone = run();
  const Load load;
  const auto loaded = run();
  EXPECT_TRUE(same_bytes(alone, loaded));
}

}  // namespace
}  // namespace stdc
