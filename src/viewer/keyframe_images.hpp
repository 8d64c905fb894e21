#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <opencv2/core/mat.hpp>

#include "viewer/view_board.hpp"

namespace stdc {

/// Small images of keyframes, for whoever picks one. The oldest go when they take too much memory. For any
/// thread.
class KeyframeImages {
 public:
  static constexpr std::size_t kMaxBytes = std::size_t{64} << 20U;

  /// @param max_bytes  of all together
  explicit KeyframeImages(std::size_t max_bytes = kMaxBytes) : max_bytes_(max_bytes) {}

  void add(int frame, const cv::Mat& colour);
  /// Frame (u32) and its image as JPEG; no bytes of one that is not kept.
  ViewMessage message(std::uint32_t frame) const;

 private:
  std::size_t max_bytes_;
  mutable std::mutex mutex_;
  std::map<std::uint32_t, ViewMessage> messages_;  ///< by frame
  std::size_t bytes_ = 0;
};

}  // namespace stdc
