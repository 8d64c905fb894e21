#include "motion/depth_noise.hpp"

#include <algorithm>
#include <vector>

namespace stdc {

void DepthNoise::Frame::add(float gap) {
  ++all_;
  if (gap <= 0) return;
  const int step = static_cast<int>(gap * kSteps);
  ++counts_[static_cast<std::size_t>(std::min(step, kSteps))];
}

float DepthNoise::Frame::level() const {
  constexpr int kOneIn = 1000;
  int above = 0;
  for (int step = kSteps - 1; step >= 0; --step) {
    above += counts_[static_cast<std::size_t>(step)];
    if (above * kOneIn > all_) return static_cast<float>(step + 1) / kSteps;
  }
  return 0;
}

void DepthNoise::add(double timestamp, const Frame& frame) {
  constexpr double kSpan = 3,
                   kKnown = 2.9;  // [s] a camera may begin at rest, which shows less than its motion
  constexpr float kReserve = 3.0F, kMin = 0.4F;
  entries_.push_back({timestamp, frame.level()});
  while (entries_.front().timestamp < timestamp - kSpan) entries_.pop_front();
  factor_ = 1;
  if (timestamp - entries_.front().timestamp < kKnown) return;
  std::vector<float> levels;
  for (const Entry& entry : entries_) levels.push_back(entry.level);
  // Most, not all: what begins to move now must not raise it.
  const auto most = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() * 4 / 5);
  std::nth_element(levels.begin(), most, levels.end());
  factor_ = std::clamp(kReserve * *most, kMin, 1.0F);
}

}  // namespace stdc
