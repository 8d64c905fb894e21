#include "atlas/visibility.hpp"

#include <gtest/gtest.h>

#include "atlas/test_scene.hpp"

namespace stdc {
namespace {

class VisibilityTest : public ::testing::Test {
 protected:
  VisibilityTest() : view(test::Scene(200).look(Pose())) {
    landmark.position = {0, 0, 3};
    landmark.direction = {0, 0, 1};
    landmark.min_distance = 1;
    landmark.max_distance = 4;
  }
  std::optional<ViewingImage::Expected> expect(const Pose& cam_from_world) const {
    return ViewingImage(camera, cam_from_world, CameraMotion(), *view.features).expect(landmark);
  }

  Camera camera;
  test::View view;
  LandmarkGeometry landmark;
};

TEST_F(VisibilityTest, ALandmarkAheadIsExpectedWhereItProjects) {
  const auto expected = expect(Pose());
  ASSERT_TRUE(expected);
  EXPECT_NEAR(expected->pixel.x(), camera.cx, 1e-3);
  EXPECT_NEAR(expected->pixel.y(), camera.cy, 1e-3);
  EXPECT_NEAR(expected->cosine, 1, 1e-6);
}

TEST_F(VisibilityTest, BehindOrBesideTheImageItIsNot) {
  EXPECT_FALSE(expect(Pose(Eigen::Quaterniond::Identity(), {0, 0, -4})));
  EXPECT_FALSE(expect(Pose(Eigen::Quaterniond::Identity(), {4, 0, 0})));
}

TEST_F(VisibilityTest, TheDistanceDecidesTheLevel) {
  // It was made at max_distance / scale: farther away a finer level shows it, nearer a coarser one.
  const auto at = [&](double z) { return expect(Pose(Eigen::Quaterniond::Identity(), {0, 0, z - 3})); };
  ASSERT_TRUE(at(3.9) && at(2.5) && at(1.2));
  EXPECT_EQ(at(3.9)->level, 1);
  EXPECT_LT(at(3.9)->level, at(2.5)->level);
  EXPECT_LT(at(2.5)->level, at(1.2)->level);
  EXPECT_FALSE(at(4.9)) << "too far";
  EXPECT_FALSE(at(0.7)) << "too near";
}

TEST_F(VisibilityTest, FromTheSideItIsNot) {
  landmark.direction = Eigen::Vector3f(0.8F, 0, 0.6F);
  EXPECT_TRUE(expect(Pose()));
  landmark.direction = Eigen::Vector3f(0.9F, 0, 0.436F);
  EXPECT_FALSE(expect(Pose()));
}

TEST_F(VisibilityTest, TheWindowGrowsWithTheLevel) {
  const ViewingImage image(camera, view.cam_from_world, view.motion, *view.features);
  const SearchWindow fine = image.window({{10, 20}, 1, 0}, 5, 1),
                     coarse = image.window({{10, 20}, 1, 3}, 5, 0);
  EXPECT_FLOAT_EQ(fine.radius, 5);
  EXPECT_FLOAT_EQ(coarse.radius, 5 * view.features->scale(3));
  EXPECT_EQ(fine.min_level, 0);
  EXPECT_EQ(fine.max_level, 1);
  EXPECT_EQ(coarse.min_level, 2);
  EXPECT_EQ(coarse.max_level, 3);
}

}  // namespace
}  // namespace stdc
