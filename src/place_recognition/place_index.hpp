#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/ids.hpp"
#include "features/keypoint.hpp"
#include "place_recognition/descriptor_tree.hpp"

namespace stdc {

/// A keyframe that looks like what was asked for.
struct PlaceMatch {
  KeyframeId keyframe;
  float score = 0;  ///< 0: nothing in common; 1: every keypoint found again, bit by bit, and nowhere else
};

/// Recognises places by the descriptors of their keyframes. It starts empty and at once: instead of a
/// vocabulary trained beforehand there is a tree of the very descriptors that the map holds
/// (`DescriptorTree`). Each descriptor asked for votes for the keyframes that hold a near one, the more
/// the nearer it is (as in Hamming embedding: Jegou, Douze and Schmid, 'Improving Bag-of-Features for Large
/// Scale Image Search', IJCV 2010, where, too, votes go to neighbours within a cell, not to the cell) and the
/// fewer keyframes have it (inverse document frequency: Sivic and Zisserman, 'Video Google', ICCV 2003). That
/// an index grown from the images themselves does as well as a trained vocabulary: Garcia-Fidalgo and Ortiz,
/// 'iBoW-LCD', RA-L 2018; Schlegel and Grisetti, 'HBST', RA-L 2018.
///
/// 40 bytes for each descriptor. Same calls in the same order, same answers. Not synchronised.
class PlaceIndex {
 public:
  /// Adds a keyframe, once.
  void add(KeyframeId keyframe, std::span<const Descriptor> descriptors);
  /// Takes it out; one that is not in it is ignored. Its memory is freed when a quarter of what is stored has
  /// been taken out, so that the cost is spread.
  void remove(KeyframeId keyframe);

  /// The `most` keyframes that look most like an image with these descriptors, best first (by id where they
  /// are equal); those in `exclude` are left out, and those with nothing in common.
  std::vector<PlaceMatch> query(std::span<const Descriptor> descriptors, std::span<const KeyframeId> exclude,
                                std::size_t most) const;

  bool has(KeyframeId keyframe) const;
  int keyframe_count() const { return keyframe_count_; }
  /// Memory in use, about [bytes].
  std::size_t bytes() const;

 private:
  std::vector<float> collect_votes(std::span<const Descriptor> descriptors) const;
  void sweep();

  DescriptorTree tree_;
  std::vector<KeyframeId> keyframes_;  ///< by slot; invalid: free, or gone but not swept yet
  std::vector<std::uint32_t> counts_;  ///< by slot: descriptors
  std::vector<std::uint32_t> free_slots_;
  std::vector<std::uint32_t> slots_;  ///< by keyframe id
  std::vector<std::uint8_t> gone_;    ///< by slot: taken out, but its descriptors are still in the tree
  std::size_t gone_descriptors_ = 0;
  int keyframe_count_ = 0;
};

}  // namespace stdc
