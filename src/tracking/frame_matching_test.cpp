#include "tracking/frame_matching.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tracking/test_frames.hpp"

namespace stdc {
namespace {

Vector6d brisk_twist() {
  Vector6d twist;
  twist << 0.4, -0.2, 0.25, 0.5, -0.8, 0.6;
  return twist;
}

/// A map of two keyframes and a view between them.
struct Between {
  test::MappedScene mapped;
  test::View last, now;
  LocalMap local;
  TrackingSettings settings;

  explicit Between(double readout_time = 0, int points = 400) : mapped(test::Scene(points)) {
    mapped.scene.camera.readout_time = readout_time;
    mapped.add(mapped.scene.look(test::camera_at(0, 0, 0)));
    mapped.add(mapped.scene.look(test::camera_at(0.4, 0, 0)));
    test::ViewOptions options;
    options.pixel_noise = 0.4;
    options.twist = brisk_twist();
    options.seed = 2;
    last = mapped.scene.look(test::camera_at(0.2, 0, 0, 0, 0.01), options);
    options.seed = 3;
    now = mapped.scene.look(test::camera_at(0.23, 0.02, 0.01, 0.01, 0.02, 0.02), options);
    local = make_local_map(mapped.atlas, mapped.landmarks, {0}, 10);
  }
  const Camera& camera() const { return mapped.scene.camera; }
  TrackedFrame frame(const test::View& view, int index = 7) const {
    return test::tracked_frame(mapped, view, index);
  }
  /// Of the matches to landmarks: how many pair the right keypoint. Fails if a keypoint is used twice.
  int count_right(const std::vector<FrameMatch>& matches) const {
    std::set<int> used;
    int right = 0;
    for (const FrameMatch& match : matches) {
      EXPECT_TRUE(used.insert(match.keypoint).second) << "keypoint " << match.keypoint << " is matched twice";
      if (match.landmark < 0) continue;
      const int point = test::point_of(mapped, local.landmarks[match.landmark].id);
      right += now.points[match.keypoint] == point ? 1 : 0;
      EXPECT_EQ(match.position, local.landmarks[match.landmark].position);
    }
    return right;
  }
  /// Mapped points that both views see.
  int in_common() const {
    int count = 0;
    for (const int point : last.points)
      count += mapped.landmarks[point].valid() && now.keypoint_of(point) >= 0;
    return count;
  }
};

class Shutter : public ::testing::TestWithParam<double> {};

TEST_P(Shutter, MatchesOfTheLastFrameAreTheTrueOnes) {
  const Between scene(GetParam());
  TrackedFrame frame = scene.frame(scene.now, 8);
  const auto matches =
      match_last_frame(scene.camera(), scene.local, scene.frame(scene.last), frame, 10, scene.settings);
  const int right = scene.count_right(matches);
  EXPECT_EQ(right, static_cast<int>(matches.size()));
  EXPECT_GT(right, 0.97 * scene.in_common());
}

TEST_P(Shutter, MatchesOfTheLocalMapAreTheTrueOnes) {
  const Between scene(GetParam());
  std::vector<FrameMatch> matches;
  std::vector<int> visible;
  match_local_map(scene.camera(), scene.local, scene.frame(scene.now), 4, scene.settings, matches, visible);
  const int right = scene.count_right(matches);
  EXPECT_EQ(right, static_cast<int>(matches.size()));
  int mapped_in_view = 0;
  for (const int point : scene.now.points) mapped_in_view += scene.mapped.landmarks[point].valid();
  EXPECT_GT(right, 0.95 * mapped_in_view);
  EXPECT_GE(static_cast<int>(visible.size()), right);
  EXPECT_TRUE(std::is_sorted(visible.begin(), visible.end()));
}

INSTANTIATE_TEST_SUITE_P(Matching, Shutter, ::testing::Values(0.0, 0.03),
                         [](const auto& shutter) { return shutter.param > 0 ? "rolling" : "global"; });

TEST(FrameMatching, IgnoringARollingShutterLosesMatches) {
  const Between scene(0.03);
  TrackedFrame known = scene.frame(scene.now), ignored = known;
  ignored.set_motion(scene.camera(), Vector6d::Zero());
  std::vector<FrameMatch> with, without;
  std::vector<int> visible;
  match_local_map(scene.camera(), scene.local, known, 2, scene.settings, with, visible);
  match_local_map(scene.camera(), scene.local, ignored, 2, scene.settings, without, visible);
  EXPECT_GT(with.size(), 1.2 * static_cast<double>(without.size()));
}

TEST(FrameMatching, TakenKeypointsAndLandmarksAreNotMatchedAgain) {
  const Between scene;
  const TrackedFrame frame = scene.frame(scene.now);
  std::vector<FrameMatch> matches;
  std::vector<int> visible;
  match_local_map(scene.camera(), scene.local, frame, 4, scene.settings, matches, visible);
  const std::size_t all = matches.size();
  matches.resize(all / 2);
  const std::vector<FrameMatch> half = matches;
  std::vector<int> visible_again;
  match_local_map(scene.camera(), scene.local, frame, 4, scene.settings, matches, visible_again);
  EXPECT_EQ(matches.size(), all);
  EXPECT_EQ(scene.count_right(matches), static_cast<int>(all));
  for (std::size_t i = 0; i < half.size(); ++i) EXPECT_EQ(matches[i].keypoint, half[i].keypoint);
  EXPECT_EQ(visible_again, visible) << "those matched before are visible too";
}

TEST(FrameMatching, TemporaryPointsOnlyWhereLandmarksAreFew) {
  Between scene;
  const auto count_temporary = [&](TrackedFrame last) {
    int temporary = 0;
    for (const FrameMatch& match :
         match_last_frame(scene.camera(), scene.local, last, scene.frame(scene.now), 10, scene.settings)) {
      if (match.landmark >= 0) continue;
      ++temporary;
      const Eigen::Vector3d truth = scene.mapped.scene.points[scene.now.points[match.keypoint]].position;
      EXPECT_LT((match.position - truth).norm(), 0.02);
    }
    return temporary;
  };
  scene.settings.initial_landmarks = 50;
  TrackedFrame last = scene.frame(scene.last);
  EXPECT_EQ(count_temporary(last), 0);
  for (int i = 20; i < last.features->size(); ++i) last.landmarks[i] = {};
  const int temporary = count_temporary(last);
  EXPECT_GT(temporary, 50);
  for (int i = 20; i < last.features->size(); i += 2) last.outlier[i] = 1;
  EXPECT_LT(count_temporary(last), 0.7 * temporary) << "outliers make no points";
  for (Measurement& m : last.measurements) m.depth = 0;
  EXPECT_EQ(count_temporary(last), 0) << "nor do keypoints without depth";
}

TEST(FrameMatching, DropsWhatTurnedOtherwise) {
  const Between scene;
  test::Scene turned = scene.mapped.scene;
  for (std::size_t p = 0; p < turned.points.size(); p += 10)
    turned.points[p].angle += 0.5F + 0.013F * static_cast<float>(p);  // each its own way
  TrackedFrame frame = scene.frame(turned.look(scene.now.cam_from_world), 8);
  const auto matches =
      match_last_frame(scene.camera(), scene.local, scene.frame(scene.last), frame, 10, scene.settings);
  EXPECT_GT(matches.size(), 80U);
  for (const FrameMatch& match : matches) {
    EXPECT_NE(test::point_of(scene.mapped, scene.local.landmarks[match.landmark].id) % 10, 0);
  }
}

TEST(FrameMatching, TheReferenceIsMatchedFromAnywhere) {
  const Between scene;
  const test::View far = scene.mapped.scene.look(test::camera_at(0.8, 0.1, 0.4, 0.05, -0.2, 0.6));
  int right = 0, common = 0;
  const auto matches = match_reference(scene.local, *far.features, scene.settings);
  for (const FrameMatch& match : matches)
    right +=
        far.points[match.keypoint] == test::point_of(scene.mapped, scene.local.landmarks[match.landmark].id);
  for (const int point : scene.mapped.views[scene.local.reference.value].points)
    common += far.keypoint_of(point) >= 0 ? 1 : 0;
  EXPECT_EQ(right, static_cast<int>(matches.size()));
  EXPECT_EQ(right, common);
  EXPECT_GT(common, 40);
}

TEST(FrameMatching, LandmarksBehindTheCameraOrSeenFromTheBackAreNotVisible) {
  const Between scene;
  TrackedFrame frame = scene.frame(scene.now);
  std::vector<FrameMatch> matches;
  std::vector<int> visible;
  frame.cam_from_world = test::camera_at(0.2, 0, 0, 0, 3.14159);
  match_local_map(scene.camera(), scene.local, frame, 4, scene.settings, matches, visible);
  EXPECT_TRUE(visible.empty());
  frame.cam_from_world = test::camera_at(0.2, 0, 6, 0, 3.14159);  // from behind the wall
  match_local_map(scene.camera(), scene.local, frame, 4, scene.settings, matches, visible);
  EXPECT_LT(visible.size(), 0.1 * static_cast<double>(scene.local.landmarks.size()));
  EXPECT_TRUE(matches.empty());
}

TEST(FrameMatching, ObservationsCarryTheMeasurements) {
  const Between scene(0.03);
  const TrackedFrame frame = scene.frame(scene.now);
  const auto observations = make_observations(frame, {{4, 0, {1, 2, 3}}, {2, -1, {0, 1, 2}}});
  ASSERT_EQ(observations.size(), 2U);
  EXPECT_EQ(observations[0].point_in_world, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(observations[0].pixel, frame.measurements[4].pixel.cast<double>());
  EXPECT_EQ(observations[1].depth, frame.measurements[2].depth);
  EXPECT_EQ(observations[1].scale, frame.measurements[2].scale);
}

}  // namespace
}  // namespace stdc
