#include "report/json/series_json.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace stdc::app {
namespace {

/// The smallest of 1, 2, 5 times a power of ten that is not below `step`.
double nice_step(double step) {
  const double power = std::pow(10.0, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= step * (1 - 1e-9)) return factor * power;
  }
  return 10 * power;
}

std::optional<double> picked(std::span<const std::optional<double>> values, Pick pick) {
  std::optional<double> best;
  for (const std::optional<double>& value : values) {
    if (!value || !std::isfinite(*value)) continue;
    if (!best) {
      best = value;
    } else if (pick == Pick::largest) {
      best = std::max(*best, *value);
    } else if (pick == Pick::smallest) {
      best = std::min(*best, *value);
    }
  }
  return best;
}

}  // namespace

int values_per_point(std::size_t count) {
  return static_cast<int>((count + kMaxPoints - 1) / kMaxPoints) + (count == 0 ? 1 : 0);
}

double rounded(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  const double result = std::round(value * scale) / scale;
  return result == 0 ? 0 : result;  // no -0
}

nlohmann::ordered_json column(std::span<const std::optional<double>> values, int every, Pick pick,
                              int decimals) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  bool any = false;
  const auto step = static_cast<std::size_t>(every);
  for (std::size_t i = 0; i < values.size(); i += step) {
    const auto value = picked(values.subspan(i, std::min(step, values.size() - i)), pick);
    any = any || value;
    list.push_back(value ? nlohmann::ordered_json(rounded(*value, decimals)) : nullptr);
  }
  return any ? list : nullptr;
}

nlohmann::ordered_json histogram(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return nullptr;
  constexpr double kBins = 36;
  std::sort(values.begin(), values.end());
  const double nearly_all = values[(values.size() - 1) * 99 / 100];
  const double end = std::min(values.back(), 1.5 * nearly_all);
  const double step = nice_step(std::max(end / kBins, 1e-6));
  const auto bins = static_cast<std::size_t>(std::floor(end / step)) + 1;
  std::vector<int> counts(bins, 0);
  for (const double value : values) {
    ++counts[std::min(bins - 1, static_cast<std::size_t>(std::max(0.0, value) / step))];
  }
  return {{"start", 0},
          {"step", step},
          {"counts", counts},
          {"more", values.back() >= step * static_cast<double>(bins)}};
}

nlohmann::ordered_json percentiles(std::vector<double> values, int decimals) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return nullptr;
  std::sort(values.begin(), values.end());
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i <= 100; ++i) {
    list.push_back(rounded(values[(values.size() - 1) * i / 100], decimals));
  }
  return list;
}

}  // namespace stdc::app
