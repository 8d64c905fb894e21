#include "report/loop_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/quantiles.hpp"

namespace stdc::app {

void LoopRecord::add(const TrackingResult& result) {
  if (result.place_recognition_ms) recognition_.push_back(*result.place_recognition_ms);
  if (result.loop) add(*result.loop);
}

void LoopRecord::add(const LoopReport& loop) {
  merges_ += loop.merged ? 1 : 0;
  detection_.push_back(loop.detection_ms);
  correction_.push_back(loop.correction_ms);
  keyframes_.push_back(loop.keyframes);
  fused_.push_back(loop.fused);
}

nlohmann::ordered_json LoopRecord::to_json() const {
  if (recognition_.empty() && detection_.empty()) return nullptr;
  return {{"place_recognition_ms", app::to_json(quantiles(recognition_))},
          {"detection_ms", app::to_json(quantiles(detection_))},
          {"correction_ms", app::to_json(quantiles(correction_))},
          {"keyframes", app::to_json(quantiles(keyframes_))},
          {"fused_landmarks", app::to_json(quantiles(fused_))}};
}

std::string LoopRecord::text() const {
  if (correction_.empty()) return "";
  const double longest = *std::max_element(correction_.begin(), correction_.end());
  return fmt::format("loops closed: {}, maps merged: {}; correction {} ms (median; longest: {:.0f})\n",
                     loops(), merges(), to_text(quantiles(correction_).median, 0), longest);
}

}  // namespace stdc::app
