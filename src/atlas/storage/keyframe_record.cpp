#include "atlas/storage/keyframe_record.hpp"

#include <cmath>
#include <limits>

namespace stdc {
namespace {

// Nothing in an image or a room is further away; keeps casts to int defined.
constexpr float kFarPixel = 1e6F;
constexpr double kFar = 1e9;

void put(RecordWriter& out, const Eigen::Vector2f& v) {
  out.put(v.x());
  out.put(v.y());
}

Eigen::Vector2f get_pixel(RecordReader& in) {
  const auto x = in.get_number<float>(-kFarPixel, kFarPixel);
  return {x, in.get_number<float>(-kFarPixel, kFarPixel)};
}

void put_features(RecordWriter& out, const FrameFeatures& features) {
  out.put(features.scale_factor());
  out.put(static_cast<std::uint32_t>(features.levels()));
  out.put(static_cast<std::uint8_t>(features.patches().empty() ? 0 : 1));
  out.put(static_cast<std::uint32_t>(features.size()));
  for (int i = 0; i < features.size(); ++i) {
    const Keypoint& k = features.keypoint(i);
    for (const float value : {k.x, k.y, k.angle, k.response}) out.put(value);
    out.put(k.level);
    out.put(static_cast<std::uint8_t>(k.quality));
    put(out, features.pixel(i));
    out.put(features.depth(i));
    out.put_bytes(features.descriptor(i).bits.data(), sizeof(Descriptor::bits));
  }
  for (const Patch& patch : features.patches()) out.put_bytes(patch.pixels.data(), patch.pixels.size());
}

Keypoint get_keypoint(RecordReader& in, int levels) {
  Keypoint k;
  k.x = in.get_number<float>(-kFarPixel, kFarPixel);
  k.y = in.get_number<float>(-kFarPixel, kFarPixel);
  k.angle = in.get_number<float>(-10, 10);
  k.response = in.get_number<float>(std::numeric_limits<float>::lowest(), std::numeric_limits<float>::max());
  k.level = in.get_number<std::uint8_t>(0, static_cast<std::uint8_t>(levels - 1));
  k.quality = static_cast<KeypointQuality>(in.get_number<std::uint8_t>(0, 1));
  return k;
}

std::shared_ptr<const FrameFeatures> get_features(RecordReader& in, const Camera& camera) {
  constexpr std::size_t kMinBytes = 4 * 4 + 2 + 8 + 4 + 32;
  StoredFeatures stored;
  stored.scale_factor = in.get_number<double>(1.001, 4);
  stored.levels = static_cast<int>(in.get_number<std::uint32_t>(1, 16));
  const bool has_patches = in.get_number<std::uint8_t>(0, 1) != 0;
  const std::size_t count = in.get_count(kMinBytes);
  stored.keypoints.reserve(count);
  stored.pixels.reserve(count);
  stored.depths.reserve(count);
  stored.descriptors.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    stored.keypoints.push_back(get_keypoint(in, stored.levels));
    stored.pixels.push_back(get_pixel(in));
    stored.depths.push_back(in.get_number<float>(0, kFarPixel));
    in.get_bytes(stored.descriptors[i].bits.data(), sizeof(Descriptor::bits));
  }
  if (has_patches) {
    stored.patches.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      in.get_bytes(stored.patches.emplace_back().pixels.data(), sizeof(Patch::pixels));
    }
  }
  return std::make_shared<FrameFeatures>(camera, std::move(stored));
}

void put_relations(RecordWriter& out, const Keyframe& keyframe, const NewIds& ids) {
  out.put(static_cast<std::int32_t>(ids.maps[keyframe.map.value]));
  out.put(keyframe.parent.valid() ? ids.keyframes[keyframe.parent.value] : KeyframeId::kNone);
  out.put(static_cast<std::uint32_t>(keyframe.covisible.size()));
  for (const Covisible& c : keyframe.covisible) {
    out.put(ids.keyframes[c.keyframe.value]);
    out.put(static_cast<std::int32_t>(c.shared));
  }
  out.put(static_cast<std::uint32_t>(keyframe.loops.size()));
  for (const KeyframeId other : keyframe.loops) out.put(ids.keyframes[other.value]);
}

void get_relations(RecordReader& in, Keyframe& keyframe) {
  // No map is younger than a keyframe of it.
  const auto newest = static_cast<std::int32_t>(keyframe.id.value & 0x7FFFFFFFU);
  keyframe.map = {static_cast<std::uint32_t>(in.get_number<std::int32_t>(0, newest))};
  keyframe.parent = {in.get<std::uint32_t>()};
  in.check(!keyframe.parent.valid() || keyframe.parent < keyframe.id, "a parent is younger than its child");
  const std::size_t covisible = in.get_count(8);
  for (std::size_t k = 0; k < covisible; ++k) {
    Covisible c;
    c.keyframe = {in.get<std::uint32_t>()};
    c.shared = in.get_number<std::int32_t>(1, std::numeric_limits<std::int32_t>::max());
    in.check(c.keyframe != keyframe.id, "a keyframe is its own neighbour");
    keyframe.covisible.push_back(c);
  }
  const std::size_t loops = in.get_count(4);
  for (std::size_t k = 0; k < loops; ++k) {
    const KeyframeId other{in.get<std::uint32_t>()};
    in.check(other != keyframe.id, "a keyframe has a loop edge to itself");
    in.check(k == 0 || keyframe.loops.back() < other, "a keyframe's loop edges are out of order");
    keyframe.loops.push_back(other);
  }
}

void put_observations(RecordWriter& out, const Keyframe& keyframe, const NewIds& ids) {
  for (std::size_t i = 0; i < keyframe.landmarks.size(); ++i) {
    const LandmarkId landmark = keyframe.landmarks[i];
    out.put(landmark.valid() ? ids.landmarks[landmark.value] : LandmarkId::kNone);
    const Measurement& m = keyframe.measurements[i];
    put(out, m.seen);
    put(out, m.pixel);
    out.put(m.depth);
    out.put(m.scale);
  }
}

void get_observations(RecordReader& in, Keyframe& keyframe) {
  const auto count = static_cast<std::size_t>(keyframe.features->size());
  keyframe.landmarks.reserve(count);
  keyframe.measurements.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    keyframe.landmarks.push_back({in.get<std::uint32_t>()});
    Measurement m;
    m.seen = get_pixel(in);
    m.pixel = get_pixel(in);
    m.depth = in.get_number<float>(0, kFarPixel);
    m.scale = in.get_number<float>(1e-6F, kFarPixel);
    keyframe.measurements.push_back(m);
  }
}

}  // namespace

void put_pose(RecordWriter& out, const Pose& pose) {
  for (const double value : pose.rotation.coeffs()) out.put(value);
  for (const double value : pose.translation) out.put(value);
}

Pose get_pose(RecordReader& in) {
  // Not by the constructor: what it normalises may come out other by the last bit.
  Pose pose;
  for (double& value : pose.rotation.coeffs()) value = in.get_number<double>(-1.1, 1.1);
  in.check(std::abs(pose.rotation.norm() - 1) < 1e-6, "a rotation is none");
  for (double& value : pose.translation) value = in.get_number<double>(-kFar, kFar);
  return pose;
}

void put_keyframe(RecordWriter& out, const Keyframe& keyframe, const NewIds& ids) {
  out.put(static_cast<std::int32_t>(keyframe.frame));
  out.put(keyframe.timestamp);
  put_pose(out, keyframe.cam_from_world);
  for (const double value : keyframe.motion.twist) out.put(value);
  out.put(keyframe.motion.readout_time);
  out.put(keyframe.motion.last_row);
  put_relations(out, keyframe, ids);
  put_features(out, *keyframe.features);
  put_observations(out, keyframe, ids);
}

Keyframe get_keyframe(RecordReader& in, const Camera& camera, KeyframeId id) {
  Keyframe keyframe;
  keyframe.id = id;
  keyframe.frame = in.get<std::int32_t>();
  keyframe.timestamp = in.get_number<double>(-1e12, 1e12);
  keyframe.cam_from_world = get_pose(in);
  for (double& value : keyframe.motion.twist) value = in.get_number<double>(-kFar, kFar);
  keyframe.motion.readout_time = in.get_number<double>(0, 10);
  keyframe.motion.last_row = in.get_number<double>(1e-6, kFarPixel);
  get_relations(in, keyframe);
  keyframe.features = get_features(in, camera);
  get_observations(in, keyframe);
  return keyframe;
}

}  // namespace stdc
