#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "slam/tracking_result.hpp"

namespace stdc {

/// What the page's curves and its path show of a frame, or of several, of which it then says the worst.
struct FrameRecord {
  enum Flag : std::uint8_t { kPose = 1, kKeyframe = 2, kLoop = 4 };

  std::uint32_t frame = 0;
  double timestamp = 0;                           ///< [s]
  float milliseconds = 0;                         ///< of the tracking thread
  float dynamic_network = 0, dynamic_motion = 0;  ///< share of the pixels
  std::uint16_t inliers = 0, matches = 0, high = 0, low = 0;
  TrackingStatus status = TrackingStatus::initialising;
  std::uint8_t flags = 0;
  std::uint16_t map = 0;
  Pose world_from_cam;                    ///< if it has one, as known when it was tracked
  std::uint32_t frames = 1, tracked = 0;  ///< that it stands for, and those of them with status ok
};

FrameRecord make_frame_record(const TrackingResult& result);

/// One record for the frames of two that follow each other: the longest time, the fewest inliers, the largest
/// shares, the worst status; time and pose of the second.
FrameRecord merge(const FrameRecord& first, const FrameRecord& second);

inline constexpr std::size_t kFrameRecordSize = 72;  ///< [bytes] in a message
/// Number of the first frame (u32), of records (u32), then of each what FrameRecord lists, in its order.
std::string encode_frames(std::uint32_t first, const std::vector<FrameRecord>& frames);

}  // namespace stdc
