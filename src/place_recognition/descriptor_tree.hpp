#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "features/keypoint.hpp"

namespace stdc {

/// Finds stored descriptors that are near to a given one. A tree that grows with what is put into it, so
/// there is nothing to train and nothing to load: a leaf that gets too full is split into clusters of similar
/// descriptors (k-majority: Grana et al., 'A fast approach for integrating ORB descriptors in the bag of
/// words model', SPIE 2013), whose centres decide from then on which branch a descriptor takes. A search goes
/// down to the nearest leaf and then to those behind the nearest branches passed by (best bin first, as Muja
/// and Lowe do with hierarchical clusterings: 'Fast Matching of Binary Features', CRV 2012).
///
/// Everything is stored with a number, its owner. Same calls, same tree. Not synchronised.
class DescriptorTree {
 public:
  /// A stored descriptor: how many bits lie between it and the wanted one.
  struct Found {
    std::uint32_t owner = 0;
    int distance = 0;
  };

  void add(const Descriptor& descriptor, std::uint32_t owner);

  /// Drops everything whose owner is marked in `gone` (by owner), and joins branches that have become small.
  void sweep(std::span<const std::uint8_t> gone);

  /// Those at most `max_distance` bits away in the `leaves` leaves where that is most likely; in a fixed
  /// order, appended to `found`.
  void search(const Descriptor& wanted, int leaves, int max_distance, std::vector<Found>& found) const;

  /// Descriptors that are stored.
  std::size_t size() const { return size_; }
  /// Memory in use, about [bytes].
  std::size_t bytes() const;

  static constexpr std::size_t kBranches = 16;
  static constexpr std::size_t kLeafSize =
      320;  ///< a leaf is split when it holds more; of the same it takes no more
  static constexpr std::size_t kMaxLeaf = 1280;  ///< in the rare case that splitting fails

 private:
  struct Node {
    std::vector<Descriptor> centres;  ///< of the children
    std::vector<Node> children;       ///< none: a leaf
    std::vector<Descriptor> descriptors;
    std::vector<std::uint32_t> owners;

    bool is_leaf() const { return children.empty(); }
  };
  struct Branch {
    const Node* node = nullptr;
    int distance = 0;
  };

  static void split(Node& leaf);
  static std::size_t sweep(Node& node, std::span<const std::uint8_t> gone);
  static void gather(Node& from, Node& into);
  static const Node* descend(const Node* node, const Descriptor& wanted, std::vector<Branch>& passed_by);
  static void scan(const Node& leaf, const Descriptor& wanted, int max_distance, std::vector<Found>& found);
  static std::size_t bytes(const Node& node);

  Node root_;
  std::size_t size_ = 0;
};

}  // namespace stdc
