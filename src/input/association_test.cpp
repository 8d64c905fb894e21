#include "input/association.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "core/random.hpp"

namespace stdc {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

/// The definition: all pairs, sorted by difference, taken if both are free.
Pairs brute_force(const std::vector<double>& a, const std::vector<double>& b, double maximum) {
  std::vector<std::tuple<double, int, int>> all;
  for (int i = 0; i < static_cast<int>(a.size()); ++i) {
    for (int j = 0; j < static_cast<int>(b.size()); ++j) {
      const double difference = std::abs(a[i] - b[j]);
      if (difference <= maximum) all.emplace_back(difference, i, j);
    }
  }
  std::sort(all.begin(), all.end());
  std::set<int> used_a, used_b;
  Pairs pairs;
  for (const auto& [difference, i, j] : all) {
    if (used_a.count(i) + used_b.count(j) > 0) continue;
    used_a.insert(i);
    used_b.insert(j);
    pairs.emplace_back(i, j);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Increasing times on a grid of 1/1024 s, so that differences are exact and ties are frequent.
std::vector<double> random_times(Random& random, int count, int max_step) {
  std::vector<double> times;
  double time = random.below(20) / 1024.0;
  for (int i = 0; i < count; ++i) {
    times.push_back(time);
    time += (1 + random.below(static_cast<std::uint32_t>(max_step))) / 1024.0;
  }
  return times;
}

TEST(AssociateTimes, EqualsTheDefinition) {
  Random random(1);
  for (int trial = 0; trial < 500; ++trial) {
    const auto a = random_times(random, static_cast<int>(random.below(40)), 1 + trial % 60);
    const auto b = random_times(random, static_cast<int>(random.below(40)), 1 + trial % 45);
    EXPECT_EQ(associate_times(a, b, 20 / 1024.0), brute_force(a, b, 20 / 1024.0)) << trial;
  }
}

TEST(AssociateTimes, TakesTheNearestFirst) {
  const std::vector<double> a{0.000, 0.015}, b{0.010};
  EXPECT_EQ(associate_times(a, b, 0.02), (Pairs{{1, 0}}));
}

TEST(AssociateTimes, HandlesEmptyListsAndNoPairs) {
  const std::vector<double> a{1, 2}, none;
  EXPECT_TRUE(associate_times(a, none, 1).empty());
  EXPECT_TRUE(associate_times(none, none, 1).empty());
  EXPECT_TRUE(associate_times(a, std::vector<double>{1.5, 9}, 0.1).empty());
}

TEST(AssociateTimes, IsFastWhereAllTimesAreNear) {
  std::vector<double> a, b;
  for (int i = 0; i < 100000; ++i) {
    a.push_back(i * 1e-8);
    b.push_back(i * 1e-8 + 3e-9);
  }
  EXPECT_EQ(associate_times(a, b, 0.02).size(), a.size());
}

}  // namespace
}  // namespace stdc
