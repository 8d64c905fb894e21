#include "atlas/landmark_alignment.hpp"

#include <gtest/gtest.h>

#include "atlas/test_scene.hpp"

namespace stdc {
namespace {

/// Two keyframes before a textured wall; the keypoints lie on whole pixels of their levels, so the
/// observations of a point differ by up to half of such a pixel.
class Alignment : public ::testing::Test {
 protected:
  Alignment() : mapped(test::Scene(300, true)) {
    mapped.scene.camera.width = 400;
    mapped.scene.camera.height = 320;
    mapped.scene.camera.cx = 199.5;
    mapped.scene.camera.cy = 159.5;
    for (const Pose& pose : {test::camera_at(0, 0, 0), test::camera_at(0.15, -0.1, 0.2, 0.02, -0.03, 0.1)}) {
      images.push_back(mapped.scene.render(pose));
      pyramids.emplace_back().build(images.back(), test::scene_feature_settings());
      test::ViewOptions options;
      options.whole_pixels = true;
      options.pyramid = &pyramids.back();
      options.seed = pyramids.size();
      mapped.add(mapped.scene.look(pose, options));
    }
    // A landmark is what its reference view sees: the point of the wall behind that pixel.
    for (const LandmarkId id : mapped.atlas.landmark_ids()) {
      const ReferenceView reference = reference_view_of(mapped.atlas, mapped.atlas.landmark(id));
      const Pose world_from_cam = reference.cam_from_world.inverse();
      const Eigen::Vector3d ray =
          world_from_cam.rotation * camera().unproject(reference.seen.cast<double>(), 1);
      const Eigen::Vector3d centre = world_from_cam.translation;
      mapped.atlas.set_position(id, centre + (3 - centre.z()) / ray.z() * ray);
    }
  }

  const Camera& camera() const { return mapped.scene.camera; }
  std::vector<LandmarkId> seen_by_both() const {
    std::vector<LandmarkId> ids;
    for (const LandmarkId id : mapped.atlas.landmark_ids()) {
      if (mapped.atlas.landmark(id).observations.size() == 2) ids.push_back(id);
    }
    return ids;
  }
  Eigen::Vector2d truth(LandmarkId id, KeyframeId keyframe) const {
    return camera().project(mapped.atlas.keyframe(keyframe).cam_from_world *
                            mapped.atlas.landmark(id).position);
  }

  static constexpr KeyframeId kFirst{0}, kSecond{1};
  test::MappedScene mapped;
  std::vector<cv::Mat> images;
  std::vector<Pyramid> pyramids;
  NoiseSettings noise;
};

TEST_F(Alignment, TheAnchorIsTheOldestObservation) {
  const LandmarkId id = seen_by_both().front();
  const ReferenceView reference = reference_view_of(mapped.atlas, mapped.atlas.landmark(id));
  EXPECT_EQ(reference.features, mapped.atlas.keyframe(kFirst).features.get());
  EXPECT_EQ(reference.keypoint, mapped.atlas.keypoint_of(id, kFirst));
  EXPECT_EQ(reference.seen, reference.features->pixel(reference.keypoint));
}

TEST_F(Alignment, FindsLandmarksInAnImageToAFractionOfAPixel) {
  const Keyframe& view = mapped.atlas.keyframe(kSecond);
  int found = 0, exact = 0;
  const auto ids = seen_by_both();
  ASSERT_GT(ids.size(), 40U);
  for (const LandmarkId id : ids) {
    const Eigen::Vector2d expected = truth(id, kSecond);
    const Eigen::Vector2f start = expected.cast<float>() + Eigen::Vector2f(1.1F, -0.8F);
    const auto observation = align_in_image(
        {camera(), noise}, reference_view_of(mapped.atlas, mapped.atlas.landmark(id)),
        mapped.atlas.landmark(id).position, view.cam_from_world, *view.features, pyramids[1], start, 3);
    if (!observation) continue;
    ++found;
    exact += (observation->seen.cast<double>() - expected).norm() < 0.15 ? 1 : 0;
    EXPECT_NEAR(observation->scale, 0.5F * view.features->scale_of(mapped.atlas.keypoint_of(id, kSecond)),
                0.7F);
  }
  EXPECT_GT(found, 0.9 * static_cast<double>(ids.size()));
  EXPECT_GT(exact, 0.97 * found);
}

TEST_F(Alignment, RefusesWhatLooksDifferentOrLiesBehind) {
  const LandmarkId id = seen_by_both().front();
  const ReferenceView reference = reference_view_of(mapped.atlas, mapped.atlas.landmark(id));
  const Keyframe& view = mapped.atlas.keyframe(kSecond);
  const Eigen::Vector3d& position = mapped.atlas.landmark(id).position;
  const Eigen::Vector2f there = truth(id, kSecond).cast<float>();
  const Pose turned = test::camera_at(0, 0, 0, 0, 3.1);
  EXPECT_FALSE(
      align_in_image({camera(), noise}, reference, position, turned, *view.features, pyramids[1], there, 3));
  Pyramid flat;
  flat.build(cv::Mat(320, 400, CV_8UC1, cv::Scalar(90)), test::scene_feature_settings());
  EXPECT_FALSE(align_in_image({camera(), noise}, reference, position, view.cam_from_world, *view.features,
                              flat, there, 3));
  const Eigen::Vector2f outside(-30, 100);
  EXPECT_FALSE(align_in_image({camera(), noise}, reference, position, view.cam_from_world, *view.features,
                              pyramids[1], outside, 3));
}

TEST_F(Alignment, MakesAllObservationsMeanTheSamePoint) {
  double before = 0, after = 0;
  int aligned = 0;
  const auto ids = seen_by_both();
  for (const LandmarkId id : ids) {
    const int keypoint = mapped.atlas.keypoint_of(id, kSecond);
    const auto& measurements = mapped.atlas.keyframe(kSecond).measurements;
    const double error = (measurements[keypoint].pixel.cast<double>() - truth(id, kSecond)).norm();
    align_observation(mapped.atlas, {camera(), noise}, id, kSecond);
    if (measurements[keypoint].scale == mapped.atlas.keyframe(kSecond).features->scale_of(keypoint)) continue;
    ++aligned;
    before += error;
    after += (measurements[keypoint].pixel.cast<double>() - truth(id, kSecond)).norm();
    EXPECT_EQ(measurements[keypoint].depth, mapped.atlas.keyframe(kSecond).features->depth(keypoint));
  }
  EXPECT_GT(aligned, 0.8 * static_cast<double>(ids.size()));
  EXPECT_LT(after, 0.2 * before);
}

TEST_F(Alignment, TheAnchorsOwnObservationStays) {
  const LandmarkId id = seen_by_both().front();
  const int keypoint = mapped.atlas.keypoint_of(id, kFirst);
  Measurement marked = mapped.atlas.keyframe(kFirst).measurements[keypoint];
  marked.scale = 0.123F;
  mapped.atlas.set_measurement(kFirst, keypoint, marked);
  align_observation(mapped.atlas, {camera(), noise}, id, kFirst);
  EXPECT_EQ(mapped.atlas.keyframe(kFirst).measurements[keypoint].scale, 0.123F);
}

TEST_F(Alignment, AWrongLandmarkFallsBackToTheKeypoint) {
  // The second keyframe takes a keypoint for a landmark that is somewhere else.
  const auto ids = seen_by_both();
  int fell_back = 0, tried = 0;
  for (std::size_t i = 0; i + 1 < ids.size(); i += 2, ++tried) {
    const int keypoint = mapped.atlas.keypoint_of(ids[i + 1], kSecond);
    mapped.atlas.remove_observation(kSecond, keypoint);
    mapped.atlas.remove_observation(kSecond, mapped.atlas.keypoint_of(ids[i], kSecond));
    ASSERT_TRUE(mapped.atlas.observe(kSecond, keypoint, ids[i]));
    align_observation(mapped.atlas, {camera(), noise}, ids[i], kSecond);
    const Keyframe& view = mapped.atlas.keyframe(kSecond);
    fell_back += view.measurements[keypoint].seen == view.features->pixel(keypoint) ? 1 : 0;
  }
  EXPECT_GT(fell_back, 0.8 * tried);
}

}  // namespace
}  // namespace stdc
