#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/pose.hpp"

namespace stdc {

/// A frame's name without the slash that ROS 1 may put in front.
std::string_view plain_frame(std::string_view frame);

/// How frames of a robot stand to each other, as /tf_static tells: each frame has one parent. Names are the
/// same with and without a slash in front.
class TransformTree {
 public:
  /// The first pose of a child stays: what moves is taken as it stood at the beginning.
  void add(std::string_view parent, std::string_view child, const Pose& parent_from_child);
  /// Maps points of frame `source` to frame `target`; nothing if the recording does not connect them.
  std::optional<Pose> find(std::string_view target, std::string_view source) const;
  /// The frame without a parent that a frame hangs from in the end; itself if it has no parent.
  std::string root_of(std::string_view frame) const { return place_of(frame).root; }
  bool empty() const { return links_.empty(); }

 private:
  struct Link {
    std::string parent;
    Pose parent_from_child;
  };
  struct Place {
    std::string root;
    Pose root_from_frame;
  };
  Place place_of(std::string_view frame) const;

  std::map<std::string, Link, std::less<>> links_;  ///< by child
};

}  // namespace stdc
