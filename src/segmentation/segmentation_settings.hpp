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
  SegmentationSource source = SegmentationSource::network;
  SegmentationPace pace = SegmentationPace::every_frame;
  int latency = 3;
  bool propagation = true;
  bool settling = false;
  bool refinement = true;

  template <typename Self, typename Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Setting{"source", "", "Where the masks of dynamic pixels come from"}, self.source);
    visit(Setting{"pace", "", "Wait for every frame's own mask, or carry the newest one to the frame"},
          self.pace);
    visit(Setting{"latency", "frames", "Asynchronous: a frame's mask is taken in after this many frames", 1,
                  30},
          self.latency);
    visit(Setting{"propagation", "", "Move a mask of an earlier frame with what it covers"},
          self.propagation);
    visit(Setting{"settling", "", "Before refinement, take off the mask's rim what depth says is background"},
          self.settling);
    visit(Setting{"refinement", "", "Complete masks by depth (SRM, Alg. 1)"}, self.refinement);
  }
};

}  // namespace stdc
