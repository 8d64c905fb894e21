#pragma once

#include <optional>
#include <vector>

namespace stdc {

/// An answer of a search: how sure it is, and whether it is right.
struct ScoredAnswer {
  double score = 0;
  bool right = false;
};

/// What comes of taking only answers with at least some score.
struct PrecisionRecallPoint {
  double score = 0;
  double precision = 0;  ///< right among those taken
  double recall = 0;     ///< right and taken, among all that there was to find; 0 if that was nothing
};

struct PrecisionRecall {
  std::vector<PrecisionRecallPoint> curve;  ///< one point for each score that occurs, falling
  /// Area under the curve, by steps; nothing if there was nothing to find.
  std::optional<double> average_precision;
  /// The most that is found while no answer is wrong; nothing if there was nothing to find.
  std::optional<double> recall_without_error;
  std::optional<double> best_wrong_score;  ///< nothing if no answer is wrong
};

/// Precision and recall of scored answers over all thresholds (average precision as in information retrieval:
/// Manning, Raghavan and Schuetze, 'Introduction to Information Retrieval', 2008, ch. 8). Answers with equal
/// scores are taken together.
/// @param possible  how many right answers there are to be had
PrecisionRecall precision_recall(std::vector<ScoredAnswer> answers, int possible);

}  // namespace stdc
