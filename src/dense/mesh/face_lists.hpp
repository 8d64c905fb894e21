#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

namespace stdc {

/// Which faces meet at each vertex of a mesh: chains through the faces' corners, which take a third of the
/// memory of a vector for each vertex and are joined without any.
class FaceLists {
 public:
  using Index = std::uint32_t;

  /// The faces of each vertex in their order.
  FaceLists(const std::vector<std::array<Index, 3>>& faces, std::size_t vertices);

  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = Index;
    using difference_type = std::ptrdiff_t;
    using pointer = const Index*;
    using reference = Index;

    Iterator() = default;
    Iterator(const FaceLists& lists, Index corner) : lists_(&lists), corner_(corner) {}
    Index operator*() const { return corner_ / 3; }
    Iterator& operator++() {
      corner_ = lists_->next_[corner_];
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++*this;
      return before;
    }
    bool operator==(const Iterator& other) const { return corner_ == other.corner_; }

   private:
    const FaceLists* lists_ = nullptr;
    Index corner_ = 0;
  };
  /// The faces of a vertex; good until they change.
  class List {
   public:
    List(const FaceLists& lists, Index vertex) : begin_(lists, lists.heads_[vertex]), end_(lists, kEnd) {}
    Iterator begin() const { return begin_; }
    Iterator end() const { return end_; }
    bool empty() const { return begin_ == end_; }

   private:
    Iterator begin_, end_;
  };
  List of(Index vertex) const { return {*this, vertex}; }

  /// Takes a face out of a vertex's list.
  void remove(Index vertex, Index face);
  /// Puts the faces of `gone` behind those of `kept`, and leaves it none.
  void append(Index kept, Index gone);

 private:
  static constexpr Index kEnd = ~Index{0};
  std::vector<Index> heads_;  ///< first corner of each vertex
  std::vector<Index> next_;   ///< the same vertex's corner after each; corner: 3 * face + which
};

}  // namespace stdc
