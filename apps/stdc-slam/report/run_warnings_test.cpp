#include "report/run_warnings.hpp"

#include <gtest/gtest.h>

#include "report/json/frames_json.hpp"

namespace stdc::app {
namespace {

TrackingResult frame(int number, TrackingStatus status = TrackingStatus::ok, double ms = 10) {
  TrackingResult result;
  result.frame = number;
  result.timestamp = 50 + number / 30.0;
  result.status = status;
  result.milliseconds.total = ms;
  return result;
}

RunSummary summary_of(const RunRecord& record) {
  RunSummary summary;
  summary.poses = record.counts().ok;
  summary.maps = 1;
  return summary;
}

bool any_has(const std::vector<std::string>& lines, const std::string& part) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

TEST(RunWarnings, AGoodRunHasNone) {
  RunRecord record;
  for (int i = 0; i < 100; ++i) record.add(frame(i));
  EXPECT_TRUE(run_warnings(summary_of(record), record, {}).empty());
}

TEST(RunWarnings, TellWhatIsWrongInWords) {
  RunRecord record;
  for (int i = 0; i < 60; ++i) {
    record.add(frame(i,
                     i >= 30 && i < 36   ? TrackingStatus::uncertain
                     : i >= 40 && i < 42 ? TrackingStatus::lost
                                         : TrackingStatus::ok,
                     i % 10 == 0 ? 80 : 10));
  }
  RunSummary summary = summary_of(record);
  summary.maps = 2;
  const std::vector<std::string> lines =
      run_warnings(summary, record, {"median depth is 20.00 m: is it right?"});
  EXPECT_TRUE(any_has(lines, "Only 86.7 % of the frames are in the trajectory: 2 lost, 6 uncertain"));
  EXPECT_TRUE(any_has(lines, "6 frames are uncertain: 1.00 to 1.20 s (6 frames)"));
  EXPECT_TRUE(any_has(lines, "2 frames are lost: 1.33 to 1.40 s (2 frames)"));
  EXPECT_TRUE(any_has(lines, "10 % of the frames took longer than the 33.3 ms"));
  EXPECT_TRUE(any_has(lines, "Median depth is 20.00 m"));
  EXPECT_TRUE(any_has(lines, "2 maps that were not joined"));
}

TEST(RunWarnings, TellThatNothingCameOfIt) {
  RunRecord record;
  record.add(frame(0, TrackingStatus::initialising));
  EXPECT_TRUE(any_has(run_warnings(summary_of(record), record, {}), "Not one frame got a pose"));
}

TEST(StatusBands, EndWhereTheNextFrameBegins) {
  std::vector<TrackingResult> results;
  for (const TrackingStatus status : {TrackingStatus::ok, TrackingStatus::lost, TrackingStatus::lost,
                                      TrackingStatus::uncertain, TrackingStatus::ok, TrackingStatus::lost}) {
    results.push_back(frame(static_cast<int>(results.size()), status));
  }
  const std::vector<StatusBand> bands = status_bands(results);
  ASSERT_EQ(bands.size(), 3U);
  EXPECT_EQ(bands[0].frames, 2);
  EXPECT_EQ(bands[0].from, results[1].timestamp);
  EXPECT_EQ(bands[0].to, results[3].timestamp);
  EXPECT_EQ(bands[1].status, TrackingStatus::uncertain);
  EXPECT_EQ(bands[1].to, results[4].timestamp);
  EXPECT_EQ(bands[2].to, results[5].timestamp) << "nothing comes after it";
}

}  // namespace
}  // namespace stdc::app
