#include "input/survey/edge_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace stdc {
namespace {

constexpr int kWidth = 320;        // [px] of the images that are compared
constexpr double kMinEdges = 400;  // depth edge pixels, of all images
constexpr float kMinStep = 0.05F;  // relative step of depth that is an edge

/// Size of the colour gradient, cut off so that a few strong edges do not decide alone.
cv::Mat colour_edges(const cv::Mat& colour, cv::Size size) {
  cv::Mat grey = colour, small, dx, dy, edges;
  if (colour.channels() == 3) cv::cvtColor(colour, grey, cv::COLOR_BGR2GRAY);
  cv::resize(grey, small, size, 0, 0, cv::INTER_AREA);
  cv::Sobel(small, dx, CV_32F, 1, 0);
  cv::Sobel(small, dy, CV_32F, 0, 1);
  cv::magnitude(dx, dy, edges);
  constexpr double kMaxEdge = 200;
  return cv::min(edges, kMaxEdge);
}

/// 1 where the nearer side of a step of depth ends.
cv::Mat depth_edges(const cv::Mat& depth, cv::Size size) {
  cv::Mat metric, small;
  depth.convertTo(metric, CV_32F);
  cv::resize(metric, small, size, 0, 0, cv::INTER_NEAREST);
  cv::Mat edges(size, CV_8UC1, cv::Scalar(0));
  const auto ends = [](float here, float beside) { return here > 0 && beside > here * (1 + kMinStep); };
  for (int y = 1; y + 1 < size.height; ++y) {
    for (int x = 1; x + 1 < size.width; ++x) {
      const float here = small.at<float>(y, x);
      edges.at<std::uint8_t>(y, x) =
          ends(here, small.at<float>(y, x - 1)) || ends(here, small.at<float>(y, x + 1)) ||
          ends(here, small.at<float>(y - 1, x)) || ends(here, small.at<float>(y + 1, x));
    }
  }
  return edges;
}

}  // namespace

void EdgeAlignment::add(const cv::Mat& colour, const cv::Mat& depth) {
  pixels_ = static_cast<double>(colour.cols) / kWidth;
  const cv::Size size(kWidth, std::max(8, static_cast<int>(std::lround(colour.rows / pixels_))));
  const cv::Mat seen = colour_edges(colour, size), measured = depth_edges(depth, size);
  vote(seen, measured, cv::Range(0, kWidth), all_);
  vote(seen, measured, cv::Range(0, kWidth / 3), left_);
  vote(seen, measured, cv::Range(2 * kWidth / 3, kWidth), right_);
}

void EdgeAlignment::vote(const cv::Mat& colour_edges, const cv::Mat& depth_edges, cv::Range columns,
                         Votes& votes) const {
  const int reach = max_shift_ / 2;
  if (votes.sums.empty()) votes.sums = cv::Mat(2 * reach + 1, 2 * reach + 1, CV_64FC1, cv::Scalar(0));
  // Only edges whose every shift lies in the image, so that all shifts have as many.
  for (int y = reach; y < depth_edges.rows - reach; ++y) {
    for (int x = std::max(columns.start, reach); x < std::min(columns.end, depth_edges.cols - reach); ++x) {
      if (depth_edges.at<std::uint8_t>(y, x) == 0) continue;
      ++votes.edges;
      for (int dy = -reach; dy <= reach; ++dy) {
        const float* row = colour_edges.ptr<float>(y + dy) + x;
        double* sums = votes.sums.ptr<double>(dy + reach);
        for (int dx = -reach; dx <= reach; ++dx) sums[dx + reach] += row[dx];
      }
    }
  }
}

std::optional<EdgeShift> EdgeAlignment::best(const Votes& votes) const {
  if (votes.edges < kMinEdges) return std::nullopt;
  cv::Mat smooth;
  cv::GaussianBlur(votes.sums, smooth, {3, 3}, 0);
  double top = 0;
  cv::Point at;
  cv::minMaxLoc(smooth, nullptr, &top, nullptr, &at);
  cv::Scalar mean, deviation;
  cv::meanStdDev(smooth, mean, deviation);
  const int reach = max_shift_ / 2;
  const double here = smooth.at<double>(reach, reach);
  EdgeShift shift;
  // To move depth by `at` means that it lies by that much on the other side.
  shift.x = -(at.x - reach) * pixels_;
  shift.y = -(at.y - reach) * pixels_;
  shift.gain = here > 0 ? top / here - 1 : 0;
  shift.clarity = deviation[0] > 0 ? (top - mean[0]) / deviation[0] : 0;
  return shift;
}

std::optional<EdgeShift> EdgeAlignment::shift() const { return best(all_); }
std::optional<EdgeShift> EdgeAlignment::left_shift() const { return best(left_); }
std::optional<EdgeShift> EdgeAlignment::right_shift() const { return best(right_); }

}  // namespace stdc
