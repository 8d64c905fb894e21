#include "features/detection/candidates.hpp"

#include <algorithm>
#include <cmath>

namespace stdc {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

}  // namespace

void CandidateChooser::assign_regions(std::span<const Corner> corners, const Cell& area, int region_size) {
  const int width = area.right - area.left, height = area.bottom - area.top;
  const int columns = std::max(1, static_cast<int>(std::lround(static_cast<double>(width) / region_size)));
  const int rows = std::max(1, static_cast<int>(std::lround(static_cast<double>(height) / region_size)));
  std::vector<int> column_of(at(width));
  for (int x = 0; x < width; ++x) column_of[at(x)] = x * columns / width;
  region_of_.resize(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const int row = (corners[i].y - area.top) * rows / height;
    region_of_[i] = row * columns + column_of[at(corners[i].x - area.left)];
  }
  high_count_.assign(at(columns * rows), 0);
}

void CandidateChooser::choose_improved(std::span<const Corner> corners, const Cell& area, int budget,
                                       const FeatureSettings& settings) {
  low_.clear();
  for (int i = 0; i < static_cast<int>(corners.size()); ++i) {
    (corners[at(i)].score >= settings.threshold_high ? chosen_ : low_).push_back(i);
  }
  const int missing = budget - static_cast<int>(chosen_.size());
  if (missing <= 0 || low_.empty()) return;
  assign_regions(corners, area, settings.region_size);
  for (const int i : chosen_) ++high_count_[at(region_of_[at(i)])];
  // The rank of a corner is the number of candidates in its region before it: the corners of all regions with
  // the same number of candidates come together.
  const auto stronger = [&](int a, int b) { return corners[at(a)].score > corners[at(b)].score; };
  std::stable_sort(low_.begin(), low_.end(), stronger);
  turns_.clear();
  for (const int i : low_) turns_.push_back({high_count_[at(region_of_[at(i)])]++, i});
  std::stable_sort(turns_.begin(), turns_.end(),
                   [](const LowCorner& a, const LowCorner& b) { return a.rank < b.rank; });
  turns_.resize(std::min(turns_.size(), at(missing)));
  for (const LowCorner& low : turns_) chosen_.push_back(low.index);
  std::sort(chosen_.begin(), chosen_.end());
}

void CandidateChooser::choose_classic(std::span<const Corner> corners, const Cell& area,
                                      const FeatureSettings& settings) {
  const int threshold_high = settings.threshold_high;
  assign_regions(corners, area, settings.region_size);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i].score >= threshold_high) ++high_count_[at(region_of_[i])];
  }
  for (int i = 0; i < static_cast<int>(corners.size()); ++i) {
    if (corners[at(i)].score >= threshold_high || high_count_[at(region_of_[at(i)])] == 0)
      chosen_.push_back(i);
  }
}

const std::vector<Candidate>& CandidateChooser::choose(std::span<const Corner> corners, const Cell& area,
                                                       int budget, const FeatureSettings& settings) {
  chosen_.clear();
  candidates_.clear();
  if (settings.selection == Selection::improved) {
    choose_improved(corners, area, budget, settings);
  } else {
    choose_classic(corners, area, settings);
  }
  for (const int i : chosen_) {
    const Corner& corner = corners[at(i)];
    const bool high = corner.score >= settings.threshold_high;
    candidates_.push_back({corner.x, corner.y, corner.score,
                           high ? KeypointQuality::high : KeypointQuality::low,
                           static_cast<float>(corner.score)});
  }
  return candidates_;
}

}  // namespace stdc
