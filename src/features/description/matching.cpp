#include "features/description/matching.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/multiversion.hpp"
#include "features/description/hamming.hpp"

namespace stdc {

STDC_POPCNT_VERSIONS
BestMatch match_in_window(const FrameFeatures& frame, const Descriptor& query, const SearchWindow& window,
                          std::span<const std::uint8_t> taken) {
  BestMatch best;
  frame.for_each_in_window(window.x, window.y, window.radius, window.min_level, window.max_level, [&](int i) {
    if (!taken.empty() && taken[i] != 0) return;
    const int distance = hamming_distance(query, frame.descriptor(i));
    if (distance < best.distance) {
      best.second = best.distance;
      best.second_level = best.level;
      best.distance = distance;
      best.level = frame.keypoint(i).level;
      best.index = i;
    } else if (distance < best.second) {
      best.second = distance;
      best.second_level = frame.keypoint(i).level;
    }
  });
  return best;
}

STDC_POPCNT_VERSIONS
std::vector<KeypointPair> match_all(const FrameFeatures& a, std::span<const std::uint8_t> use_a,
                                    const FrameFeatures& b, int max_distance, double max_ratio) {
  constexpr int kNone = 257;
  struct Nearest {
    int index = -1, distance = kNone;
  };
  std::vector<Nearest> nearest_of_b(b.size());
  std::vector<KeypointPair> candidates;
  for (int i = 0; i < a.size(); ++i) {
    if (use_a[i] == 0) continue;
    Nearest best;
    int second = kNone;
    for (int j = 0; j < b.size(); ++j) {
      const int distance = hamming_distance(a.descriptor(i), b.descriptor(j));
      if (distance < nearest_of_b[j].distance) nearest_of_b[j] = {i, distance};
      if (distance < best.distance) {
        second = best.distance;
        best = {j, distance};
      } else {
        second = std::min(second, distance);
      }
    }
    if (best.distance <= max_distance && best.distance <= max_ratio * second) {
      candidates.push_back({i, best.index});
    }
  }
  std::erase_if(candidates, [&](const KeypointPair& p) { return nearest_of_b[p.second].index != p.first; });
  return candidates;
}

std::vector<std::uint8_t> consistent_rotations(std::span<const float> rotations) {
  constexpr int kBins = 30;
  constexpr double kFullRotation = 6.283185307179586;
  std::array<int, kBins> counts{};
  std::vector<int> bins(rotations.size());
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    const double share = rotations[i] / kFullRotation - std::floor(rotations[i] / kFullRotation);
    bins[i] = static_cast<int>(std::lround(share * kBins)) % kBins;
    ++counts[bins[i]];
  }
  std::array<int, kBins> order;
  for (int b = 0; b < kBins; ++b) order[b] = b;
  std::stable_sort(order.begin(), order.end(), [&](int x, int y) { return counts[x] > counts[y]; });
  std::array<bool, kBins> kept{};
  for (int rank = 0; rank < 3; ++rank) {
    // A bin with less than a tenth of the fullest is chance.
    kept[order[rank]] = counts[order[rank]] * 10 >= counts[order[0]];
  }
  std::vector<std::uint8_t> keep(rotations.size());
  for (std::size_t i = 0; i < rotations.size(); ++i) keep[i] = kept[bins[i]] ? 1 : 0;
  return keep;
}

}  // namespace stdc
