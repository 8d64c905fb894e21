#include "slam/system_tests/test_walk.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace stdc::test {

Walk::Walk(Settings settings, std::unique_ptr<Segmenter> segmenter)
    : slam(TestSequence::of_a_room().camera, small(settings), std::move(segmenter)) {}

TrackingResult Walk::see(int place, const Change& change) {
  const simulation::RenderedFrame& frame = TestSequence::of_a_room().frames[place];
  RgbdImage image{time, frame.image.colour.clone(), frame.image.depth.clone()};
  time += kStep;
  change(image);
  TrackingResult result = slam.track(image);
  EXPECT_EQ(has_pose(result.status), result.cam_from_world.has_value());
  EXPECT_EQ(has_pose(result.status), result.covariance.has_value());
  EXPECT_EQ(has_pose(result.status), result.map.valid());
  if (result.status == TrackingStatus::ok) places.push_back(place);
  all_places_.push_back(place);
  results.push_back(result);
  return result;
}

void Walk::go(int from, int to, const Change& change) {
  const int step = from <= to ? 1 : -1;
  for (int place = from; place != to + step; place += step) see(place, change);
}

int Walk::count(TrackingStatus status, std::size_t from) const {
  return static_cast<int>(std::count_if(results.begin() + static_cast<std::ptrdiff_t>(from), results.end(),
                                        [&](const TrackingResult& r) { return r.status == status; }));
}

double Walk::worst_error(MapId map, int origin) {
  const auto& truth = TestSequence::of_a_room().frames;
  const std::vector<FramePose> poses = slam.trajectory();
  EXPECT_EQ(poses.size(), places.size());
  double worst = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (poses[i].map != map) continue;
    const Pose expected = truth[origin].world_from_cam.inverse() * truth[places[i]].world_from_cam;
    worst = std::max(worst, (expected.translation - poses[i].world_from_cam.translation).norm());
  }
  return worst;
}

std::vector<double> Walk::live_errors() const {
  const auto& truth = TestSequence::of_a_room().frames;
  std::vector<double> errors;
  std::map<MapId, int> origins;  // of the maps, as places
  for (std::size_t i = 0; i < results.size(); ++i) {
    const TrackingResult& result = results[i];
    errors.push_back(-1);
    if (!result.cam_from_world) continue;
    const int place = all_places_[i], origin = origins.emplace(result.map, place).first->second;
    const Pose expected = truth[origin].world_from_cam.inverse() * truth[place].world_from_cam;
    errors.back() = (expected.translation - result.cam_from_world->inverse().translation).norm();
  }
  return errors;
}

double Walk::worst_error_of_all() {
  std::map<MapId, int> origins;
  std::size_t i = 0;
  for (const FramePose& pose : slam.trajectory()) origins.emplace(pose.map, places[i++]);
  double worst = 0;
  for (const auto& [map, origin] : origins) worst = std::max(worst, worst_error(map, origin));
  return worst;
}

Settings Walk::small(Settings settings) {
  settings.features.keypoints = 500;
  return settings;
}

}  // namespace stdc::test
