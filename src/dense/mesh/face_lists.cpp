#include "dense/mesh/face_lists.hpp"

namespace stdc {

FaceLists::FaceLists(const std::vector<std::array<Index, 3>>& faces, std::size_t vertices)
    : heads_(vertices, kEnd), next_(3 * faces.size(), kEnd) {
  // From behind, so that each is put before those that come after it.
  for (std::size_t corner = next_.size(); corner-- > 0;) {
    Index& head = heads_[faces[corner / 3][corner % 3]];
    next_[corner] = head;
    head = static_cast<Index>(corner);
  }
}

void FaceLists::remove(Index vertex, Index face) {
  for (Index* link = &heads_[vertex]; *link != kEnd; link = &next_[*link]) {
    if (*link / 3 != face) continue;
    *link = next_[*link];
    return;
  }
}

void FaceLists::append(Index kept, Index gone) {
  Index* link = &heads_[kept];
  while (*link != kEnd) link = &next_[*link];
  *link = heads_[gone];
  heads_[gone] = kEnd;
}

}  // namespace stdc
