#include "report/json/frames_json.hpp"

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "report/json/series_json.hpp"
#include "report/result_text.hpp"

namespace stdc::app {
namespace {

using Json = nlohmann::ordered_json;
using Values = std::vector<std::optional<double>>;

Values values_of(const std::vector<TrackingResult>& results,
                 const std::function<std::optional<double>(const TrackingResult&)>& value) {
  Values values;
  values.reserve(results.size());
  for (const TrackingResult& result : results) values.push_back(value(result));
  return values;
}

bool was_tracked(const TrackingResult& result) { return result.status != TrackingStatus::skipped; }

std::optional<double> time_of_frame(const TrackingResult& result) {
  return was_tracked(result) ? std::optional(result.milliseconds.total) : std::nullopt;
}

Values errors_of_frames(const std::vector<TrackingResult>& results, const std::vector<PoseError>& errors) {
  return values_of(results, [&](const TrackingResult& result) -> std::optional<double> {
    const auto found = std::lower_bound(errors.begin(), errors.end(), result.timestamp,
                                        [](const PoseError& e, double t) { return e.timestamp < t; });
    if (found == errors.end() || found->timestamp != result.timestamp) return std::nullopt;
    return 1e3 * found->distance;
  });
}

Values people(const std::vector<TrackingResult>& results) {
  return values_of(results, [](const TrackingResult& result) -> std::optional<double> {
    if (!result.segmentation || result.segmentation->mask_age < 0) return std::nullopt;
    return 100 * result.segmentation->dynamic_share;
  });
}

Values moving(const std::vector<TrackingResult>& results) {
  return values_of(results, [](const TrackingResult& result) -> std::optional<double> {
    return result.motion ? std::optional(100 * result.motion->dynamic_share) : std::nullopt;
  });
}

void put(Json& frames, const char* name, const Values& values, int every, Pick pick, int decimals) {
  Json list = column(values, every, pick, decimals);
  if (!list.is_null()) frames[name] = std::move(list);
}

Json columns(const RunRecord& record, const std::vector<PoseError>& errors, int every) {
  const std::vector<TrackingResult>& results = record.results();
  const double start = results.front().timestamp;
  Json frames = Json::object();
  put(frames, "time", values_of(results, [&](const TrackingResult& r) { return r.timestamp - start; }), every,
      Pick::first, kTimeDecimals);
  put(frames, "error_mm", errors_of_frames(results, errors), every, Pick::largest, 3);
  put(frames, "inliers", values_of(results, [](const TrackingResult& r) { return r.inliers; }), every,
      Pick::smallest, 0);
  put(frames, "people_percent", people(results), every, Pick::largest, 2);
  put(frames, "moving_percent", moving(results), every, Pick::largest, 2);
  put(frames, "total_ms", values_of(results, time_of_frame), every, Pick::largest, 2);
  const Values waits = values_of(results, [](const TrackingResult& r) { return r.milliseconds.mask_wait; });
  if (std::any_of(waits.begin(), waits.end(), [](const auto& wait) { return *wait > 0.01; })) {
    put(frames, "mask_wait_ms", waits, every, Pick::largest, 2);
  }
  if (record.lags().size() == results.size()) {
    put(frames, "lag_ms", {record.lags().begin(), record.lags().end()}, every, Pick::largest, 2);
  }
  return frames;
}

std::vector<double> known(const Values& values) {
  std::vector<double> list;
  for (const auto& value : values) {
    if (value) list.push_back(*value);
  }
  return list;
}

}  // namespace

std::vector<StatusBand> status_bands(const std::vector<TrackingResult>& results) {
  std::vector<StatusBand> bands;
  const TrackingResult* last = nullptr;
  for (const TrackingResult& result : results) {
    const bool counts = result.status == TrackingStatus::uncertain || result.status == TrackingStatus::lost;
    const bool goes_on = last != nullptr && last->status == result.status;
    if (!bands.empty() && last != nullptr && bands.back().to == last->timestamp &&
        last->status == bands.back().status) {
      bands.back().to = result.timestamp;
    }
    if (counts && !goes_on) bands.push_back({result.status, result.timestamp, result.timestamp, 0});
    if (counts) {
      bands.back().to = result.timestamp;
      ++bands.back().frames;
    }
    last = &result;
  }
  return bands;
}

std::optional<double> frame_period(const std::vector<TrackingResult>& results) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < results.size(); ++i) {
    const double interval = results[i].timestamp - results[i - 1].timestamp;
    if (interval > 0) intervals.push_back(interval);
  }
  if (intervals.empty()) return std::nullopt;
  return quantiles(std::move(intervals)).median;
}

void add_frames(Json& run, const RunRecord& record, const std::vector<PoseError>& errors) {
  const std::vector<TrackingResult>& results = record.results();
  if (results.empty()) return;
  run["first_time"] = rounded(results.front().timestamp, 6);
  run["duration_s"] = rounded(results.back().timestamp - results.front().timestamp, 3);
  const std::optional<double> period = frame_period(results);
  run["period_ms"] = period ? Json(rounded(1e3 * *period, 2)) : nullptr;
  const int every = values_per_point(results.size());
  run["every"] = every;
  run["frames"] = columns(record, errors, every);
  run["bands"] = Json::array();
  for (const StatusBand& band : status_bands(results)) {
    run["bands"].push_back({{"status", status_name(band.status)},
                            {"from", rounded(band.from - results.front().timestamp, kTimeDecimals)},
                            {"to", rounded(band.to - results.front().timestamp, kTimeDecimals)},
                            {"frames", band.frames}});
  }
  const std::vector<double> distances = known(errors_of_frames(results, errors));
  const std::vector<double> times = known(values_of(results, time_of_frame));
  run["histograms"] = {{"error_mm", histogram(distances)}, {"total_ms", histogram(times)}};
  run["quantiles"] = {{"error_mm", percentiles(distances, 3)}, {"total_ms", percentiles(times, 2)}};
}

void add_errors(Json& run, const std::vector<PoseError>& errors) {
  const double start = errors.front().timestamp;
  Values times, millimetres;
  for (const PoseError& error : errors) {
    times.emplace_back(error.timestamp - start);
    millimetres.emplace_back(1e3 * error.distance);
  }
  const int every = values_per_point(errors.size());
  run["first_time"] = rounded(start, 6);
  run["duration_s"] = rounded(errors.back().timestamp - start, 3);
  run["every"] = every;
  run["frames"] = Json::object();
  put(run["frames"], "time", times, every, Pick::first, kTimeDecimals);
  put(run["frames"], "error_mm", millimetres, every, Pick::largest, 3);
  run["histograms"] = {{"error_mm", histogram(known(millimetres))}};
  run["quantiles"] = {{"error_mm", percentiles(known(millimetres), 3)}};
}

}  // namespace stdc::app
