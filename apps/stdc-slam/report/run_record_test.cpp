#include "report/run_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace stdc::app {
namespace {

TEST(Quantiles, AreMeasuredValues) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  const Quantiles q = quantiles(values);
  EXPECT_EQ(q.median, 50);
  EXPECT_EQ(q.p95, 95);
  EXPECT_EQ(q.p99, 99);
  EXPECT_EQ(quantiles({7}).p99, 7);
  EXPECT_FALSE(quantiles({}).median) << "of nothing there is no median";
  EXPECT_TRUE(to_json(quantiles({}))["p95"].is_null());
  EXPECT_EQ(to_text(quantiles({}).p99, 1), "-");
  EXPECT_EQ(to_text(0.125, 1, 100), "12.5");
}

TrackingResult result(int frame, TrackingStatus status, double extraction) {
  TrackingResult r;
  r.frame = frame;
  r.timestamp = 1 + frame / 10.0;
  r.status = status;
  r.keypoints_high = 10;
  r.matches = 7;
  r.milliseconds.extraction = extraction;
  r.keypoints.resize(5);
  return r;
}

TEST(RunRecord, WritesARowForEveryFrame) {
  RunRecord record;
  record.add(result(0, TrackingStatus::initialising, 1));
  record.add(result(1, TrackingStatus::ok, 3));
  record.add(result(2, TrackingStatus::skipped, 0));
  TrackingResult mapped = result(3, TrackingStatus::lost, 2);
  mapped.mapping = MappingReport{40, 30, {3, 2, 600, 2000, 0}};
  mapped.place_recognition_ms = 1.5;
  record.add(mapped);

  const std::string csv = record.frames_csv();
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  const auto commas = std::count(csv.begin(), csv.begin() + static_cast<long>(csv.find('\n')), ',');
  EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), 5 * commas);
  EXPECT_NE(csv.find("\n2,1.200000,skipped,,10,0,7,0,0,"), std::string::npos);
  EXPECT_NE(csv.find(",40.000,30.000,5,600,2000,1.500,,,,,,,,\n"), std::string::npos);

  EXPECT_EQ(record.counts().total(), 4);
  EXPECT_EQ(record.counts().ok, 1);
  EXPECT_EQ(record.counts().skipped, 1);
  // Skipped frames took no time and do not count.
  EXPECT_EQ(record.stage_milliseconds()["extraction"]["median"], 2);
  EXPECT_EQ(record.mapping()["keyframes_mapped"], 1);
  EXPECT_EQ(record.mapping()["bundle_adjustment_ms"]["p95"], 30);
}

TEST(RunRecord, CountsLoopsAndMerges) {
  RunRecord record;
  EXPECT_TRUE(record.loops().to_json().is_null());
  EXPECT_EQ(record.loops().text(), "");
  for (int frame = 0; frame < 6; ++frame) {
    TrackingResult one = result(frame, TrackingStatus::ok, 1);
    one.map = {frame < 3 ? 0U : 2U};
    if (frame % 2 == 1) {
      one.loop = LoopReport{};
      one.loop->merged = frame == 3;
      one.loop->detection_ms = 2;
      one.loop->correction_ms = 10 * frame;
    }
    record.add(one);
  }
  EXPECT_EQ(record.loops().loops(), 2);
  EXPECT_EQ(record.loops().merges(), 1);
  EXPECT_EQ(record.loops().to_json()["correction_ms"]["median"], 30);
  EXPECT_NE(
      record.loops().text().find("loops closed: 2, maps merged: 1; correction 30 ms (median; longest: 50)"),
      std::string::npos);
  const std::string csv = record.frames_csv();
  EXPECT_NE(csv.find("\n2,1.200000,ok,0,10,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\n3,1.300000,ok,2,10,"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",loop,12.000,,,,,,\n2,"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",merge,32.000,,,,,,\n4,"), std::string::npos) << csv;
}

TEST(RunRecord, KeepsThePosesThatWereTracked) {
  RunRecord record;
  TrackingResult tracked = result(4, TrackingStatus::ok, 1);
  tracked.cam_from_world = Pose(Eigen::Quaterniond::Identity(), {1, 2, 3});
  tracked.map = {1};
  record.add(result(3, TrackingStatus::lost, 1));
  record.add(tracked);
  const std::vector<FramePose> poses = record.tracked_poses();
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses[0].frame, 4);
  EXPECT_EQ(poses[0].timestamp, 1.4);
  EXPECT_EQ(poses[0].map, MapId{1});
  EXPECT_EQ(poses[0].world_from_cam.translation, Eigen::Vector3d(-1, -2, -3));
}

}  // namespace
}  // namespace stdc::app
