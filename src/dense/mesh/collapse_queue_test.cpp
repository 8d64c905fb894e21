#include "dense/mesh/collapse_queue.hpp"

#include <gtest/gtest.h>

#include "core/random.hpp"

namespace stdc {
namespace {

TEST(CollapseQueue, ThrowsOutWhatIsOutOfDateBeforeItGrows) {
  constexpr std::uint32_t kEdges = 50;
  std::vector<std::uint32_t> changes(kEdges, 0);
  const auto counts = [&](const CollapseCandidate& candidate) {
    return candidate.changes == changes[candidate.a];
  };
  CollapseQueue queue;
  queue.reserve(2 * kEdges);
  Random random(7);
  std::vector<double> costs(kEdges, 0);
  for (int i = 0; i < 10000; ++i) {
    const std::uint32_t edge = random.below(kEdges);
    costs[edge] = static_cast<double>(random.below(1000));
    queue.push({costs[edge], edge, edge + 1, ++changes[edge]}, counts);
    ASSERT_LE(queue.size(), 2 * kEdges);
  }
  std::vector<double> popped;
  while (!queue.empty()) {
    const CollapseCandidate next = queue.pop();
    if (counts(next)) popped.push_back(next.cost);
  }
  std::sort(costs.begin(), costs.end());
  EXPECT_EQ(popped, costs);
}

TEST(CollapseQueue, GrowsIfAllCount) {
  CollapseQueue queue;
  for (std::uint32_t i = 0; i < 1000; ++i)
    queue.push({static_cast<double>(i * 7 % 1000), i, i + 1, 0}, [](const auto&) { return true; });
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(queue.pop().cost, i);
}

}  // namespace
}  // namespace stdc
