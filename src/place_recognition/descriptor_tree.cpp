#include "place_recognition/descriptor_tree.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/multiversion.hpp"
#include "features/description/hamming.hpp"

namespace stdc {
namespace {

struct Nearest {
  std::size_t index = 0;
  int distance = 257;
};

inline Nearest nearest_of(std::span<const Descriptor> centres, const Descriptor& descriptor) {
  Nearest nearest;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const int distance = hamming_distance(centres[i], descriptor);
    if (distance < nearest.distance) nearest = {i, distance};
  }
  return nearest;
}

STDC_POPCNT_VERSIONS
Nearest nearest_centre(std::span<const Descriptor> centres, const Descriptor& descriptor) {
  return nearest_of(centres, descriptor);
}

/// Counts of each bit among the members of a cluster, as binary numbers that lie across the words: digit k of
/// all 256 counts is one descriptor.
class BitCounts {
 public:
  void add(const Descriptor& descriptor) {
    ++members_;
    std::array<std::uint64_t, 4> carry = descriptor.bits;
    for (Descriptor& digit : digits_) {
      std::uint64_t left = 0;
      for (std::size_t word = 0; word < 4; ++word) {
        const std::uint64_t both = digit.bits[word] & carry[word];
        digit.bits[word] ^= carry[word];
        left |= carry[word] = both;
      }
      if (left == 0) return;
    }
  }
  bool empty() const { return members_ == 0; }
  /// Bits that more than half of the members have.
  Descriptor majority() const {
    Descriptor centre;
    for (std::size_t i = 0; i < 256; ++i) {
      std::uint32_t ones = 0;
      for (std::size_t k = 0; k < kDigits; ++k) {
        ones += static_cast<std::uint32_t>((digits_[k].bits[i / 64] >> (i % 64)) & 1U) << k;
      }
      if (2 * ones > members_) centre.bits[i / 64] |= std::uint64_t{1} << (i % 64);
    }
    return centre;
  }

 private:
  static constexpr std::size_t kDigits = 11;
  static_assert(DescriptorTree::kMaxLeaf < (1U << kDigits));
  std::array<Descriptor, kDigits> digits_;
  std::uint32_t members_ = 0;
};

bool all_are(const std::vector<Descriptor>& descriptors, const Descriptor& same) {
  return std::all_of(descriptors.begin(), descriptors.end(), [&](const Descriptor& d) { return d == same; });
}

/// Clusters by k-majority, started from members spread evenly over the list and the one furthest from the
/// first. Clusters may come out empty.
std::vector<Descriptor> cluster(std::span<const Descriptor> descriptors, std::size_t clusters) {
  constexpr int kRounds = 2;
  std::vector<Descriptor> centres{*std::max_element(
      descriptors.begin(), descriptors.end(), [&](const Descriptor& a, const Descriptor& b) {
        return hamming_distance(a, descriptors[0]) < hamming_distance(b, descriptors[0]);
      })};
  for (std::size_t k = 0; k + 1 < clusters; ++k) {
    const Descriptor& seed = descriptors[k * descriptors.size() / (clusters - 1)];
    if (std::find(centres.begin(), centres.end(), seed) == centres.end()) centres.push_back(seed);
  }
  for (int round = 0; round < kRounds; ++round) {
    std::vector<BitCounts> counts(centres.size());
    for (const Descriptor& d : descriptors) counts[nearest_centre(centres, d).index].add(d);
    for (std::size_t k = 0; k < centres.size(); ++k) {
      if (!counts[k].empty()) centres[k] = counts[k].majority();
    }
  }
  return centres;
}

}  // namespace

void DescriptorTree::add(const Descriptor& descriptor, std::uint32_t owner) {
  Node* node = &root_;
  while (!node->is_leaf()) node = &node->children[nearest_centre(node->centres, descriptor).index];
  // What occurs everywhere tells no places apart: so many of the same are enough.
  const std::size_t count = node->descriptors.size();
  if (count >= kMaxLeaf || (count >= kLeafSize && all_are(node->descriptors, descriptor))) return;
  node->descriptors.push_back(descriptor);
  node->owners.push_back(owner);
  ++size_;
  if (count > 0 && count % kLeafSize == 0) split(*node);
}

void DescriptorTree::split(Node& leaf) {
  const std::vector<Descriptor> centres = cluster(leaf.descriptors, kBranches);
  std::vector<Node> children(centres.size());
  for (std::size_t i = 0; i < leaf.descriptors.size(); ++i) {
    Node& child = children[nearest_centre(centres, leaf.descriptors[i]).index];
    child.descriptors.push_back(leaf.descriptors[i]);
    child.owners.push_back(leaf.owners[i]);
  }
  Node parent;
  for (std::size_t k = 0; k < children.size(); ++k) {
    if (children[k].descriptors.empty()) continue;
    parent.centres.push_back(centres[k]);
    parent.children.push_back(std::move(children[k]));
  }
  if (parent.children.size() > 1) leaf = std::move(parent);
}

void DescriptorTree::sweep(std::span<const std::uint8_t> gone) { size_ = sweep(root_, gone); }

std::size_t DescriptorTree::sweep(Node& node, std::span<const std::uint8_t> gone) {
  if (node.is_leaf()) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < node.owners.size(); ++i) {
      if (gone[node.owners[i]] != 0) continue;
      node.descriptors[kept] = node.descriptors[i];
      node.owners[kept++] = node.owners[i];
    }
    node.descriptors.resize(kept);
    node.owners.resize(kept);
    return kept;
  }
  std::size_t size = 0;
  for (Node& child : node.children) size += sweep(child, gone);
  if (size > kLeafSize / 2) return size;
  Node joined;
  gather(node, joined);
  node = std::move(joined);
  return size;
}

void DescriptorTree::gather(Node& from, Node& into) {
  into.descriptors.insert(into.descriptors.end(), from.descriptors.begin(), from.descriptors.end());
  into.owners.insert(into.owners.end(), from.owners.begin(), from.owners.end());
  for (Node& child : from.children) gather(child, into);
}

STDC_POPCNT_VERSIONS
const DescriptorTree::Node* DescriptorTree::descend(const Node* node, const Descriptor& wanted,
                                                    std::vector<Branch>& passed_by) {
  while (!node->is_leaf()) {
    std::size_t best = 0;
    int distance = 257;
    for (std::size_t i = 0; i < node->centres.size(); ++i) {
      const int d = hamming_distance(node->centres[i], wanted);
      if (d < distance) {
        if (i > 0) passed_by.push_back({&node->children[best], distance});
        best = i;
        distance = d;
      } else {
        passed_by.push_back({&node->children[i], d});
      }
    }
    node = &node->children[best];
  }
  return node;
}

STDC_POPCNT_VERSIONS
void DescriptorTree::scan(const Node& leaf, const Descriptor& wanted, int max_distance,
                          std::vector<Found>& found) {
  for (std::size_t i = 0; i < leaf.descriptors.size(); ++i) {
    const int distance = hamming_distance(leaf.descriptors[i], wanted);
    if (distance <= max_distance) found.push_back({leaf.owners[i], distance});
  }
}

void DescriptorTree::search(const Descriptor& wanted, int leaves, int max_distance,
                            std::vector<Found>& found) const {
  std::vector<Branch> passed_by;
  passed_by.reserve(64);
  const Node* next = &root_;
  for (int visited = 0; next != nullptr; ++visited) {
    const Node* leaf = descend(next, wanted, passed_by);
    scan(*leaf, wanted, max_distance, found);
    next = nullptr;
    if (visited + 1 >= leaves || passed_by.empty()) break;
    const auto nearest =
        std::min_element(passed_by.begin(), passed_by.end(),
                         [](const Branch& a, const Branch& b) { return a.distance < b.distance; });
    next = nearest->node;
    *nearest = passed_by.back();
    passed_by.pop_back();
  }
}

std::size_t DescriptorTree::bytes() const { return bytes(root_); }

std::size_t DescriptorTree::bytes(const Node& node) {
  std::size_t sum = sizeof(Node) + node.centres.capacity() * sizeof(Descriptor) +
                    node.descriptors.capacity() * sizeof(Descriptor) +
                    node.owners.capacity() * sizeof(std::uint32_t);
  for (const Node& child : node.children) sum += bytes(child);
  return sum;
}

}  // namespace stdc
