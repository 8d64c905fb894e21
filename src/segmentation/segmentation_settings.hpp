#pragma once

#include <array>
#include <utility>

#include "core/setting.hpp"

namespace stdc {

/// Where the masks of dynamic pixels come from.
enum class SegmentationSource {
  off,      ///< nowhere: everything counts as static
  network,  ///< the network finds them in the colour image
  masks,    ///< files
};

template <>
struct EnumNames<SegmentationSource> {
  static constexpr std::array values{std::pair{SegmentationSource::off, "off"},
                                     std::pair{SegmentationSource::network, "network"},
                                     std::pair{SegmentationSource::masks, "masks"}};
};

/// When the tracker gets a frame's mask.
enum class SegmentationPace {
  every_frame,   ///< the tracker waits for each frame's own mask, as in the paper
  asynchronous,  ///< it never waits: the newest mask there is is carried to the frame
};

template <>
struct EnumNames<SegmentationPace> {
  static constexpr std::array values{std::pair{SegmentationPace::every_frame, "every-frame"},
                                     std::pair{SegmentationPace::asynchronous, "asynchronous"}};
};

/// Settings of the semantic thread.
struct SegmentationSettings {
  STDC_SETTING(SegmentationSource, source, SegmentationSource::network,
               "Where the masks of dynamic pixels come from");
  STDC_SETTING(SegmentationPace, pace, SegmentationPace::every_frame,
               "Wait for each frame's own mask, or propagate the newest one to the frame");
  STDC_SETTING(int, latency, 3, "frames", 1, 30,
               "Asynchronous: a frame's mask is used this many frames later");
  STDC_SETTING(double, idle_after, 0.5, "s", 0, 3600,
               "Every-frame, network: it rests while nobody has been seen for this long");
  STDC_SETTING(double, idle_interval, 0.1, "s", 0, 1,
               "Resting, it looks at a frame at least this often; 0: it never rests");
  STDC_SETTING(bool, propagation, true, "Move a mask of an earlier frame along with the objects it covers");
  STDC_SETTING(bool, border_trimming, false,
               "Before refinement, remove background pixels at the mask's border by depth");
  STDC_SETTING(bool, refinement, true, "Complete masks by depth (SRM, Alg. 1)");
};

}  // namespace stdc
