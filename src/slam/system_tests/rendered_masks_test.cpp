// Masks of rendered people, whose truth is known: refinement and propagation on what they are made for.
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "segmentation/propagation/mask_propagator.hpp"
#include "segmentation/propagation/mask_settling.hpp"
#include "segmentation/srm/refinement.hpp"
#include "segmentation/srm/test_literal_refinement.hpp"
#include "simulation/sequence/rendered_sequence.hpp"

namespace stdc {
namespace {

double mask_overlap(const cv::Mat& a, const cv::Mat& b) {
  return static_cast<double>(cv::countNonZero(a & b)) / cv::countNonZero(a | b);
}

class RenderedMasks : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const simulation::RenderedSequence sequence(simulation::Preset::walking_rpy, {});
    camera() = sequence.camera();
    for (int i = 0; i < 4; ++i) frames().push_back(sequence.render(84 + i));
  }
  static void TearDownTestSuite() { frames().clear(); }
  static std::vector<simulation::RenderedFrame>& frames() {
    static std::vector<simulation::RenderedFrame> all;
    return all;
  }
  static Camera& camera() {
    static Camera one;
    return one;
  }
  static double units() { return camera().depth_units_per_metre; }
};

TEST_F(RenderedMasks, RefinementEqualsItsDefinition) {
  const simulation::RenderedFrame& frame = frames()[0];
  ASSERT_GT(cv::countNonZero(frame.mask), 20000);
  cv::Mat eroded;
  cv::erode(frame.mask, eroded, cv::Mat(), {-1, -1}, 6);
  for (const cv::Mat& mask : {frame.mask, eroded}) {
    const cv::Mat wanted = test::literal_refinement(mask, frame.image.depth, units(), {});
    EXPECT_EQ(cv::norm(refine(mask, frame.image.depth, units()), wanted, cv::NORM_L1), 0);
  }
}

TEST_F(RenderedMasks, RefinementCompletesASettledMask) {
  const simulation::RenderedFrame& frame = frames()[0];
  cv::Mat eroded;
  cv::erode(frame.mask, eroded, cv::Mat(), {-1, -1}, 6);
  const cv::Mat settled = settle_by_depth(eroded, frame.image.depth, units());
  const cv::Mat refined = refine(settled, frame.image.depth, units());
  EXPECT_GT(mask_overlap(refined, frame.mask), mask_overlap(eroded, frame.mask) + 0.05);
  EXPECT_GT(mask_overlap(refined, frame.mask), 0.93);
}

TEST_F(RenderedMasks, PropagationFollowsThePeople) {
  MaskPropagator propagator(camera());
  cv::Mat grey, carried;
  for (int i = 0; i < static_cast<int>(frames().size()); ++i) {
    const simulation::RenderedFrame& frame = frames()[static_cast<std::size_t>(i)];
    cv::cvtColor(frame.image.colour, grey, cv::COLOR_BGR2GRAY);
    propagator.add_frame(i, grey, frame.image.depth);
    if (i == 0) propagator.set_mask(0, frame.mask);
    carried = propagator.mask();
    EXPECT_GT(mask_overlap(carried, frame.mask), 0.93) << i;
  }
  // The camera turns quickly here: the mask where it was is of little use.
  EXPECT_GT(mask_overlap(carried, frames().back().mask),
            mask_overlap(frames()[0].mask, frames().back().mask) + 0.1);
}

}  // namespace
}  // namespace stdc
