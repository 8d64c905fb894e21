#include "evaluation/trajectory_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/error.hpp"
#include "core/random.hpp"

namespace stdc {
namespace {

/// A smooth path in space at the given rate [Hz], starting at `start` [s].
Trajectory smooth_path(int count, double rate, double start = 1000) {
  Trajectory path;
  for (int i = 0; i < count; ++i) {
    const double t = i / rate;
    Vector6d twist;
    twist << std::sin(t), 0.5 * std::cos(0.7 * t), 0.1 * t, 0.3 * std::sin(0.5 * t), 0.2 * t, 0.1;
    path.push_back({start + t, Pose::exp(twist)});
  }
  return path;
}

Trajectory moved(const Pose& pose, Trajectory path) {
  for (StampedPose& stamped : path) stamped.world_from_cam = pose * stamped.world_from_cam;
  return path;
}

Pose some_pose() {
  Vector6d twist;
  twist << 3, -2, 5, 0.4, -1.2, 0.7;
  return Pose::exp(twist);
}

TEST(ScoreTrajectory, IsZeroForTheSamePathElsewhere) {
  const Trajectory truth = smooth_path(300, 30);
  const TrajectoryScores scores = score_trajectory(truth, moved(some_pose(), truth));
  EXPECT_EQ(scores.pairs, 300);
  EXPECT_LT(scores.ate.maximum, 1e-9);
  EXPECT_LT(scores.rpe_frame_translation.value().maximum, 1e-9);
  EXPECT_LT(scores.rpe_second_rotation.value().maximum, 1e-5);
  EXPECT_NEAR(scores.coverage.value(), 1, 1e-12);
  EXPECT_LT((scores.truth_from_estimate * some_pose()).log().norm(), 1e-9);
}

TEST(PoseErrors, AreThoseOfTheAte) {
  const Trajectory truth = smooth_path(90, 90);
  Trajectory estimate = moved(some_pose(), smooth_path(30, 30));
  estimate[7].world_from_cam.translation.x() += 0.01;
  estimate.push_back({5000, Pose()});  // of another time
  const TrajectoryScores scores = score_trajectory(truth, estimate);
  const std::vector<PoseError> errors = pose_errors(truth, estimate, scores.truth_from_estimate);
  ASSERT_EQ(static_cast<int>(errors.size()), scores.pairs);
  double squares = 0, largest = 0;
  for (const PoseError& error : errors) {
    squares += error.distance * error.distance;
    largest = std::max(largest, error.distance);
  }
  EXPECT_NEAR(std::sqrt(squares / scores.pairs), scores.ate.rmse, 1e-12);
  EXPECT_EQ(largest, scores.ate.maximum);
  EXPECT_EQ(errors[7].timestamp, estimate[7].timestamp);
  EXPECT_EQ(errors[7].distance, largest);
}

TEST(ScoreTrajectory, KnownErrorsGiveKnownScores) {
  // A straight true path; the estimate turns by 0.01 rad a frame where the truth does not.
  Trajectory truth, estimate;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d position(0.1 * i, 0, 0);
    truth.push_back({i * 0.05, Pose(Eigen::Quaterniond::Identity(), position)});
    estimate.push_back({i * 0.05, Pose(rotation_exp({0, 0, 0.01 * i}), position)});
  }
  const TrajectoryScores scores = score_trajectory(truth, estimate);
  EXPECT_LT(scores.ate.maximum, 1e-12);
  EXPECT_NEAR(scores.rpe_frame_rotation.value().rmse, 0.01 * 180 / M_PI, 1e-9);
  EXPECT_NEAR(scores.rpe_second_rotation.value().median, 0.20 * 180 / M_PI, 1e-9);
  // The step of 0.1 m is seen turned by 0.01 i: the chord of that angle is the error of frame i.
  EXPECT_NEAR(scores.rpe_frame_translation.value().maximum, 0.1 * 2 * std::sin(0.5 * 0.01 * 98), 1e-9);
}

TEST(ScoreTrajectory, AScaleThatIsOffIsFound) {
  const Trajectory truth = smooth_path(200, 30);
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate) {
    pose.world_from_cam = Pose(rotation_exp({0.3, -0.2, 0.9}), {1, 2, 3}) * pose.world_from_cam;
    pose.world_from_cam.translation *= 0.97;
  }
  const TrajectoryScores scores = score_trajectory(truth, estimate);
  EXPECT_NEAR(scores.scale.factor, 1 / 0.97, 1e-9);
  EXPECT_LT(scores.scale.ate_rmse, 1e-9);
  EXPECT_GT(scores.ate.rmse, 1e-3);
  EXPECT_TRUE(scores.scale.is_suspicious(scores.ate.rmse));
  EXPECT_FALSE(score_trajectory(truth, truth).scale.is_suspicious(0));
}

TEST(ScoreTrajectory, AScaleThatExplainsLittleIsNotSuspicious) {
  EXPECT_FALSE((ScaleFit{1.03, 0.009}.is_suspicious(0.010))) << "noise on a short path";
  EXPECT_FALSE((ScaleFit{1.005, 0.001}.is_suspicious(0.010))) << "within what an RGB-D camera may be off";
  EXPECT_TRUE((ScaleFit{0.98, 0.002}.is_suspicious(0.010)));
}

TEST(ScoreTrajectory, WhatRestsHasNoScale) {
  Trajectory truth;
  for (int i = 0; i < 10; ++i) truth.push_back({0.1 * i, Pose()});
  EXPECT_EQ(score_trajectory(truth, truth).scale.factor, 1);
}

TEST(ScoreTrajectory, StatisticsAreThoseOfTheErrors) {
  // Offsets of +e and -e along z in turn, on a path in a plane: alignment cannot take them away.
  Trajectory truth, estimate;
  for (int i = 0; i < 40; ++i) {
    const double angle = 2 * M_PI * (i / 2) / 20;
    const Eigen::Vector3d position(std::cos(angle), std::sin(angle), 0);
    const Eigen::Vector3d offset(0, 0, (i % 2 == 0 ? 1 : -1) * 0.1);
    truth.push_back({i * 0.1, Pose(Eigen::Quaterniond::Identity(), position)});
    estimate.push_back({i * 0.1, Pose(Eigen::Quaterniond::Identity(), position + offset)});
  }
  const TrajectoryScores scores = score_trajectory(truth, estimate);
  for (const double value : {scores.ate.rmse, scores.ate.mean, scores.ate.median, scores.ate.maximum}) {
    EXPECT_NEAR(value, 0.1, 1e-9);
  }
  EXPECT_NEAR(scores.rpe_frame_translation.value().rmse, 0.2, 1e-9);
}

TEST(ScoreTrajectory, PairsTheShorterWithTheNearestOfTheLonger) {
  const Trajectory truth = smooth_path(1000, 100);
  Trajectory estimate;
  for (std::size_t i = 2; i < truth.size(); i += 7) {
    estimate.push_back({truth[i].timestamp + 0.002, truth[i].world_from_cam});
  }
  estimate.push_back({truth.back().timestamp + 0.5, Pose()});
  const int expected = static_cast<int>(estimate.size()) - 1;
  for (const auto& scores : {score_trajectory(truth, estimate), score_trajectory(estimate, truth)}) {
    EXPECT_EQ(scores.pairs, expected);
    EXPECT_LT(scores.ate.maximum, 1e-9);
  }
}

TEST(ScoreTrajectory, CoverageIsOfTimeOrOfFrames) {
  const Trajectory truth = smooth_path(1001, 100);  // 10 s
  Trajectory estimate = smooth_path(301, 30);
  EXPECT_NEAR(score_trajectory(truth, estimate).coverage.value(), 1, 1e-9);
  estimate.erase(estimate.begin() + 60, estimate.begin() + 149);  // 1.967 s to 4.967 s
  EXPECT_NEAR(score_trajectory(truth, estimate).coverage.value(), 0.7, 1e-9);
  EXPECT_NEAR(score_trajectory(truth, estimate, 0.02, 424).coverage.value(), 0.5, 1e-9);
  const Trajectory keyframes = smooth_path(11, 1);
  EXPECT_NEAR(score_trajectory(truth, keyframes).coverage.value(), 1, 1e-9);
}

TEST(ScoreTrajectory, AGapIsNotOneSecond) {
  const Trajectory truth = smooth_path(600, 30);
  Trajectory estimate = truth;
  estimate.erase(estimate.begin() + 100, estimate.begin() + 400);
  // Steps that would end in the gap are left out: none of the rest has an error.
  EXPECT_LT(score_trajectory(truth, estimate).rpe_second_translation.value().maximum, 1e-9);
}

TEST(ScoreTrajectory, WithoutStepsOfASecondThereIsNoErrorPerSecond) {
  const Trajectory path = smooth_path(10, 30);
  const TrajectoryScores scores = score_trajectory(path, path);
  EXPECT_FALSE(scores.rpe_second_translation.has_value());
  EXPECT_FALSE(scores.rpe_second_rotation.has_value());
}

TEST(ScoreTrajectory, CoverageOfNothingIsNothing) {
  const Trajectory path = smooth_path(10, 30);
  EXPECT_FALSE(score_trajectory(path, path, 0.02, 0).coverage.has_value());
  Trajectory instant = path;  // poses of one moment have no duration
  for (StampedPose& pose : instant) pose.timestamp = path[0].timestamp;
  EXPECT_FALSE(score_trajectory(instant, instant).coverage.has_value());
  EXPECT_EQ(score_trajectory(path, instant).coverage, 0) << "a moment covers nothing of a duration";
}

TEST(ScoreTrajectory, RefusesWhatCannotBeScored) {
  const Trajectory truth = smooth_path(100, 30);
  EXPECT_THROW(score_trajectory(truth, {}), Error);
  EXPECT_THROW(score_trajectory({}, truth), Error);
  EXPECT_THROW(score_trajectory(truth, smooth_path(2, 30)), Error);
  EXPECT_NO_THROW(score_trajectory(truth, smooth_path(3, 30)));
  EXPECT_THROW(score_trajectory(truth, smooth_path(100, 30, 5000)), Error);
  Trajectory huge = truth;
  huge[5].world_from_cam.translation.x() = 1e300;
  EXPECT_THROW(score_trajectory(truth, huge), Error);
}

/// One row of the table of trajectories with published scores (made with evo 1.36.5).
struct KnownScores {
  const char* truth;
  const char* estimate;
  int pairs;
  double rmse, mean, median, maximum;      // [m]
  double step_translation, step_rotation;  // [m], [deg]
};

void PrintTo(const KnownScores& known, std::ostream* stream) { *stream << known.estimate; }

std::string name_of(const ::testing::TestParamInfo<KnownScores>& info) {
  return std::filesystem::path(info.param.estimate).stem().string();
}

class KnownTrajectories : public ::testing::TestWithParam<KnownScores> {};

TEST_P(KnownTrajectories, AgreeWithEvoToSixDigits) {
  const std::filesystem::path folder = std::filesystem::path(STDC_SHARED_DATA) / "trajectories";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
  const KnownScores& known = GetParam();
  const TrajectoryScores scores =
      score_trajectory(read_trajectory(folder / known.truth), read_trajectory(folder / known.estimate));
  constexpr double kHalfDigit = 0.5001e-6;
  EXPECT_EQ(scores.pairs, known.pairs);
  EXPECT_NEAR(scores.ate.rmse, known.rmse, kHalfDigit);
  EXPECT_NEAR(scores.ate.mean, known.mean, kHalfDigit);
  EXPECT_NEAR(scores.ate.median, known.median, kHalfDigit);
  EXPECT_NEAR(scores.ate.maximum, known.maximum, kHalfDigit);
  EXPECT_NEAR(scores.rpe_frame_translation.value().rmse, known.step_translation, kHalfDigit);
  EXPECT_NEAR(scores.rpe_frame_rotation.value().rmse, known.step_rotation, kHalfDigit);
}

INSTANTIATE_TEST_SUITE_P(
    Shared, KnownTrajectories,
    ::testing::Values(KnownScores{"fr3_walking_xyz_groundtruth.txt", "fr3_walking_xyz_estimate.txt", 757,
                                  0.016314, 0.013869, 0.012152, 0.057244, 0.012524, 0.398250},
                      KnownScores{"fr3_sitting_static_groundtruth.txt", "fr3_sitting_static_estimate.txt",
                                  557, 0.006368, 0.005611, 0.005116, 0.022002, 0.005397, 0.157454},
                      KnownScores{"fr1_xyz_groundtruth.txt", "fr1_xyz_rgbdslam_estimate.txt", 786, 0.013473,
                                  0.012029, 0.011176, 0.034727, 0.005759, 0.352827}),
    name_of);

}  // namespace
}  // namespace stdc
