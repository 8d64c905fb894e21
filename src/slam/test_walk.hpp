#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

#include "slam/test_footage.hpp"

namespace stdc::test {

constexpr double kStep = 1 / 15.0;  // [s]

class Walk {
 public:
  using Change = std::function<void(RgbdImage&)>;

  explicit Walk(Settings settings = {}, std::unique_ptr<Segmenter> segmenter = nullptr)
      : slam(Footage::of_a_room().camera, small(settings), std::move(segmenter)) {}

  TrackingResult see(
      int place, const Change& change = [](RgbdImage&) {}) {
    const simulation::RenderedFrame& frame = Footage::of_a_room().frames[place];
    RgbdImage image{time, frame.image.colour.clone(), frame.image.depth.clone()};
    time += kStep;
    change(image);
    TrackingResult result = slam.track(image);
    EXPECT_EQ(result.status == TrackingStatus::ok, result.cam_from_world.has_value());
    EXPECT_EQ(result.status == TrackingStatus::ok, result.map.valid());
    if (result.status == TrackingStatus::ok) places.push_back(place);
    results.push_back(result);
    return result;
  }
  /// From one place to another, both included.
  void go(
      int from, int to, const Change& change = [](RgbdImage&) {}) {
    const int step = from <= to ? 1 : -1;
    for (int place = from; place != to + step; place += step) see(place, change);
  }
  int count(TrackingStatus status, std::size_t from = 0) const {
    return static_cast<int>(std::count_if(results.begin() + static_cast<std::ptrdiff_t>(from), results.end(),
                                          [&](const TrackingResult& r) { return r.status == status; }));
  }
  /// Largest distance from the truth of frames in a map, whose first frame was taken at `origin` [m].
  double worst_error(MapId map, int origin) {
    const auto& truth = Footage::of_a_room().frames;
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

  Slam slam;
  double time = 0;
  std::vector<TrackingResult> results;
  std::vector<int> places;  ///< of the frames that have a pose

 private:
  static Settings small(Settings settings) {
    settings.features.keypoints = 500;
    return settings;
  }
};

}  // namespace stdc::test
