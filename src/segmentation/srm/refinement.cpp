#include "segmentation/srm/refinement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "segmentation/srm/refinement_kernel.hpp"

namespace stdc {
namespace {

void check_images(const cv::Mat& mask, const cv::Mat& depth) {
  if (mask.type() != CV_8UC1) throw Error("mask", "is not an 8-bit grey image", "give a CV_8UC1 image");
  if (depth.type() != CV_16UC1 && depth.type() != CV_32FC1) {
    throw Error("depth", "is neither 16-bit nor float", "give a CV_16UC1 or CV_32FC1 image");
  }
  if (mask.size() != depth.size()) {
    throw Error("mask",
                fmt::format("is {} x {} pixels, but the depth image has {} x {}", mask.cols, mask.rows,
                            depth.cols, depth.rows),
                "give images of the same frame");
  }
}

/// Whole units in tau. What rounding left just below a whole number (0.07 m * 5000) counts as that number.
std::uint16_t whole_units(double tau, double units_per_metre) {
  constexpr double kSlack = 1e-6, kMax = 65535;
  return static_cast<std::uint16_t>(std::clamp(std::floor(tau * units_per_metre + kSlack), 0.0, kMax));
}

/// The box around the dynamic pixels; empty if there are none. Copies the mask with 255 for those pixels.
cv::Rect copy_mask(const cv::Mat& mask, cv::Mat& result) {
  std::vector<std::uint8_t> columns(static_cast<std::size_t>(mask.cols), 0);
  int top = mask.rows, bottom = 0;
  for (int y = 0; y < mask.rows; ++y) {
    if (!copy_mask_row(mask.ptr(y), mask.cols, result.ptr(y), columns.data())) continue;
    top = std::min(top, y);
    bottom = y + 1;
  }
  if (bottom == 0) return {};
  const auto dynamic = [](std::uint8_t column) { return column != 0; };
  const auto left = std::find_if(columns.begin(), columns.end(), dynamic) - columns.begin();
  const auto right = columns.rend() - std::find_if(columns.rbegin(), columns.rend(), dynamic);
  return {static_cast<int>(left), top, static_cast<int>(right - left), bottom - top};
}

}  // namespace

void RefinementSettings::validate() const {
  check_ranges("refinement", *this);
  if (window % 2 == 0) {
    throw Error("refinement.window", fmt::format("{} is even", window),
                "give an odd number, so that the window has a middle");
  }
}

void refine(const cv::Mat& given, const cv::Mat& depth, double depth_units_per_metre,
            const RefinementSettings& settings, cv::Mat& result) {
  settings.validate();
  check_images(given, depth);
  const cv::Mat mask = given;  // keeps the pixels if `result` is the same image
  if (result.data == mask.data) result.release();
  result.create(mask.size(), CV_8UC1);
  const cv::Rect dynamic = copy_mask(mask, result);
  if (dynamic.empty()) return;
  RefinementTask task;
  task.radius = settings.window / 2;
  task.width = mask.cols;
  task.height = mask.rows;
  task.left = std::max(dynamic.x - task.radius, 0);
  task.top = std::max(dynamic.y - task.radius, 0);
  task.right = std::min(dynamic.br().x + task.radius, mask.cols);
  task.bottom = std::min(dynamic.br().y + task.radius, mask.rows);
  task.mask = mask.data;
  task.mask_stride = static_cast<std::ptrdiff_t>(mask.step[0]);
  task.depth = depth.data;
  task.depth_stride = static_cast<std::ptrdiff_t>(depth.step[0]);
  task.result = result.data;
  task.result_stride = static_cast<std::ptrdiff_t>(result.step[0]);
  if (depth.type() == CV_16UC1) {
    refine_task(task, whole_units(settings.tau, depth_units_per_metre));
  } else {
    refine_task(task, static_cast<float>(settings.tau));
  }
}

cv::Mat refine(const cv::Mat& mask, const cv::Mat& depth, double depth_units_per_metre,
               const RefinementSettings& settings) {
  cv::Mat result;
  refine(mask, depth, depth_units_per_metre, settings, result);
  return result;
}

}  // namespace stdc
