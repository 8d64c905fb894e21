#include "evaluation/precision_recall.hpp"

#include <gtest/gtest.h>

namespace stdc {
namespace {

TEST(PrecisionRecall, FollowsTheThreshold) {
  const PrecisionRecall result =
      precision_recall({{0.2, false}, {0.9, true}, {0.5, false}, {0.7, true}, {0.3, true}}, 4);
  ASSERT_EQ(result.curve.size(), 5U);
  const std::vector<double> precision{1, 1, 2 / 3.0, 3 / 4.0, 3 / 5.0}, recall{0.25, 0.5, 0.5, 0.75, 0.75};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_DOUBLE_EQ(result.curve[i].precision, precision[i]);
    EXPECT_DOUBLE_EQ(result.curve[i].recall, recall[i]);
  }
  EXPECT_DOUBLE_EQ(result.average_precision.value(), 0.25 + 0.25 + 0.25 * 0.75);
  EXPECT_DOUBLE_EQ(result.recall_without_error.value(), 0.5);
  EXPECT_DOUBLE_EQ(result.best_wrong_score.value(), 0.5);
}

TEST(PrecisionRecall, EqualScoresAreTakenTogether) {
  for (const bool first : {true, false}) {
    const PrecisionRecall result = precision_recall({{0.5, first}, {0.5, !first}, {0.4, true}}, 2);
    ASSERT_EQ(result.curve.size(), 2U);
    EXPECT_DOUBLE_EQ(result.curve[0].precision, 0.5);
    EXPECT_DOUBLE_EQ(result.recall_without_error.value(), 0);
  }
}

TEST(PrecisionRecall, PerfectAndHopeless) {
  const PrecisionRecall perfect = precision_recall({{2, true}, {1, true}}, 2);
  EXPECT_DOUBLE_EQ(perfect.average_precision.value(), 1);
  EXPECT_DOUBLE_EQ(perfect.recall_without_error.value(), 1);
  EXPECT_FALSE(perfect.best_wrong_score);
  EXPECT_DOUBLE_EQ(precision_recall({{2, false}, {1, false}}, 2).average_precision.value(), 0);
}

TEST(PrecisionRecall, NothingAskedOrNothingToFind) {
  EXPECT_TRUE(precision_recall({}, 3).curve.empty());
  EXPECT_DOUBLE_EQ(precision_recall({}, 3).average_precision.value(), 0);
  EXPECT_DOUBLE_EQ(precision_recall({{1, false}}, 0).curve[0].recall, 0);
}

}  // namespace
}  // namespace stdc
