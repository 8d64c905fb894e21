#include "report/json/series_json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace stdc::app {
namespace {

using Json = nlohmann::ordered_json;
using Values = std::vector<std::optional<double>>;

TEST(SeriesJson, PicksOneOfSeveral) {
  const Values values{1.0, 5.0, std::nullopt, 2.0, std::nullopt, std::nullopt, 3.00004};
  EXPECT_EQ(column(values, 1, Pick::first, 4), Json({1, 5, nullptr, 2, nullptr, nullptr, 3}));
  EXPECT_EQ(column(values, 2, Pick::largest, 1), Json({5, 2, nullptr, 3}));
  EXPECT_EQ(column(values, 4, Pick::smallest, 1), Json({1, 3}));
  EXPECT_TRUE(column(Values(3), 1, Pick::first, 1).is_null()) << "nothing is known";
}

TEST(SeriesJson, AtMostSoManyPoints) {
  EXPECT_EQ(values_per_point(0), 1);
  EXPECT_EQ(values_per_point(kMaxPoints), 1);
  EXPECT_EQ(values_per_point(kMaxPoints + 1), 2);
}

TEST(SeriesJson, HistogramsCountEveryValue) {
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(0.01 * i);
  values.push_back(1e6);  // one bad frame must not hide the rest
  const Json h = histogram(values);
  int sum = 0;
  for (const Json& count : h["counts"]) sum += count.get<int>();
  EXPECT_EQ(sum, 1001);
  EXPECT_LT(h["counts"].size(), 60U);
  EXPECT_LT(h["step"], 1);
  EXPECT_EQ(h["more"], true);
  EXPECT_TRUE(histogram({}).is_null());
  EXPECT_EQ(histogram({0, 0})["counts"], Json({2}));
}

TEST(SeriesJson, PercentilesAreValuesThatCame) {
  const Json p = percentiles({3, 1, 2}, 1);
  EXPECT_EQ(p.size(), 101U);
  EXPECT_EQ(p[0], 1);
  EXPECT_EQ(p[50], 2);
  EXPECT_EQ(p[100], 3);
}

}  // namespace
}  // namespace stdc::app
