#include "atlas/storage/test_map_file.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace stdc::test {

std::string bytes_of(const Camera& camera, const Atlas& atlas) {
  std::ostringstream stream;
  write_map(stream, camera, atlas);
  return stream.str();
}

StoredMap map_of(const std::string& bytes) {
  std::istringstream stream(bytes);
  return read_map(stream, "some.map");
}

void expect_same(const FrameFeatures& a, const FrameFeatures& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(a.levels(), b.levels());
  EXPECT_EQ(a.scale_factor(), b.scale_factor());
  EXPECT_EQ(a.usual_depth(), b.usual_depth());
  EXPECT_EQ(a.pixels(), b.pixels());
  EXPECT_EQ(a.depths(), b.depths());
  EXPECT_EQ(a.descriptors(), b.descriptors());
  ASSERT_EQ(a.patches().size(), b.patches().size());
  for (int i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a.keypoint(i).x, b.keypoint(i).x);
    EXPECT_EQ(a.keypoint(i).y, b.keypoint(i).y);
    EXPECT_EQ(a.keypoint(i).angle, b.keypoint(i).angle);
    EXPECT_EQ(a.keypoint(i).response, b.keypoint(i).response);
    EXPECT_EQ(a.keypoint(i).level, b.keypoint(i).level);
    EXPECT_EQ(a.keypoint(i).quality, b.keypoint(i).quality);
    if (a.patch(i) != nullptr) {
      EXPECT_EQ(a.patch(i)->pixels, b.patch(i)->pixels);
    }
  }
}

void expect_same(const Atlas& a, const Atlas& b) {
  const auto keyframes_a = a.keyframe_ids(), keyframes_b = b.keyframe_ids();
  const auto landmarks_b = b.landmark_ids();
  ASSERT_EQ(keyframes_a.size(), keyframes_b.size());
  for (std::size_t k = 0; k < keyframes_a.size(); ++k) {
    const Keyframe &of_a = a.keyframe(keyframes_a[k]), &of_b = b.keyframe(keyframes_b[k]);
    EXPECT_EQ(of_a.frame, of_b.frame);
    EXPECT_EQ(of_a.timestamp, of_b.timestamp);
    EXPECT_EQ(of_a.cam_from_world.rotation.coeffs(), of_b.cam_from_world.rotation.coeffs());
    EXPECT_EQ(of_a.cam_from_world.translation, of_b.cam_from_world.translation);
    EXPECT_EQ(of_a.motion.twist, of_b.motion.twist);
    EXPECT_EQ(of_a.motion.readout_time, of_b.motion.readout_time);
    EXPECT_EQ(of_a.motion.last_row, of_b.motion.last_row);
    EXPECT_EQ(of_a.parent.valid(), of_b.parent.valid());
    if (of_a.parent.valid()) {
      EXPECT_EQ(a.keyframe(of_a.parent).frame, b.keyframe(of_b.parent).frame);
    }
    EXPECT_EQ(of_a.parent.valid(), a.root(of_a.map) != of_a.id);
    ASSERT_EQ(of_a.loops.size(), of_b.loops.size());
    for (std::size_t i = 0; i < of_a.loops.size(); ++i) {
      EXPECT_EQ(a.keyframe(of_a.loops[i]).frame, b.keyframe(of_b.loops[i]).frame);
    }
    ASSERT_EQ(of_a.covisible.size(), of_b.covisible.size());
    for (std::size_t i = 0; i < of_a.covisible.size(); ++i) {
      EXPECT_EQ(a.keyframe(of_a.covisible[i].keyframe).frame, b.keyframe(of_b.covisible[i].keyframe).frame);
      EXPECT_EQ(of_a.covisible[i].shared, of_b.covisible[i].shared);
    }
    expect_same(*of_a.features, *of_b.features);
    ASSERT_EQ(of_a.measurements.size(), of_b.measurements.size());
    for (std::size_t i = 0; i < of_a.measurements.size(); ++i) {
      EXPECT_EQ(of_a.measurements[i].seen, of_b.measurements[i].seen);
      EXPECT_EQ(of_a.measurements[i].pixel, of_b.measurements[i].pixel);
      EXPECT_EQ(of_a.measurements[i].depth, of_b.measurements[i].depth);
      EXPECT_EQ(of_a.measurements[i].scale, of_b.measurements[i].scale);
      ASSERT_EQ(of_a.landmarks[i].valid(), of_b.landmarks[i].valid());
      if (!of_a.landmarks[i].valid()) continue;
      const Landmark &l = a.landmark(of_a.landmarks[i]), &m = b.landmark(of_b.landmarks[i]);
      EXPECT_EQ(l.position, m.position);
      EXPECT_EQ(l.descriptor, m.descriptor);
      EXPECT_EQ(l.direction, m.direction);
      EXPECT_EQ(l.min_distance, m.min_distance);
      EXPECT_EQ(l.max_distance, m.max_distance);
      EXPECT_EQ(l.visible, m.visible);
      EXPECT_EQ(l.found, m.found);
      EXPECT_EQ(l.observations.size(), m.observations.size());
      EXPECT_TRUE(b.has(m.created_by));
    }
  }
  EXPECT_EQ(static_cast<int>(landmarks_b.size()), b.landmark_count());
}

}  // namespace stdc::test
