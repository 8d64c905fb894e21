#include "report/loop_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/quantiles.hpp"

namespace stdc::app {
namespace {

/// Quantiles of one number of all loops.
nlohmann::ordered_json quantiles_of(const std::vector<LoopRecord::Entry>& loops, auto LoopReport::*number) {
  std::vector<double> values;
  for (const LoopRecord::Entry& loop : loops) values.push_back(loop.report.*number);
  return to_json(quantiles(std::move(values)));
}

}  // namespace

void LoopRecord::add(const TrackingResult& result) {
  if (result.place_recognition_ms) recognition_.push_back(*result.place_recognition_ms);
  if (result.loop) loops_.push_back({*result.loop, result.timestamp});
}

int LoopRecord::merges() const {
  return static_cast<int>(
      std::count_if(loops_.begin(), loops_.end(), [](const Entry& loop) { return loop.report.merged; }));
}

nlohmann::ordered_json LoopRecord::to_json() const {
  if (recognition_.empty() && loops_.empty()) return nullptr;
  return {{"place_recognition_ms", app::to_json(quantiles(recognition_))},
          {"detection_ms", quantiles_of(loops_, &LoopReport::detection_ms)},
          {"correction_ms", quantiles_of(loops_, &LoopReport::correction_ms)},
          {"keyframes", quantiles_of(loops_, &LoopReport::keyframes)},
          {"fused_landmarks", quantiles_of(loops_, &LoopReport::fused)}};
}

std::string LoopRecord::text() const {
  if (loops_.empty()) return "";
  std::vector<double> times;
  for (const Entry& loop : loops_) times.push_back(loop.report.correction_ms);
  const double longest = *std::max_element(times.begin(), times.end());
  return fmt::format("loops closed: {}, maps merged: {}; correction {} ms (median; longest: {:.0f})\n",
                     loops(), merges(), to_text(quantiles(std::move(times)).median, 0), longest);
}

}  // namespace stdc::app
