#include "place_recognition/loop_verification.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "place_recognition/test_revisit.hpp"

namespace stdc {
namespace {

using test::angle_error;
using test::centre_error;
using test::Revisit;
using test::Scene;

std::optional<VerifiedLoop> verify(const Revisit& revisit, KeyframeId current, KeyframeId candidate,
                                   const PlaceRecognitionSettings& settings = {}) {
  return verify_loop({{revisit.mapped.scene.camera, {}}, {}}, revisit.mapped.atlas, current, candidate,
                     settings);
}

TEST(LoopVerification, MeasuresTheDrift) {
  Revisit revisit{Scene(500)};
  revisit.visit_first(5);
  revisit.visit_second(revisit.mapped.scene, 5, test::camera_at(0.1, 0.05, -0.1, 0.02, 0.04, 0.15));
  for (const KeyframeId current : revisit.second) {
    const auto loop = verify(revisit, current, revisit.first[2]);
    ASSERT_TRUE(loop);
    const Pose truth = revisit.truth(current);
    EXPECT_GT(centre_error(revisit.mapped.atlas.keyframe(current).cam_from_world, truth), 0.1);
    EXPECT_LT(centre_error(loop->cam_from_world, truth), 0.01);
    EXPECT_LT(angle_error(loop->cam_from_world, truth), 0.004);
    EXPECT_GT(loop->observations.size(), 100U);
    EXPECT_GT(loop->back_inliers, 50);
    const Vector6d error = (truth * loop->cam_from_world.inverse()).log();
    EXPECT_LT(error.dot(loop->information * error), 40) << "it knows how sure it is";
  }
}

TEST(LoopVerification, ObservationsNameTheRightLandmarks) {
  Revisit revisit{Scene(500)};
  revisit.visit_first(4);
  revisit.visit_second(revisit.mapped.scene, 2);
  const auto loop = verify(revisit, revisit.second[1], revisit.first[1]);
  ASSERT_TRUE(loop);
  const test::View& view = revisit.mapped.views.back();
  std::vector<std::uint8_t> seen(revisit.mapped.atlas.landmark_id_limit(), 0);
  int wrong = 0;
  for (const PlaceObservation& s : loop->observations) {
    EXPECT_EQ(seen[s.landmark.value]++, 0) << "each landmark once";
    wrong += revisit.mapped.landmarks[view.points[s.keypoint]] == s.landmark ? 0 : 1;
  }
  EXPECT_EQ(wrong, 0);
}

TEST(LoopVerification, AnotherRoomIsNoLoop) {
  Revisit revisit{Scene(500)};
  revisit.visit_first(4);
  revisit.visit_second(Scene(500, false, 77), 3);
  for (const KeyframeId current : revisit.second) {
    for (const KeyframeId candidate : revisit.first) EXPECT_FALSE(verify(revisit, current, candidate));
  }
}

TEST(LoopVerification, TheSameThingInAnotherRoomIsNoLoop) {
  Revisit revisit{Scene(600)};
  revisit.visit_first(4);
  Scene other(600, false, 77);
  // A poster that hangs in both rooms.
  int copied = 0;
  for (std::size_t i = 0; i < other.points.size(); ++i) {
    const Eigen::Vector3d& p = revisit.mapped.scene.points[i].position;
    if (p.z() < 2.9 || std::abs(p.x()) > 0.7 || std::abs(p.y()) > 0.5) continue;
    other.points[i] = revisit.mapped.scene.points[i];
    ++copied;
  }
  ASSERT_GT(copied, 30);
  revisit.visit_second(other, 3);
  PlaceRecognitionSettings trusting;
  trusting.min_inliers = 20;
  trusting.min_share = 0;
  EXPECT_TRUE(verify(revisit, revisit.second[0], revisit.first[0], trusting)) << "it does look like one";
  for (const KeyframeId current : revisit.second) {
    for (const KeyframeId candidate : revisit.first) EXPECT_FALSE(verify(revisit, current, candidate));
  }
}

TEST(LoopVerification, SameInputSameBytes) {
  Revisit a{Scene(400)}, b{Scene(400)};
  for (Revisit* revisit : {&a, &b}) {
    revisit->visit_first(3);
    revisit->visit_second(revisit->mapped.scene, 2);
  }
  const auto of_a = verify(a, a.second[0], a.first[1]), of_b = verify(b, b.second[0], b.first[1]);
  ASSERT_TRUE(of_a && of_b);
  EXPECT_EQ(of_a->cam_from_world.rotation.coeffs(), of_b->cam_from_world.rotation.coeffs());
  EXPECT_EQ(of_a->cam_from_world.translation, of_b->cam_from_world.translation);
  EXPECT_EQ(of_a->observations.size(), of_b->observations.size());
}

TEST(PlacePose, PlacesAFrameThatIsNotInTheMap) {
  Revisit revisit{Scene(500)};
  revisit.visit_first(4);
  test::ViewOptions options;
  options.seed = 50;
  for (const bool depth : {true, false}) {
    options.depth = depth;
    const Pose pose = test::camera_at(0.2, 0, 0.05, 0, 0.03, -0.3);
    const test::View view = revisit.mapped.scene.look(pose, options);
    const auto place = find_in_place({{revisit.mapped.scene.camera, {}}, {}}, revisit.mapped.atlas,
                                     place_window(revisit.mapped.atlas, revisit.first[0], 3),
                                     {*view.features, view.motion}, {40, 0.2}, {});
    ASSERT_EQ(place.has_value(), depth) << "the first guess needs depths";
    if (!place) continue;
    EXPECT_LT(centre_error(place->cam_from_world, pose), 0.005);
    EXPECT_GT(static_cast<double>(place->observations.size()), 0.5 * place->visible);
  }
}

TEST(PlacePose, AWindowIsTheKeyframeAndItsBestNeighbours) {
  Revisit revisit{Scene(400)};
  revisit.visit_first(5);
  const Atlas& atlas = revisit.mapped.atlas;
  const auto window = place_window(atlas, revisit.first[2], 3);
  ASSERT_EQ(window.size(), 3U);
  EXPECT_EQ(window[0], revisit.first[2]);
  EXPECT_EQ(window[1], atlas.keyframe(revisit.first[2]).covisible[0].keyframe);
  EXPECT_EQ(place_window(atlas, revisit.first[2], 100).size(), 5U);
  EXPECT_FALSE(find_in_place({{revisit.mapped.scene.camera, {}}, {}}, atlas, {},
                             {*atlas.keyframe(revisit.first[0]).features, {}}, {40, 0.2}, {}));
}

}  // namespace
}  // namespace stdc
