#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace stdc {

/// What a page asks for.
struct ViewRequest {
  enum class Kind {
    want,      ///< send these from now on: `value` is a sum of ViewWant
    pause,     ///< hold the run after the present frame
    resume,    ///< let it go on
    step,      ///< let it go on for one frame
    keyframe,  ///< send the image of the keyframe `value`
  };
  Kind kind = Kind::want;
  std::uint32_t value = 0;
  bool operator==(const ViewRequest&) const = default;
};

/// What costs time to make and is made only if some page shows it.
enum ViewWant : std::uint32_t {
  kWantImage = 1,
  kWantDepth = 2,
  kWantMasks = 4,
  kWantMap = 8,
  kWantMesh = 16
};
inline constexpr std::uint32_t kWantAll = 31;

/// Longest message that a page may send [bytes]; a longer one ends the connection.
inline constexpr std::size_t kMaxRequest = 32;

/// Reads a message of a page: "want 7", "pause", "resume", "step", "keyframe 12". Nothing if it is anything
/// else: then the connection is ended.
std::optional<ViewRequest> parse_view_request(std::string_view text);

}  // namespace stdc
