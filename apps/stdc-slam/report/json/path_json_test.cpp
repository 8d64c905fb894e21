#include "report/json/path_json.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

namespace stdc::app {
namespace {

/// A camera that moves along z of its first view, 1 cm a frame, with a gap of a second.
Trajectory walk() {
  Trajectory path;
  for (int i = 0; i < 20; ++i) {
    path.push_back(
        {100 + i / 30.0 + (i >= 10 ? 1 : 0), Pose(Eigen::Quaterniond::Identity(), {0.1, 0.2, 0.01 * i})});
  }
  return path;
}

TEST(PathJson, WithoutATruthTheFirstCameraSaysWhatIsUp) {
  ReportPaths paths;
  paths.estimate = walk();
  paths.landmarks = {{1, 2, 3}};
  nlohmann::ordered_json run;
  add_paths(run, paths, 100);
  EXPECT_EQ(run["axes"]["x"], "x");
  EXPECT_EQ(run["axes"]["y"], "z");
  EXPECT_EQ(run["axes"]["z"], "-y");
  EXPECT_EQ(run["trajectory"]["z"][0], -0.2);
  EXPECT_EQ(run["trajectory"]["y"][1], 0.01);
  EXPECT_EQ(run["landmarks"]["y"][0], 3);
  EXPECT_FALSE(run.contains("truth"));
  EXPECT_NEAR(run["length_m"], 0.18, 1e-9) << "what happened in the gap is not known";
}

TEST(PathJson, LinesBreakInGaps) {
  ReportPaths paths;
  paths.estimate = walk();
  paths.keyframes = {paths.estimate[0], paths.estimate[15]};
  nlohmann::ordered_json run;
  add_paths(run, paths, 100);
  EXPECT_EQ(run["trajectory"]["x"].size(), 21U);
  EXPECT_TRUE(run["trajectory"]["x"][10].is_null());
  EXPECT_EQ(run["keyframes"]["x"].size(), 2U) << "dots need no break";
}

TEST(PathJson, TheTruthsFrameIsTurnedSoThatTheCameraIsUpright) {
  ReportPaths paths;
  paths.estimate = walk();
  // The estimate's -y is the truth's x.
  Eigen::Matrix3d rotation;
  rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  paths.truth_from_estimate = Pose(rotation, Eigen::Vector3d(5, 0, 0));
  for (const StampedPose& pose : paths.estimate) {
    paths.truth.push_back({pose.timestamp, *paths.truth_from_estimate * pose.world_from_cam});
  }
  paths.truth.push_back({500, Pose()});  // of another time
  for (const StampedPose& pose : paths.estimate) paths.errors.push_back({pose.timestamp, 0.002});
  nlohmann::ordered_json run;
  add_paths(run, paths, 100);
  EXPECT_EQ(run["axes"]["z"], "x");
  EXPECT_EQ(run["trajectory"]["z"][0], 4.8);
  EXPECT_EQ(run["trajectory"]["x"], run["truth"]["x"]);
  EXPECT_EQ(run["trajectory"]["y"], run["truth"]["y"]);
  EXPECT_EQ(run["trajectory"]["error_mm"][0], 2);
  EXPECT_TRUE(run["trajectory"]["error_mm"][10].is_null());
}

TEST(PathJson, ACameraThatHardlyMovesIsUprightAsTheTruthHasIt) {
  ReportPaths paths;
  for (int i = 0; i < 10; ++i) {
    paths.estimate.push_back({i / 30.0, Pose(Eigen::Quaterniond::Identity(), {0.0001 * i, 0, 0})});
    // A level camera in a world whose z is up.
    Eigen::Matrix3d level;
    level << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    paths.truth.push_back({i / 30.0, Pose(Eigen::Quaterniond(level), {0.0001 * i, 0, 1.5})});
  }
  paths.truth_from_estimate =
      Pose(Eigen::Quaterniond(Eigen::AngleAxisd(1.2, Eigen::Vector3d::UnitX())), {0, 0, 1.5});
  nlohmann::ordered_json run;
  add_paths(run, paths, 0);
  EXPECT_EQ(run["axes"]["z"], "z");
}

TEST(PathJson, ACameraOnItsSideIsTurned) {
  ReportPaths paths;
  paths.estimate = walk();
  for (const auto& [rotation, up] : {std::pair(90, "-x"), std::pair(180, "y"), std::pair(270, "x")}) {
    paths.rotation = rotation;
    nlohmann::ordered_json run;
    add_paths(run, paths, 100);
    EXPECT_EQ(run["axes"]["z"], up);
  }
}

TEST(PathJson, TakesWhatHasNoPose) {
  nlohmann::ordered_json run;
  add_paths(run, {}, 0);
  EXPECT_EQ(run["trajectory"]["x"].size(), 0U);
}

}  // namespace
}  // namespace stdc::app
