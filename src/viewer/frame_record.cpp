#include "viewer/frame_record.hpp"

#include <algorithm>
#include <limits>

#include "viewer/messages/byte_writer.hpp"

namespace stdc {
namespace {

std::uint16_t short_of(int count) {
  return static_cast<std::uint16_t>(std::clamp(count, 0, int{std::numeric_limits<std::uint16_t>::max()}));
}

/// Of several frames, what is worse is shown.
int trouble(TrackingStatus status) {
  switch (status) {
    case TrackingStatus::ok:
      return 0;
    case TrackingStatus::skipped:
      return 1;
    case TrackingStatus::initialising:
      return 2;
    case TrackingStatus::uncertain:
      return 3;
    case TrackingStatus::lost:
      break;
  }
  return 4;
}

}  // namespace

FrameRecord make_frame_record(const TrackingResult& result) {
  FrameRecord record;
  record.frame = static_cast<std::uint32_t>(result.frame);
  record.timestamp = result.timestamp;
  record.milliseconds = static_cast<float>(result.milliseconds.total);
  if (result.segmentation) record.dynamic_network = static_cast<float>(result.segmentation->dynamic_share);
  if (result.motion) record.dynamic_motion = static_cast<float>(result.motion->dynamic_share);
  record.inliers = short_of(result.inliers);
  record.matches = short_of(result.matches);
  record.high = short_of(result.keypoints_high);
  record.low = short_of(result.keypoints_low);
  record.status = result.status;
  record.tracked = result.status == TrackingStatus::ok ? 1 : 0;
  const auto flag = [&record](bool set, FrameRecord::Flag bit) {
    if (set) record.flags = static_cast<std::uint8_t>(record.flags | bit);
  };
  flag(result.cam_from_world.has_value(), FrameRecord::kPose);
  flag(result.is_keyframe, FrameRecord::kKeyframe);
  flag(result.loop.has_value(), FrameRecord::kLoop);
  if (result.map.valid()) record.map = short_of(static_cast<int>(result.map.value));
  if (result.cam_from_world) record.world_from_cam = result.cam_from_world->inverse();
  return record;
}

FrameRecord merge(const FrameRecord& first, const FrameRecord& second) {
  FrameRecord merged = second;
  merged.milliseconds = std::max(first.milliseconds, second.milliseconds);
  merged.dynamic_network = std::max(first.dynamic_network, second.dynamic_network);
  merged.dynamic_motion = std::max(first.dynamic_motion, second.dynamic_motion);
  merged.inliers = std::min(first.inliers, second.inliers);
  merged.matches = std::min(first.matches, second.matches);
  if (trouble(first.status) > trouble(second.status)) merged.status = first.status;
  merged.flags = static_cast<std::uint8_t>(first.flags | second.flags);
  if ((second.flags & FrameRecord::kPose) == 0) {
    merged.world_from_cam = first.world_from_cam;
    merged.map = first.map;
  }
  merged.frames = first.frames + second.frames;
  merged.tracked = first.tracked + second.tracked;
  return merged;
}

std::string encode_frames(std::uint32_t first, const std::vector<FrameRecord>& frames) {
  ByteWriter bytes;
  bytes.reserve(2 * sizeof(std::uint32_t) + frames.size() * kFrameRecordSize);
  bytes.put(first);
  bytes.put(static_cast<std::uint32_t>(frames.size()));
  for (const FrameRecord& record : frames) {
    bytes.put(record.timestamp);
    bytes.put(record.frame);
    bytes.put(record.milliseconds);
    bytes.put(record.dynamic_network);
    bytes.put(record.dynamic_motion);
    for (const std::uint16_t count : {record.inliers, record.matches, record.high, record.low})
      bytes.put(count);
    bytes.put(static_cast<std::uint8_t>(record.status));
    bytes.put(record.flags);
    bytes.put(record.map);
    for (const double value : record.world_from_cam.translation) bytes.put(static_cast<float>(value));
    for (const double value : record.world_from_cam.rotation.coeffs()) bytes.put(static_cast<float>(value));
    bytes.put(record.frames);
    bytes.put(record.tracked);
  }
  return bytes.take();
}

}  // namespace stdc
