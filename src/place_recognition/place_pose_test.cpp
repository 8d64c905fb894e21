#include "place_recognition/place_pose.hpp"

#include <gtest/gtest.h>

#include "atlas/test_scene.hpp"
#include "core/test_bytes.hpp"

namespace stdc {
namespace {

class PlacePoseTest : public ::testing::Test {
 protected:
  PlacePoseTest() : mapped(test::Scene(400)) {
    mapped.add(mapped.scene.look(Pose()));
    options.pixel_noise = 0.5;
    options.depth_noise = 0.004;
    options.seed = 9;
  }
  std::optional<PlacePose> locate(const test::View& view, int min_inliers = 40) const {
    return find_in_place({{mapped.scene.camera, {}}, {}}, mapped.atlas, {KeyframeId{0}},
                         {*view.features, view.motion}, {min_inliers, 0}, {});
  }
  /// Of the observations, how many name another landmark than the one that the keypoint sees.
  int wrong(const PlacePose& place, const test::View& view) const {
    int count = 0;
    for (const PlaceObservation& o : place.observations)
      count += o.landmark == mapped.landmarks[view.points[o.keypoint]] ? 0 : 1;
    return count;
  }

  test::MappedScene mapped;
  test::ViewOptions options;
};

TEST_F(PlacePoseTest, FindsAPoseFarFromTheKeyframes) {
  const test::View view = mapped.scene.look(test::camera_at(0.5, -0.2, 0.5, 0.1, -0.2, 0.8), options);
  const auto found = locate(view);
  ASSERT_TRUE(found);
  EXPECT_LT(test::centre_error(found->cam_from_world, view.cam_from_world), 0.01);
  EXPECT_LT(test::angle_error(found->cam_from_world, view.cam_from_world), 0.004);
  int common = 0;
  for (int i = 0; i < view.features->size(); ++i) common += mapped.landmarks[view.points[i]].valid() ? 1 : 0;
  EXPECT_EQ(wrong(*found, view), 0);
  EXPECT_GT(found->observations.size(), 0.85 * common);
}

TEST_F(PlacePoseTest, WrongDescriptorsAndDepthsDoNotMatter) {
  // A third of the keypoints has the descriptor of some other point, a third has a wrong depth.
  test::Scene muddled = mapped.scene;
  const std::size_t third = muddled.points.size() / 3;
  for (std::size_t p = 0; p < third; ++p)
    muddled.points[p].descriptor = mapped.scene.points[(p + 17) % third].descriptor;
  options.depth_noise = 0.06;
  const test::View view = muddled.look(test::camera_at(0.3, 0, 0.2, 0, -0.1), options);
  const auto found = locate(view);
  ASSERT_TRUE(found);
  EXPECT_LT(test::centre_error(found->cam_from_world, view.cam_from_world), 0.03);
  EXPECT_LE(wrong(*found, view), 0.02 * static_cast<double>(found->observations.size()));
}

TEST_F(PlacePoseTest, AForeignFrameIsNowhere) {
  const test::Scene foreign(400, false, 77);
  EXPECT_FALSE(locate(foreign.look(Pose(), options)));
  // The same descriptors at other places: much matches, but nothing agrees.
  test::Scene shuffled = mapped.scene;
  Random random(4);
  for (test::ScenePoint& point : shuffled.points) {
    point.position = {random.uniform(-1.5, 1.5), random.uniform(-1.0, 1.0), random.uniform(1.5, 3.5)};
  }
  EXPECT_FALSE(locate(shuffled.look(Pose(), options)));
}

TEST_F(PlacePoseTest, TooFewAreRefused) {
  const test::View view = mapped.scene.look(test::camera_at(0.1, 0, 0), options);
  EXPECT_TRUE(locate(view, 40));
  EXPECT_FALSE(locate(view, view.features->size() + 1));
}

TEST_F(PlacePoseTest, NeedsDepth) {
  options.depth = false;
  EXPECT_FALSE(locate(mapped.scene.look(test::camera_at(0.1, 0, 0), options)));
}

TEST_F(PlacePoseTest, GivesTheSameBytesTwice) {
  const test::View view = mapped.scene.look(test::camera_at(0.4, 0.1, 0.3, 0, -0.2, 0.3), options);
  const auto once = locate(view), again = locate(view);
  ASSERT_TRUE(once && again);
  EXPECT_TRUE(test::same_bytes(once->cam_from_world, again->cam_from_world));
  EXPECT_EQ(once->observations.size(), again->observations.size());
}

}  // namespace
}  // namespace stdc
