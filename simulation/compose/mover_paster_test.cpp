#include "simulation/compose/mover_paster.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "simulation/scene/loose_objects.hpp"
#include "simulation/sequence/camera_path.hpp"
#include "simulation/sequence/dynamic_scene.hpp"
#include "simulation/sequence/rendered_sequence.hpp"
#include "simulation/test_small_camera.hpp"

namespace stdc::simulation {
namespace {

/// A board 1.2 m before a camera that looks along +y.
class MoverPasterTest : public testing::Test {
 protected:
  PastedFrame paste(const RgbdImage& recorded) const {
    const Pose eye = look_at({0, -2, 1.3}, {0, 0, 1.3}), at(Eigen::Quaterniond::Identity(), {0.2, -0.8, 0.5});
    const Prop board(board_mesh(room_), at, {sampled_move(-1, 1, [&](double) { return at; })}, 0.3);
    const DynamicScene scene(room_.world, light_, {}, {board});
    return MoverPaster(camera_, shader_).paste(recorded, eye, *scene.at(0), 5);
  }
  RgbdImage wall(double metres) const {
    return {1, cv::Mat(72, 96, CV_8UC3, cv::Scalar(90, 120, 60)),
            cv::Mat(72, 96, CV_16UC1, cv::Scalar(5000 * metres))};
  }

  Camera camera_ = small_camera();
  Room room_ = make_room(1, false);
  RayScene rays_{room_.world.mesh, TreeQuality::good};
  BakedLight light_{room_.world, rays_};
  SurfaceShader shader_{room_.world, light_};
};

TEST_F(MoverPasterTest, TheNearerSurfaceIsSeen) {
  RgbdImage recorded = wall(2.5);
  recorded.depth(cv::Rect(0, 40, 96, 32)).setTo(5000 * 0.9);  // something stands before the board
  recorded.depth(cv::Rect(60, 10, 10, 10)).setTo(0);          // a hole in the wall
  recorded.depth(cv::Rect(60, 50, 10, 10)).setTo(0);          // a hole in what stands before it
  recorded.depth(cv::Rect(0, 0, 96, 3)).setTo(0);             // nothing known at all
  const PastedFrame pasted = paste(recorded);
  EXPECT_EQ(cv::countNonZero(pasted.mask(cv::Rect(0, 40, 96, 32))), 0);
  EXPECT_EQ(cv::countNonZero(pasted.mask(cv::Rect(60, 10, 10, 10))), 100);
  EXPECT_EQ(cv::countNonZero(pasted.mask(cv::Rect(60, 0, 10, 3))), 30);
  cv::Mat inner, depth;
  cv::erode(pasted.mask, inner, cv::Mat::ones(5, 5, CV_8U));
  pasted.image.depth.copyTo(depth, inner);
  ASSERT_GT(cv::countNonZero(depth), 500);
  double low = 0, high = 0;
  cv::minMaxLoc(depth, &low, &high, nullptr, nullptr, depth > 0);
  EXPECT_NEAR(low / 5000, 1.19, 0.03);
  EXPECT_NEAR(high / 5000, 1.19, 0.03);
}

TEST_F(MoverPasterTest, TheRestIsAsRecorded) {
  const RgbdImage recorded = wall(2.5);
  const PastedFrame pasted = paste(recorded);
  cv::Mat near, colour, changed = pasted.image.depth != recorded.depth;
  cv::dilate(pasted.mask, near, cv::Mat::ones(3, 3, CV_8U));
  cv::absdiff(pasted.image.colour, recorded.colour, colour);
  cv::transform(colour, colour, cv::Matx13f(1, 1, 1));
  EXPECT_EQ(cv::countNonZero((colour > 0) & ~near), 0);
  EXPECT_GT(cv::countNonZero(colour), 1000);
  // Beside the mask only the shadow of the projector, to the left of the board, has lost its depth.
  changed &= ~pasted.mask;
  EXPECT_GT(cv::countNonZero(changed), 20);
  EXPECT_EQ(cv::countNonZero(changed & (pasted.image.depth > 0)), 0);
}

}  // namespace
}  // namespace stdc::simulation
