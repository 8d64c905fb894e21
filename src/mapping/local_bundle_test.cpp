#include "mapping/local_bundle.hpp"

#include <gtest/gtest.h>

#include "core/test_bytes.hpp"
#include "mapping/test_keyframes.hpp"

namespace stdc {
namespace {

using test::same_bytes;

/// Six keyframes of a room whose poses and landmarks are off by a centimetre or so.
class LocalBundle : public ::testing::Test {
 protected:
  LocalBundle() : mapped(test::Scene(350)) {
    noise.pixel_sigma = 0.5;
    noise.inverse_depth_sigma = 0.004;
    for (int k = 0; k < 6; ++k) {
      test::ViewOptions options;
      options.pixel_noise = 0.2;
      options.depth_noise = 0.0015;
      options.seed = 20 + k;
      mapped.add(mapped.scene.look(test::camera_at(0.12 * k, 0.04 * (k % 3), 0.03 * k, 0.01 * k, -0.03 * k),
                                   options));
    }
  }
  void disturb(std::uint32_t first_keyframe) {
    Random random(8);
    const auto normal3 = [&](double sigma) {
      const double x = random.normal(), y = random.normal(), z = random.normal();
      return Eigen::Vector3d(sigma * Eigen::Vector3d(x, y, z));
    };
    for (std::uint32_t k = first_keyframe; k < 6; ++k) {
      Vector6d twist;
      twist << normal3(0.01), normal3(0.005);
      mapped.atlas.set_pose({k}, Pose::exp(twist) * mapped.views[k].cam_from_world);
    }
    for (const LandmarkId id : mapped.atlas.landmark_ids())
      mapped.atlas.set_position(id, mapped.atlas.landmark(id).position + normal3(0.02));
  }
  LocalBundleReport adjust(std::uint32_t keyframe) {
    return adjust_locally(mapped.atlas, {keyframe}, {mapped.scene.camera, noise}, {}, settings);
  }
  double pose_error(std::uint32_t k) const {
    return test::centre_error(mapped.atlas.keyframe({k}).cam_from_world, mapped.views[k].cam_from_world);
  }
  double median_point_error() const {
    std::vector<double> errors;
    for (const LandmarkId id : mapped.atlas.landmark_ids()) {
      const Landmark& landmark = mapped.atlas.landmark(id);
      const int point = test::point_seen(mapped, landmark.observations.front());
      errors.push_back((landmark.position - mapped.scene.points[point].position).norm());
    }
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2),
                     errors.end());
    return errors[errors.size() / 2];
  }

  test::MappedScene mapped;
  NoiseSettings noise;
  MappingSettings settings;
};

TEST_F(LocalBundle, BringsPosesAndPointsBack) {
  disturb(1);
  const LocalBundleReport report = adjust(5);
  EXPECT_EQ(report.keyframes, 6);
  EXPECT_EQ(report.fixed_keyframes, 0);
  EXPECT_EQ(report.landmarks, mapped.atlas.landmark_count());
  for (std::uint32_t k = 1; k < 6; ++k) {
    EXPECT_LT(pose_error(k), 0.006);
    EXPECT_LT(test::angle_error(mapped.atlas.keyframe({k}).cam_from_world, mapped.views[k].cam_from_world),
              0.002);
  }
  EXPECT_LT(median_point_error(), 0.012);
  test::expect_consistent(mapped.atlas);
}

TEST_F(LocalBundle, TheFirstKeyframeIsTheWorld) {
  const Pose before = mapped.atlas.keyframe({0}).cam_from_world;
  disturb(1);
  adjust(0);
  EXPECT_TRUE(same_bytes(before, mapped.atlas.keyframe({0}).cam_from_world));
  EXPECT_LT(pose_error(3), 0.006);
}

TEST_F(LocalBundle, HoldsTheOutsideKeyframesFixed) {
  settings.bundle_keyframes = 3;
  disturb(0);
  std::vector<std::uint32_t> moving{5};
  for (int n = 0; n < 2; ++n) moving.push_back(mapped.atlas.keyframe({5}).covisible[n].keyframe.value);
  for (const std::uint32_t k : {0, 1, 2, 3, 4, 5}) {  // those that hold it stand where they should
    if (std::find(moving.begin(), moving.end(), k) == moving.end())
      mapped.atlas.set_pose({k}, mapped.views[k].cam_from_world);
  }
  std::vector<Pose> before;
  for (std::uint32_t k = 0; k < 6; ++k) before.push_back(mapped.atlas.keyframe({k}).cam_from_world);
  const LocalBundleReport report = adjust(5);
  EXPECT_EQ(report.keyframes, 3);
  EXPECT_EQ(report.fixed_keyframes, 3);
  for (std::uint32_t k = 0; k < 6; ++k) {
    const bool moves = std::find(moving.begin(), moving.end(), k) != moving.end();
    EXPECT_EQ(same_bytes(before[k], mapped.atlas.keyframe({k}).cam_from_world), !moves);
    EXPECT_LT(pose_error(k), 0.006);
  }
}

TEST_F(LocalBundle, UsesNoMoreFixedKeyframesThanWanted) {
  settings.bundle_keyframes = 2;
  settings.bundle_fixed_keyframes = 1;
  EXPECT_EQ(adjust(5).fixed_keyframes, 1);
}

TEST_F(LocalBundle, TakesOutliersOutOfTheMap) {
  disturb(1);
  std::vector<LandmarkId> wrong;
  for (int i = 0; i < mapped.views[4].features->size(); i += 12) {
    const LandmarkId id = mapped.atlas.keyframe({4}).landmarks[i];
    if (mapped.atlas.landmark(id).observations.size() < 4) continue;
    Measurement measurement = mapped.atlas.keyframe({4}).measurements[i];
    measurement.pixel += Eigen::Vector2f(18, -12);
    mapped.atlas.set_measurement({4}, i, measurement);
    wrong.push_back(id);
  }
  ASSERT_GT(wrong.size(), 8U);
  const LocalBundleReport report = adjust(5);
  EXPECT_GE(report.outliers, static_cast<int>(wrong.size()));
  for (const LandmarkId id : wrong) {
    ASSERT_TRUE(mapped.atlas.has(id));
    EXPECT_EQ(mapped.atlas.keypoint_of(id, {4}), -1);
  }
  test::expect_consistent(mapped.atlas);
  EXPECT_LT(pose_error(4), 0.006);
  EXPECT_LT(report.outliers, 0.12 * report.observations)
      << "5 % of the good ones lie beyond the 95 % quantile";
}

TEST_F(LocalBundle, RefreshesWhatItMoved) {
  disturb(1);
  adjust(5);
  for (const LandmarkId id : mapped.atlas.landmark_ids()) {
    const Landmark& landmark = mapped.atlas.landmark(id);
    const Observation& oldest = landmark.observations.front();
    const Keyframe& anchor = mapped.atlas.keyframe(oldest.keyframe);
    const double distance = (landmark.position - anchor.cam_from_world.centre()).norm();
    EXPECT_NEAR(landmark.max_distance, distance * anchor.features->scale_of(oldest.keypoint), 1e-4);
  }
}

TEST_F(LocalBundle, NothingToAdjustLeavesTheMapAsItWas) {
  test::MappedScene lonely(test::Scene(30));
  lonely.add_bare(lonely.scene.look(Pose()));
  lonely.add_bare(lonely.scene.look(test::camera_at(0.1, 0, 0)));
  const LocalBundleReport report =
      adjust_locally(lonely.atlas, {1}, {lonely.scene.camera, noise}, {}, settings);
  EXPECT_EQ(report.observations, 0);
  EXPECT_TRUE(same_bytes(lonely.atlas.keyframe({1}).cam_from_world, lonely.views[1].cam_from_world));
}

}  // namespace
}  // namespace stdc
