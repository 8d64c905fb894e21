#include "evaluation/mask_score.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"

namespace stdc {
namespace {

/// Pixels of a region (255) that touch the outside with one of their four sides; the image's border is no
/// outside.
cv::Mat outline(const cv::Mat& region) {
  cv::Mat inner;
  cv::erode(region, inner, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}), {-1, -1}, 1,
            cv::BORDER_CONSTANT, cv::Scalar(255));
  return region & ~inner;
}

/// 255 for all pixels within `radius` of one that is not 0.
cv::Mat near(const cv::Mat& points, double radius) {
  cv::Mat distance;
  if (cv::countNonZero(points) == 0) return cv::Mat::zeros(points.size(), CV_8UC1);
  cv::distanceTransform(points == 0, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return distance <= radius;
}

std::optional<double> ratio(double part, double whole) {
  if (whole == 0) return std::nullopt;
  return part / whole;
}

}  // namespace

MaskCounts& MaskCounts::operator+=(const MaskCounts& other) {
  both += other.both;
  mask_only += other.mask_only;
  truth_only += other.truth_only;
  mask_boundary += other.mask_boundary;
  mask_boundary_near += other.mask_boundary_near;
  truth_boundary += other.truth_boundary;
  truth_boundary_near += other.truth_boundary_near;
  return *this;
}

MaskCounts count_mask(const cv::Mat& mask, const cv::Mat& truth, const cv::Mat& ignore) {
  const auto fits = [&](const cv::Mat& image) {
    return image.size() == mask.size() && image.type() == CV_8UC1;
  };
  if (mask.empty() || !fits(mask) || !fits(truth) || (!ignore.empty() && !fits(ignore))) {
    throw Error("masks to compare", "differ in size or are not CV_8UC1", "give masks of the same image");
  }
  const cv::Mat counted =
      ignore.empty() ? cv::Mat(mask.size(), CV_8UC1, cv::Scalar(255)) : cv::Mat(ignore == 0);
  const cv::Mat found = (mask != 0) & counted, wanted = (truth != 0) & counted;
  MaskCounts counts;
  counts.both = cv::countNonZero(found & wanted);
  counts.mask_only = cv::countNonZero(found & ~wanted);
  counts.truth_only = cv::countNonZero(wanted & ~found);

  constexpr double kShareOfDiagonal = 0.008;
  const double radius = std::ceil(kShareOfDiagonal * std::hypot(mask.cols, mask.rows));
  cv::Mat mask_outline = outline(mask != 0), truth_outline = outline(truth != 0);
  if (!ignore.empty()) {
    const cv::Mat doubtful = near(ignore, radius);
    mask_outline &= ~doubtful;
    truth_outline &= ~doubtful;
  }
  counts.mask_boundary = cv::countNonZero(mask_outline);
  counts.truth_boundary = cv::countNonZero(truth_outline);
  counts.mask_boundary_near = cv::countNonZero(mask_outline & near(truth_outline, radius));
  counts.truth_boundary_near = cv::countNonZero(truth_outline & near(mask_outline, radius));
  return counts;
}

MaskScores score_mask(const MaskCounts& counts) {
  const auto both = static_cast<double>(counts.both), more = static_cast<double>(counts.mask_only),
             less = static_cast<double>(counts.truth_only);
  MaskScores scores{ratio(both, both + more + less), ratio(both, both + more), ratio(both, both + less), {}};
  const auto precise =
      ratio(static_cast<double>(counts.mask_boundary_near), static_cast<double>(counts.mask_boundary));
  const auto complete =
      ratio(static_cast<double>(counts.truth_boundary_near), static_cast<double>(counts.truth_boundary));
  if (precise && complete) {
    const double sum = *precise + *complete;
    scores.boundary_f = sum > 0 ? 2 * *precise * *complete / sum : 0;
  } else if (precise || complete) {
    scores.boundary_f = 0;  // one has an outline, the other has none
  }
  return scores;
}

MaskScores mean_scores(const std::vector<MaskScores>& scores) {
  MaskScores means;
  for (const auto member :
       {&MaskScores::iou, &MaskScores::precision, &MaskScores::recall, &MaskScores::boundary_f}) {
    double sum = 0;
    int count = 0;
    for (const MaskScores& one : scores) {
      if (!(one.*member)) continue;
      sum += *(one.*member);
      ++count;
    }
    if (count > 0) means.*member = sum / count;
  }
  return means;
}

}  // namespace stdc
