#include "place_recognition/relocalisation.hpp"

#include <gtest/gtest.h>

#include "atlas/test_scene.hpp"
#include "core/test_bytes.hpp"

namespace stdc {
namespace {

class RelocalisationTest : public ::testing::Test {
 protected:
  RelocalisationTest() : mapped(test::Scene(400)) {
    mapped.add(mapped.scene.look(Pose()));
    options.pixel_noise = 0.5;
    options.depth_noise = 0.004;
    options.seed = 9;
  }
  std::optional<Relocalisation> locate(const FrameFeatures& frame, int least = 40) const {
    return locate_by_keyframe(mapped.scene.camera, mapped.atlas, {0}, frame, least, {}, {}, {});
  }

  test::MappedScene mapped;
  test::ViewOptions options;
};

TEST_F(RelocalisationTest, FindsAPoseFarFromTheKeyframes) {
  const test::View view = mapped.scene.look(test::camera_at(0.5, -0.2, 0.5, 0.1, -0.2, 0.8), options);
  const auto found = locate(*view.features);
  ASSERT_TRUE(found);
  EXPECT_LT(test::centre_error(found->cam_from_world, view.cam_from_world), 0.01);
  EXPECT_LT(test::angle_error(found->cam_from_world, view.cam_from_world), 0.004);
  ASSERT_EQ(static_cast<int>(found->landmarks.size()), view.features->size());
  int agreeing = 0, common = 0;
  for (int i = 0; i < view.features->size(); ++i) {
    const LandmarkId truth = mapped.landmarks[view.points[i]];
    common += truth.valid() ? 1 : 0;
    if (!found->landmarks[i].valid()) continue;
    EXPECT_EQ(found->landmarks[i], truth);
    ++agreeing;
  }
  EXPECT_GT(agreeing, 0.85 * common);
}

TEST_F(RelocalisationTest, WrongDescriptorsAndDepthsDoNotMatter) {
  // A third of the keypoints has the descriptor of some other point, a third has a wrong depth.
  test::Scene muddled = mapped.scene;
  const std::size_t third = muddled.points.size() / 3;
  for (std::size_t p = 0; p < third; ++p)
    muddled.points[p].descriptor = mapped.scene.points[(p + 17) % third].descriptor;
  options.depth_noise = 0.06;
  const test::View view = muddled.look(test::camera_at(0.3, 0, 0.2, 0, -0.1), options);
  const auto found = locate(*view.features);
  ASSERT_TRUE(found);
  EXPECT_LT(test::centre_error(found->cam_from_world, view.cam_from_world), 0.03);
  int wrong = 0, agreeing = 0;
  for (int i = 0; i < view.features->size(); ++i) {
    if (!found->landmarks[i].valid()) continue;
    ++agreeing;
    wrong += found->landmarks[i] != mapped.landmarks[view.points[i]] ? 1 : 0;
  }
  EXPECT_LE(wrong, 0.02 * agreeing);
}

TEST_F(RelocalisationTest, AForeignFrameIsNowhere) {
  const test::Scene foreign(400, false, 77);
  EXPECT_FALSE(locate(*foreign.look(Pose(), options).features));
  // The same descriptors at other places: much matches, but nothing agrees.
  test::Scene shuffled = mapped.scene;
  Random random(4);
  for (test::ScenePoint& point : shuffled.points) {
    point.position = {random.uniform(-1.5, 1.5), random.uniform(-1.0, 1.0), random.uniform(1.5, 3.5)};
  }
  EXPECT_FALSE(locate(*shuffled.look(Pose(), options).features));
}

TEST_F(RelocalisationTest, TooFewAreRefused) {
  const test::View view = mapped.scene.look(test::camera_at(0.1, 0, 0), options);
  EXPECT_TRUE(locate(*view.features, 40));
  EXPECT_FALSE(locate(*view.features, view.features->size() + 1));
}

TEST_F(RelocalisationTest, NeedsDepth) {
  options.depth = false;
  EXPECT_FALSE(locate(*mapped.scene.look(test::camera_at(0.1, 0, 0), options).features));
}

TEST_F(RelocalisationTest, GivesTheSameBytesTwice) {
  const test::View view = mapped.scene.look(test::camera_at(0.4, 0.1, 0.3, 0, -0.2, 0.3), options);
  const auto once = locate(*view.features), again = locate(*view.features);
  ASSERT_TRUE(once && again);
  EXPECT_TRUE(test::same_bytes(once->cam_from_world, again->cam_from_world));
  EXPECT_EQ(once->landmarks, again->landmarks);
}

}  // namespace
}  // namespace stdc
