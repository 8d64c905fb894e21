#include "tracking/moving_groups.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <numeric>

#include "core/random.hpp"

namespace stdc {
namespace {

/// A wall 3 m away seen all over the image, and twelve points of a box 1 m away, all seen from the origin
/// with a third of a pixel of noise. The pose and its information are those of the wall and the box.
struct WallAndBox {
  static constexpr int kWall = 300, kBox = 12;
  SensorModel sensor;
  TrackedFrame frame;
  std::vector<FrameMatch> matches;
  GroupNoise noise;

  /// @param shift  by which the box is seen elsewhere than the map has it [px]
  explicit WallAndBox(const Eigen::Vector2f& shift) {
    Random random(3);
    for (int i = 0; i < kWall; ++i) {
      see({random.uniform(20, 620), random.uniform(20, 460)}, 3, Eigen::Vector2f::Zero(), random);
    }
    for (int i = 0; i < kBox; ++i) {
      see({random.uniform(340, 420), random.uniform(200, 280)}, 1, shift, random);
    }
    frame.motion = CameraMotion(sensor.camera, Vector6d::Zero());
    const PoseOptimisationResult found =
        PoseEstimator{sensor, {}}.estimate(make_observations(frame, matches), frame.cam_from_world);
    frame.information = found.information;
  }
  void see(const Eigen::Vector2d& pixel, double z, const Eigen::Vector2f& shift, Random& random) {
    FrameMatch match;
    match.keypoint = static_cast<int>(matches.size());
    match.landmark = match.keypoint;
    match.position = sensor.camera.unproject(pixel, z);
    Measurement measurement;
    const Eigen::Vector2f error(static_cast<float>(random.normal()), static_cast<float>(random.normal()));
    measurement.pixel = pixel.cast<float>() + shift + 0.3F * error;
    measurement.seen = measurement.pixel;
    measurement.depth = static_cast<float>(z);
    frame.measurements.push_back(measurement);
    matches.push_back(match);
  }
  /// What a pose from the wall alone would be known by.
  Matrix6d covariance_of_wall() const {
    const std::vector<FrameMatch> wall(matches.begin(), matches.begin() + kWall);
    return PoseEstimator{sensor, {}}
        .estimate(make_observations(frame, wall), frame.cam_from_world)
        .information.inverse();
  }
  std::vector<FrameMatch> box() const { return {matches.end() - kBox, matches.end()}; }
};

/// How many of the wall and of the box are marked.
std::pair<int, int> marked(const std::vector<std::uint8_t>& moving) {
  const auto box = moving.end() - WallAndBox::kBox;
  return {std::accumulate(moving.begin(), box, 0), std::accumulate(box, moving.end(), 0)};
}

TEST(MovingGroups, NothingMoves) {
  WallAndBox scene(Eigen::Vector2f::Zero());
  EXPECT_EQ(marked(find_moving_groups(scene.sensor, scene.frame, scene.matches, scene.noise)),
            std::pair(0, 0));
}

TEST(MovingGroups, ABoxThatMovesByLessThanTheGateOfOneMatch) {
  WallAndBox scene(Eigen::Vector2f(2.5F, -1.5F));
  EXPECT_EQ(marked(find_moving_groups(scene.sensor, scene.frame, scene.matches, scene.noise)),
            std::pair(0, WallAndBox::kBox));
}

TEST(MovingGroups, WhoMovesCannotBeToldWhereMostOfTheMatchesWould) {
  WallAndBox scene(Eigen::Vector2f(2.5F, -1.5F));
  scene.matches.erase(scene.matches.begin(), scene.matches.end() - WallAndBox::kBox - 8);
  const std::vector<std::uint8_t> moving =
      find_moving_groups(scene.sensor, scene.frame, scene.matches, scene.noise);
  EXPECT_EQ(std::accumulate(moving.begin(), moving.end(), 0), 0);
}

TEST(MovingGroups, WithoutInformationNothingIsSaid) {
  WallAndBox scene(Eigen::Vector2f(2.5F, -1.5F));
  scene.frame.information.setZero();
  EXPECT_EQ(marked(find_moving_groups(scene.sensor, scene.frame, scene.matches, scene.noise)),
            std::pair(0, 0));
}

TEST(MovingGroups, InAQuietRecordingAMotionOfLessThanAPixelIsFoundInItsSecondFrame) {
  WallAndBox scene(Eigen::Vector2f::Zero());
  scene.frame.timestamp = 3;
  std::vector<std::uint8_t> moved;  // a picture on the wall, a tenth of it
  for (Measurement& measurement : scene.frame.measurements) {
    const bool inside = measurement.pixel.x() > 100 && measurement.pixel.x() < 230 &&
                        measurement.pixel.y() > 100 && measurement.pixel.y() < 230;
    moved.push_back(inside ? 1 : 0);
    if (inside) measurement.pixel += Eigen::Vector2f(0.8F, 0.4F);
  }
  const auto found = [&] {
    return find_moving_groups(scene.sensor, scene.frame, scene.matches, scene.noise);
  };
  EXPECT_EQ(marked(found()), std::pair(0, 0)) << "nothing is known of the recording";
  scene.noise.clear();
  for (int i = 0; i < 90; ++i) scene.noise.add(i / 30.0, 0.05);
  EXPECT_EQ(marked(found()), std::pair(0, 0)) << "it may be an error of this frame";
  scene.frame.timestamp += 1 / 30.0;
  const std::vector<std::uint8_t> marks = found();
  int right = 0;
  for (std::size_t i = 0; i < marks.size(); ++i) right += marks[i] & moved[i];
  EXPECT_GT(right, 0.7 * std::accumulate(moved.begin(), moved.end(), 0));
  EXPECT_GT(right, 0.4 * std::accumulate(marks.begin(), marks.end(), 0)) << "groups reach beyond its edge";
}

TEST(ContradictingGroups, AgreeWithAPoseFoundWithoutThem) {
  WallAndBox scene(Eigen::Vector2f::Zero());
  const auto found =
      find_contradicting_groups(scene.sensor, scene.frame, scene.covariance_of_wall(), scene.box());
  EXPECT_TRUE(std::ranges::all_of(found, [](Contradiction c) { return c == Contradiction::none; }));
}

TEST(ContradictingGroups, TheFartherOffTheSurer) {
  const auto degree = [](float shift) {
    WallAndBox scene(Eigen::Vector2f(shift, 0));
    const auto found =
        find_contradicting_groups(scene.sensor, scene.frame, scene.covariance_of_wall(), scene.box());
    EXPECT_EQ(std::ranges::count(found, found.front()), WallAndBox::kBox) << "the box is one thing";
    return found.front();
  };
  EXPECT_EQ(degree(1.0F), Contradiction::none);
  EXPECT_EQ(degree(2.6F), Contradiction::likely);
  EXPECT_EQ(degree(4.0F), Contradiction::sure);
}

TEST(ContradictingGroups, WhatFewSayOrAPoseThatIsHardlyKnownContradictsNothing) {
  WallAndBox scene(Eigen::Vector2f(4.0F, 0));
  const auto none = [&](const Matrix6d& covariance, const std::vector<FrameMatch>& matches) {
    const auto found = find_contradicting_groups(scene.sensor, scene.frame, covariance, matches);
    return std::ranges::all_of(found, [](Contradiction c) { return c == Contradiction::none; });
  };
  std::vector<FrameMatch> four = scene.box();
  four.resize(4);
  EXPECT_TRUE(none(scene.covariance_of_wall(), four));
  EXPECT_TRUE(none(Matrix6d::Identity() * 1e-3, scene.box()));
}

TEST(ContradictingGroups, AFewWrongMatchesAmongThemDoNotCount) {
  WallAndBox scene(Eigen::Vector2f::Zero());
  for (int i = 0; i < 4; ++i) {
    scene.frame.measurements[static_cast<std::size_t>(WallAndBox::kWall + i)].pixel.x() += 30;
  }
  const auto found =
      find_contradicting_groups(scene.sensor, scene.frame, scene.covariance_of_wall(), scene.box());
  EXPECT_TRUE(std::ranges::all_of(found, [](Contradiction c) { return c == Contradiction::none; }));
}

}  // namespace
}  // namespace stdc
