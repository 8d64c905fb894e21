#include "input/recordings/transform_tree.hpp"

namespace stdc {

std::string_view plain_frame(std::string_view frame) {
  return frame.starts_with('/') ? frame.substr(1) : frame;
}

void TransformTree::add(std::string_view parent, std::string_view child, const Pose& parent_from_child) {
  if (plain_frame(parent) == plain_frame(child)) return;
  links_.try_emplace(std::string(plain_frame(child)),
                     Link{std::string(plain_frame(parent)), parent_from_child});
}

TransformTree::Place TransformTree::place_of(std::string_view frame) const {
  Place place{std::string(plain_frame(frame)), Pose()};
  // A recording may hold a circle: no way up has more links than there are.
  for (std::size_t steps = 0; steps < links_.size(); ++steps) {
    const auto link = links_.find(place.root);
    if (link == links_.end()) break;
    place.root_from_frame = link->second.parent_from_child * place.root_from_frame;
    place.root = link->second.parent;
  }
  return place;
}

std::optional<Pose> TransformTree::find(std::string_view target, std::string_view source) const {
  const Place to = place_of(target), from = place_of(source);
  if (to.root != from.root) return std::nullopt;
  return to.root_from_frame.inverse() * from.root_from_frame;
}

}  // namespace stdc
