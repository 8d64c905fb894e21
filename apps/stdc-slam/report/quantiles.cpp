#include "report/quantiles.hpp"

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
  return {{"median", q.median}, {"p95", q.p95}, {"p99", q.p99}};
}

}  // namespace stdc::app
