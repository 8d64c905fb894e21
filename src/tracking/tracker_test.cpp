#include "tracking/tracker.hpp"

#include <gtest/gtest.h>

#include "tracking/keyframe_policy.hpp"
#include "tracking/test_frames.hpp"

namespace stdc {
namespace {

/// A tracker that has tracked two frames of a moving camera before a mapped room.
class TrackerTest : public ::testing::Test {
 protected:
  explicit TrackerTest(double readout_time = 0) : mapped(test::Scene(400)) {
    mapped.scene.camera.readout_time = readout_time;
    mapped.add(mapped.scene.look(test::camera_at(0, 0, 0)));
    mapped.add(mapped.scene.look(test::camera_at(0.3, 0, 0)));
    local = make_local_map(mapped.atlas, mapped.landmarks, {0}, 10);
    pyramid->build(cv::Mat(480, 640, CV_8UC1, cv::Scalar(128)), test::scene_feature_settings());
    velocity << -0.6, 0.15, -0.2, 0.1, -0.3, 0.2;
    tracker.emplace(PoseEstimator{{mapped.scene.camera, {}}, {}}, settings);
  }
  /// The camera's pose at a frame when it keeps its velocity.
  Pose truth(int index) const { return Pose::exp(velocity * (index / 30.0)) * test::camera_at(0.05, 0, 0); }
  test::View look(const Pose& pose, int index, bool depth = true) const {
    test::ViewOptions options;
    options.pixel_noise = 0.4;
    options.depth_noise = 0.004;
    options.depth = depth;
    options.twist = velocity;
    options.seed = 100 + index;
    return mapped.scene.look(pose, options);
  }
  TrackedFrame new_frame(const test::View& view, int index) const {
    return {mapped.scene.camera, index, index / 30.0, view.features, pyramid};
  }
  void remember_true(int index) {
    tracker->remember(test::tracked_frame(mapped, look(truth(index), index), index), local.reference,
                      local.reference_from_world);
  }
  void begin() {
    remember_true(0);
    remember_true(1);
  }
  int count_wrong(const TrackedFrame& frame, const test::View& view) const {
    int wrong = 0;
    for (int i = 0; i < view.features->size(); ++i)
      wrong += frame.landmarks[i].valid() && frame.landmarks[i] != mapped.landmarks[view.points[i]] ? 1 : 0;
    return wrong;
  }

  test::MappedScene mapped;
  LocalMap local;
  std::shared_ptr<Pyramid> pyramid = std::make_shared<Pyramid>();
  Vector6d velocity;
  TrackingSettings settings;
  std::optional<Tracker> tracker;
};

class RollingTrackerTest : public TrackerTest {
 protected:
  RollingTrackerTest() : TrackerTest(0.03) {}
};

TEST_F(TrackerTest, FollowsACameraThatKeepsItsVelocity) {
  begin();
  for (int index = 2; index < 8; ++index) {
    const test::View view = look(truth(index), index);
    TrackedFrame frame = new_frame(view, index);
    ASSERT_TRUE(tracker->track(frame, local).tracked);
    EXPECT_LT(test::centre_error(frame.cam_from_world, truth(index)), 0.005);
    EXPECT_LT(test::angle_error(frame.cam_from_world, truth(index)), 0.002);
    EXPECT_EQ(count_wrong(frame, view), 0);
    EXPECT_GT(frame.inliers, 100);
    EXPECT_GE(frame.matches, frame.inliers);
    tracker->remember(frame, local.reference, local.reference_from_world);
  }
}

TEST_F(RollingTrackerTest, FollowsThroughARollingShutter) {
  begin();
  for (int index = 2; index < 6; ++index) {
    TrackedFrame frame = new_frame(look(truth(index), index), index);
    ASSERT_TRUE(tracker->track(frame, local).tracked);
    EXPECT_LT(test::centre_error(frame.cam_from_world, truth(index)), 0.006);
    EXPECT_LT(test::angle_error(frame.cam_from_world, truth(index)), 0.003);
    EXPECT_LT((frame.motion.twist - velocity).norm(), 0.25);
    tracker->remember(frame, local.reference, local.reference_from_world);
  }
}

TEST_F(TrackerTest, AJerkIsFoundByLookingFurther) {
  begin();
  // 25 px beside where the constant velocity puts it.
  const Pose jerked = Pose(rotation_exp({0.01, 0.045, 0}), Eigen::Vector3d(0.01, 0, 0)) * truth(2);
  const test::View view = look(jerked, 2);
  TrackedFrame frame = new_frame(view, 2);
  ASSERT_TRUE(tracker->track(frame, local).tracked);
  EXPECT_LT(test::centre_error(frame.cam_from_world, jerked), 0.01);
  EXPECT_EQ(count_wrong(frame, view), 0);
}

TEST_F(TrackerTest, TellsHowFarAPoseIsFromWhereItsVelocityTookIt) {
  begin();
  TrackedFrame steady = new_frame(look(truth(2), 2), 2);
  ASSERT_TRUE(tracker->track(steady, local).tracked);
  EXPECT_LT(steady.jump, 1.5);
  const Pose jumped = Pose(Eigen::Quaterniond::Identity(), {0.05, 0, 0}) * truth(2);
  TrackedFrame frame = new_frame(look(jumped, 2), 2);
  ASSERT_TRUE(tracker->track(frame, local).tracked);
  EXPECT_GT(frame.jump, 4.5) << "0.05 m are 7 sigmas; the prior holds a fifth of them back";
  EXPECT_LT(frame.jump, 7.5);
}

TEST_F(TrackerTest, ALeapIsFoundByTheReferenceKeyframe) {
  remember_true(0);  // no velocity yet, hence no prior that would hold it back
  const Pose leapt = test::camera_at(0.15, 0.05, 0.1, 0.05, -0.25, 0.1);
  TrackedFrame frame = new_frame(look(leapt, 1), 1);
  ASSERT_TRUE(tracker->track(frame, local).tracked);
  EXPECT_LT(test::centre_error(frame.cam_from_world, leapt), 0.01);
}

TEST_F(TrackerTest, IsLostWhereNothingMatches) {
  begin();
  const test::Scene foreign(400, false, 99);
  TrackedFrame frame = new_frame(foreign.look(truth(2)), 2);
  EXPECT_FALSE(tracker->track(frame, local).tracked);
  TrackedFrame empty(
      mapped.scene.camera, 3, 0.1,
      std::make_shared<FrameFeatures>(mapped.scene.camera, Features(), cv::Mat(), 1.2, 6, nullptr));
  EXPECT_FALSE(tracker->track(empty, local).tracked);
  EXPECT_TRUE(tracker->has_last()) << "it is for the caller to forget";
  tracker->clear_last();
  EXPECT_FALSE(tracker->has_last());
}

TEST_F(TrackerTest, ThePriorDecidesWhereAFrameShowsLittle) {
  // Twenty keypoints of the wall alone and no depth: they hardly tell a shift from a turn.
  const auto error_with = [&](double acceleration_sigma, double angular_sigma) {
    settings.acceleration_sigma = acceleration_sigma;
    settings.angular_acceleration_sigma = angular_sigma;
    settings.min_inliers = 12;
    tracker.emplace(PoseEstimator{{mapped.scene.camera, {}}, {}}, settings);
    begin();
    double sum = 0;
    for (int trial = 0; trial < 6; ++trial) {
      test::Scene poor = mapped.scene;
      std::erase_if(poor.points, [n = 0](const test::ScenePoint& p) mutable {
        return p.position.z() < 2.99 || std::abs(p.position.x()) > 0.6 || n++ >= 24;
      });
      test::ViewOptions options;
      options.pixel_noise = 1;
      options.depth = false;
      options.seed = 50 + trial;
      TrackedFrame frame = new_frame(poor.look(truth(2), options), 2);
      EXPECT_TRUE(tracker->track(frame, local).tracked);
      sum += test::centre_error(frame.cam_from_world, truth(2));
    }
    return sum / 6;
  };
  const double with_prior = error_with(1, 5), without = error_with(1e4, 1e4);
  EXPECT_LT(with_prior, 0.003);
  EXPECT_LT(with_prior, 0.5 * without);
}

TEST_F(TrackerTest, LandmarksDisplaceTemporaryPoints) {
  // The last frame saw every second point, few of them as landmarks; the local map has all.
  settings.initial_landmarks = 30;
  tracker.emplace(PoseEstimator{{mapped.scene.camera, {}}, {}}, settings);
  begin();
  test::Scene sparse = mapped.scene;
  for (std::size_t p = 1; p < sparse.points.size(); p += 2) sparse.points[p].position.z() = -5;
  TrackedFrame last = test::tracked_frame(mapped, sparse.look(truth(1)), 1);
  for (std::size_t i = 10; i < last.landmarks.size(); ++i) last.landmarks[i] = {};
  tracker->remember(last, local.reference, local.reference_from_world);
  TrackedFrame frame = new_frame(look(truth(2), 2), 2);
  ASSERT_TRUE(tracker->track(frame, local).tracked);
  const auto seen =
      std::count_if(frame.landmarks.begin(), frame.landmarks.end(), [](auto id) { return id.valid(); });
  EXPECT_EQ(seen, frame.inliers) << "no temporary point is left";
}

TEST_F(TrackerTest, OutliersAreNotedAndNotObserved) {
  begin();
  test::Scene moved = mapped.scene;  // every eighth point has gone a little way
  for (std::size_t p = 0; p < moved.points.size(); p += 8) moved.points[p].position.x() += 0.03;
  const test::View view = moved.look(truth(2));
  TrackedFrame frame = new_frame(view, 2);
  ASSERT_TRUE(tracker->track(frame, local).tracked);
  EXPECT_LT(test::centre_error(frame.cam_from_world, truth(2)), 0.005);
  int refused = 0;
  for (int i = 0; i < view.features->size(); ++i) {
    EXPECT_FALSE(frame.outlier[i] != 0 && frame.landmarks[i].valid());
    refused += frame.outlier[i] != 0 && view.points[i] % 8 == 0 ? 1 : 0;
  }
  EXPECT_GT(refused, 5);
}

TEST_F(TrackerTest, OlderLandmarksAreFollowedOrSaidToPutTheCameraElsewhere) {
  // Every fifth point has been in the map for seconds, the others entered it last and have moved since, not
  // so far that the older ones are no longer found.
  for (const double step : {0.0, 0.025, 0.03, 0.035}) {
    begin();
    tracker->set_wary(true);
    local.reference_views[0].timestamp = -5;
    local.reference_views[1].timestamp = 0;
    for (LocalLandmark& landmark : local.landmarks)
      landmark.view = test::point_of(mapped, landmark.id) % 5 == 0 ? 0 : 1;
    test::Scene moved = mapped.scene;
    for (std::size_t p = 0; p < moved.points.size(); ++p)
      moved.points[p].position.x() += p % 5 == 0 ? 0 : step;
    TrackedFrame frame = new_frame(moved.look(truth(2)), 2);
    ASSERT_TRUE(tracker->track(frame, local).tracked);
    if (step == 0) {
      EXPECT_EQ(frame.old_offset, 0);
    }
    const double error = test::centre_error(frame.cam_from_world, truth(2));
    EXPECT_TRUE(error < 0.01 || frame.old_offset > 0.02) << step << ": " << error << ", " << frame.old_offset;
  }
}

TEST_F(TrackerTest, CountsAreGivenToTheMapOnce) {
  begin();
  TrackedFrame frame = new_frame(look(truth(2), 2), 2);
  ASSERT_TRUE(tracker->track(frame, local).tracked);
  LandmarkId found, gone;
  for (const LandmarkId id : frame.landmarks) {
    if (id.valid()) (found.valid() ? gone : found) = id;
  }
  mapped.atlas.remove(gone);
  tracker->flush_counts(mapped.atlas);
  EXPECT_EQ(mapped.atlas.landmark(found).visible, 1);
  EXPECT_EQ(mapped.atlas.landmark(found).found, 1);
  int sum = 0;
  for (const LandmarkId id : mapped.atlas.landmark_ids()) {
    sum += mapped.atlas.landmark(id).found;
    EXPECT_LE(mapped.atlas.landmark(id).found, mapped.atlas.landmark(id).visible);
  }
  EXPECT_EQ(sum, frame.inliers - 1) << "one of them is gone";
  tracker->flush_counts(mapped.atlas);
  EXPECT_EQ(mapped.atlas.landmark(found).visible, 1);
}

TEST_F(TrackerTest, TheLastFrameFollowsItsKeyframe) {
  tracker->follow(mapped.atlas);  // nothing to move yet
  begin();
  const KeyframeId reference = local.reference;
  Atlas& atlas = mapped.atlas;
  const Pose relative = truth(1) * atlas.keyframe(reference).cam_from_world.inverse();
  atlas.set_pose(reference, test::camera_at(0.02, 0.01, -0.01, 0.01, 0.02, 0));
  tracker->follow(atlas);
  const Pose expected = relative * atlas.keyframe(reference).cam_from_world;
  EXPECT_LT(test::centre_error(tracker->last().cam_from_world, expected), 1e-9);
  // The keyframe is removed and what is left moves on.
  const KeyframeId third = mapped.add(look(truth(1), 1));
  tracker->remember(test::tracked_frame(mapped, look(truth(1), 1), 1), third, truth(1));
  atlas.remove(third);
  const KeyframeId kept = atlas.resolve(third).keyframe;
  const Pose from_kept = truth(1) * atlas.keyframe(kept).cam_from_world.inverse();
  atlas.set_pose(kept, test::camera_at(-0.05, 0, 0.03, 0, 0.05, 0));
  tracker->follow(atlas);
  EXPECT_LT(
      test::centre_error(tracker->last().cam_from_world, from_kept * atlas.keyframe(kept).cam_from_world),
      1e-9);
}

}  // namespace
}  // namespace stdc
