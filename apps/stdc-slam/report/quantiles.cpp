#include "report/quantiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace stdc::app {

Quantiles quantiles(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto rank = [&](double share) {
    const auto index = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
    return values[std::clamp<std::size_t>(index, 1, values.size()) - 1];
  };
  return {rank(0.5), rank(0.95), rank(0.99)};
}

nlohmann::ordered_json to_json(const Quantiles& q) {
  return {{"median", to_json(q.median)}, {"p95", to_json(q.p95)}, {"p99", to_json(q.p99)}};
}

nlohmann::ordered_json to_json(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

std::string to_text(const std::optional<double>& value, int decimals, double factor) {
  return value ? fmt::format("{:.{}f}", factor * *value, decimals) : "-";
}

}  // namespace stdc::app
