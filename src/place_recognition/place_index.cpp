#include "place_recognition/place_index.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace stdc {
namespace {

constexpr std::uint32_t kNoSlot = 0xffffffff;
constexpr int kMaxDistance = 56;  ///< bits; the same corner seen again is seldom further away
constexpr int kLeaves = 1;        ///< two or three find no more places, but take longer

/// How much a neighbour at some distance counts: a Gaussian (Jegou et al.).
std::array<float, kMaxDistance + 1> make_weights() {
  constexpr double kSigma = 16;  // bits
  std::array<float, kMaxDistance + 1> weights{};
  for (int d = 0; d <= kMaxDistance; ++d) {
    weights[d] = static_cast<float>(std::exp(-0.5 * (d / kSigma) * (d / kSigma)));
  }
  return weights;
}

}  // namespace

void PlaceIndex::add(KeyframeId keyframe, std::span<const Descriptor> descriptors) {
  if (has(keyframe)) return;
  if (keyframe.value >= slots_.size()) slots_.resize(keyframe.value + 1, kNoSlot);
  std::uint32_t slot = 0;
  if (free_slots_.empty()) {
    slot = static_cast<std::uint32_t>(keyframes_.size());
    keyframes_.emplace_back();
    counts_.emplace_back();
    gone_.emplace_back();
  } else {
    slot = free_slots_.back();
    free_slots_.pop_back();
  }
  slots_[keyframe.value] = slot;
  keyframes_[slot] = keyframe;
  counts_[slot] = static_cast<std::uint32_t>(descriptors.size());
  ++keyframe_count_;
  for (const Descriptor& descriptor : descriptors) tree_.add(descriptor, slot);
}

bool PlaceIndex::has(KeyframeId keyframe) const {
  return keyframe.value < slots_.size() && slots_[keyframe.value] != kNoSlot;
}

void PlaceIndex::remove(KeyframeId keyframe) {
  if (!has(keyframe)) return;
  const std::uint32_t slot = slots_[keyframe.value];
  slots_[keyframe.value] = kNoSlot;
  keyframes_[slot] = {};
  gone_[slot] = 1;
  gone_descriptors_ += counts_[slot];
  --keyframe_count_;
  if (4 * gone_descriptors_ >= tree_.size()) sweep();
}

void PlaceIndex::sweep() {
  tree_.sweep(gone_);
  for (std::uint32_t slot = 0; slot < gone_.size(); ++slot) {
    if (gone_[slot] != 0) free_slots_.push_back(slot);
    gone_[slot] = 0;
  }
  gone_descriptors_ = 0;
}

std::vector<float> PlaceIndex::collect_votes(std::span<const Descriptor> descriptors) const {
  const std::array<float, kMaxDistance + 1> weights = make_weights();
  std::vector<float> rarity(keyframe_count_ + 1);  // by number of keyframes that have it
  const double most = std::log(1.0 + keyframe_count_);
  for (int n = 1; n <= keyframe_count_; ++n) {
    rarity[n] = static_cast<float>(std::log(1.0 + static_cast<double>(keyframe_count_) / n) / most);
  }
  std::vector<float> votes(keyframes_.size(), 0.0F);
  std::vector<int> nearest(keyframes_.size(), kMaxDistance + 1);
  std::vector<DescriptorTree::Found> found;
  std::vector<std::uint32_t> voters;
  for (const Descriptor& descriptor : descriptors) {
    found.clear();
    voters.clear();
    tree_.search(descriptor, kLeaves, kMaxDistance, found);
    for (const DescriptorTree::Found& f : found) {
      if (gone_[f.owner] != 0) continue;
      if (nearest[f.owner] > kMaxDistance) voters.push_back(f.owner);
      nearest[f.owner] = std::min(nearest[f.owner], f.distance);
    }
    for (const std::uint32_t slot : voters) {
      votes[slot] += weights[nearest[slot]] * rarity[voters.size()];
      nearest[slot] = kMaxDistance + 1;
    }
  }
  return votes;
}

std::vector<PlaceMatch> PlaceIndex::query(std::span<const Descriptor> descriptors,
                                          std::span<const KeyframeId> exclude, std::size_t most) const {
  if (keyframe_count_ == 0 || descriptors.empty()) return {};
  std::vector<float> votes = collect_votes(descriptors);
  for (const KeyframeId keyframe : exclude) {
    if (has(keyframe)) votes[slots_[keyframe.value]] = 0;
  }
  std::vector<PlaceMatch> places;
  for (std::size_t slot = 0; slot < votes.size(); ++slot) {
    if (!(votes[slot] > 0)) continue;
    // The geometric mean of both counts: a full keyframe does not win by being full.
    const double possible = std::sqrt(static_cast<double>(descriptors.size()) * counts_[slot]);
    places.push_back({keyframes_[slot], static_cast<float>(votes[slot] / possible)});
  }
  const auto better = [](const PlaceMatch& a, const PlaceMatch& b) {
    return a.score != b.score ? a.score > b.score : a.keyframe < b.keyframe;
  };
  const std::size_t kept = std::min(most, places.size());
  std::partial_sort(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(kept), places.end(), better);
  places.resize(kept);
  return places;
}

std::size_t PlaceIndex::bytes() const {
  return tree_.bytes() + keyframes_.capacity() * (sizeof(KeyframeId) + 9) + slots_.capacity() * 4;
}

}  // namespace stdc
