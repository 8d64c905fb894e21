#include "report/segment_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stdc::app {
namespace {

/// Of at least one value.
double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(std::lround(share * last))];
}

std::string percent(const std::optional<double>& score) {
  return score ? fmt::format("{:.1f} %", 100 * *score) : std::string("-");
}

std::string cell(const std::optional<double>& score) {
  return score ? fmt::format("{:.6f}", *score) : std::string();
}

std::string score_line(const char* title, const MaskScores& scores) {
  return fmt::format("{:<11}{:>8}{:>12}{:>9}{:>13}\n", title, percent(scores.iou), percent(scores.precision),
                     percent(scores.recall), percent(scores.boundary_f));
}

}  // namespace

std::string segments_csv(const std::vector<SegmentedImage>& images, const std::vector<std::string>& classes) {
  std::string text = "image,dynamic_share,wall_ms,cpu_ms,iou,precision,recall,boundary_f";
  for (const std::string& name : classes) text += ",share_" + name;
  text += '\n';
  for (const SegmentedImage& image : images) {
    const MaskScores scores = image.counts ? score_mask(*image.counts) : MaskScores{};
    text += fmt::format("{},{:.6f},{:.3f},{:.3f},{},{},{},{}", image.name, image.dynamic_share, image.wall_ms,
                        image.cpu_ms, cell(scores.iou), cell(scores.precision), cell(scores.recall),
                        cell(scores.boundary_f));
    for (const double share : image.class_shares) text += fmt::format(",{:.6f}", share);
    text += '\n';
  }
  return text;
}

std::string segment_summary(const std::vector<SegmentedImage>& images,
                            const std::vector<std::string>& classes) {
  std::vector<double> wall, cpu;
  std::vector<MaskScores> scores;
  MaskCounts sum;
  double dynamic = 0;
  for (const SegmentedImage& image : images) {
    dynamic += image.dynamic_share / static_cast<double>(images.size());
    wall.push_back(image.wall_ms);
    cpu.push_back(image.cpu_ms);
    if (!image.counts) continue;
    scores.push_back(score_mask(*image.counts));
    sum += *image.counts;
  }
  constexpr double kP95 = 0.95;
  const double median = quantile(wall, 0.5);
  std::string text = fmt::format(
      "images      {}\ntime        {:.1f} ms median, {:.1f} ms p95 ({:.1f} ms CPU median, min {:.1f} ms)\n"
      "rate        {:.1f} images per second at the median\ndynamic     {:.2f} % of the pixels\n",
      images.size(), median, quantile(wall, kP95), quantile(cpu, 0.5), quantile(cpu, 0),
      1000 / std::max(median, 1e-6), 100 * dynamic);
  for (std::size_t k = 0; k < classes.size(); ++k) {
    double share = 0;
    for (const SegmentedImage& image : images)
      share += image.class_shares[k] / static_cast<double>(images.size());
    text += fmt::format("  {:<10}{:.2f} %\n", classes[k], 100 * share);
  }
  if (scores.empty()) return text;
  text += fmt::format("scored      {} images\n{:<11}{:>8}{:>12}{:>9}{:>13}\n", scores.size(), "", "IoU",
                      "precision", "recall", "boundary F");
  text += score_line("mean", mean_scores(scores));
  text += score_line("all pixels", score_mask(sum));
  return text;
}

}  // namespace stdc::app
