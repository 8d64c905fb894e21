#include "run_record.hpp"

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
  EXPECT_EQ(quantiles({}).median, 0);
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
  mapped.mapping = MappingReport{40, 30, 5, 600, 2000};
  record.add(mapped);

  const std::string csv = record.frames_csv();
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  const auto commas = std::count(csv.begin(), csv.begin() + static_cast<long>(csv.find('\n')), ',');
  EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), 5 * commas);
  EXPECT_NE(csv.find("\n2,1.200000,skipped,10,0,7,0,0,"), std::string::npos);
  EXPECT_NE(csv.find(",40.000,30.000,5,600,2000\n"), std::string::npos);

  EXPECT_EQ(record.counts().total(), 4);
  EXPECT_EQ(record.counts().ok, 1);
  EXPECT_EQ(record.counts().skipped, 1);
  // Skipped frames took no time and do not count.
  EXPECT_EQ(record.stage_milliseconds()["extraction"]["median"], 2);
  EXPECT_EQ(record.mapping()["keyframes_mapped"], 1);
  EXPECT_EQ(record.mapping()["bundle_adjustment_ms"]["p95"], 30);
}

}  // namespace
}  // namespace stdc::app
