#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <limits>

namespace stdc {

/// A dense index that cannot be mixed up with another kind of index. Ids are given in order of creation and
/// never reused, so sorting by id is sorting by age.
template <typename Tag>
struct Id {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t value = kNone;

  constexpr bool valid() const { return value != kNone; }
  constexpr auto operator<=>(const Id&) const = default;  // NOLINT(modernize-use-nullptr): takes the 0 in <=>
};

using KeyframeId = Id<struct KeyframeTag>;
using LandmarkId = Id<struct LandmarkTag>;
using MapId = Id<struct MapTag>;

}  // namespace stdc

template <typename Tag>
struct std::hash<stdc::Id<Tag>> {
  std::size_t operator()(stdc::Id<Tag> id) const noexcept { return id.value; }
};
