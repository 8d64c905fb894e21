#include "evaluation/precision_recall.hpp"

#include <algorithm>

namespace stdc {

PrecisionRecall precision_recall(std::vector<ScoredAnswer> answers, int possible) {
  PrecisionRecall result;
  std::stable_sort(answers.begin(), answers.end(),
                   [](const ScoredAnswer& a, const ScoredAnswer& b) { return a.score > b.score; });
  int right = 0, taken = 0;
  double recall_before = 0, area = 0, without_error = 0;
  for (std::size_t i = 0; i < answers.size();) {
    const double score = answers[i].score;
    for (; i < answers.size() && answers[i].score == score; ++i) {
      ++taken;
      right += answers[i].right ? 1 : 0;
    }
    const double precision = static_cast<double>(right) / taken;
    const double recall = possible > 0 ? static_cast<double>(right) / possible : 0.0;
    result.curve.push_back({score, precision, recall});
    area += precision * (recall - recall_before);
    recall_before = recall;
    if (right == taken) without_error = recall;
  }
  if (possible > 0) {
    result.average_precision = area;
    result.recall_without_error = without_error;
  }
  const auto wrong =
      std::find_if(answers.begin(), answers.end(), [](const ScoredAnswer& a) { return !a.right; });
  if (wrong != answers.end()) result.best_wrong_score = wrong->score;
  return result;
}

}  // namespace stdc
