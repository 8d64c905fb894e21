#include "report/run_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/json/frames_json.hpp"
#include "report/result_text.hpp"
#include "report/score_report.hpp"

namespace stdc::app {
namespace {

using Lines = std::vector<std::string>;

/// What a sentence begins with.
std::string capital(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z')
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  return text + ".";
}

std::string frames_text(int count) { return count == 1 ? "1 frame" : fmt::format("{} frames", count); }

void warn_of_coverage(const RunSummary& summary, const RunRecord& record, Lines& lines) {
  const StatusCounts& counts = record.counts();
  constexpr double kMinCoverage = 0.99;
  const double coverage = static_cast<double>(summary.poses) / std::max(1, counts.total());
  if (summary.poses == 0) {
    lines.emplace_back("Not one frame got a pose: check images, depth and camera.");
    return;
  }
  if (coverage < kMinCoverage) {
    std::string why;
    const auto add = [&](int count, const char* what) {
      if (count > 0) why += fmt::format("{}{} {}", why.empty() ? ": " : ", ", count, what);
    };
    add(counts.lost, "lost");
    add(counts.uncertain, "uncertain");
    add(counts.initialising, "before the first map");
    add(counts.skipped, "skipped");
    add(summary.poses_elsewhere, "in other maps");
    lines.push_back(
        fmt::format("Only {:.1f} % of the frames are in the trajectory{}. A small error over part of the "
                    "path says little.",
                    100 * coverage, why));
  }
  if (summary.maps > 1) {
    lines.push_back(fmt::format(
        "There are {} maps that were not joined: the trajectory is that of the one that holds most frames.",
        summary.maps));
  }
}

/// The longest stretches of one kind, in words.
void warn_of_bands(TrackingStatus status, const char* meaning, const RunRecord& record, Lines& lines) {
  std::vector<StatusBand> bands = status_bands(record.results());
  std::erase_if(bands, [&](const StatusBand& band) { return band.status != status; });
  if (bands.empty()) return;
  int frames = 0;
  for (const StatusBand& band : bands) frames += band.frames;
  std::stable_sort(bands.begin(), bands.end(),
                   [](const StatusBand& a, const StatusBand& b) { return a.frames > b.frames; });
  constexpr std::size_t kMax = 3;
  const double start = record.results().front().timestamp;
  std::string text =
      fmt::format("{} {} {}: ", frames_text(frames), frames == 1 ? "is" : "are", status_name(status));
  for (std::size_t i = 0; i < std::min(kMax, bands.size()); ++i) {
    text += fmt::format("{}{:.2f} to {:.2f} s ({})", i > 0 ? ", " : "", bands[i].from - start,
                        bands[i].to - start, frames_text(bands[i].frames));
  }
  if (bands.size() > kMax) text += fmt::format(" and {} shorter stretches", bands.size() - kMax);
  lines.push_back(text + fmt::format(". {}", meaning));
}

void warn_of_pace(const RunRecord& record, Lines& lines) {
  const auto period = frame_period(record.results());
  if (!period) return;
  constexpr double kMaxShare = 0.01;
  int slow = 0, tracked = 0;
  double longest = 0;
  for (const TrackingResult& result : record.results()) {
    if (result.status == TrackingStatus::skipped) continue;
    ++tracked;
    longest = std::max(longest, result.milliseconds.total);
    slow += result.milliseconds.total > 1e3 * *period ? 1 : 0;
  }
  const double share = static_cast<double>(slow) / std::max(1, tracked);
  if (share <= kMaxShare) return;
  lines.push_back(fmt::format(
      "{:.0f} % of the frames took longer than the {:.1f} ms from one frame to the next (the "
      "longest {:.0f} ms): in real time poses would come late. Try --set segmentation.pace=asynchronous.",
      100 * share, 1e3 * *period, longest));
}

void warn_of_truth(const RunSummary& summary, Lines& lines) {
  if (!summary.score.warning.empty()) lines.push_back(capital(summary.score.warning));
  if (!summary.truth) return;
  if (const std::string note = summary.truth->note(); !note.empty()) {
    lines.push_back(fmt::format("Of the ground truth {}.", note));
  }
  if (!summary.score.scores) return;
  const TrajectoryScores& scores = *summary.score.scores;
  if (scores.off_by_5_cm > 0) {
    lines.push_back(
        fmt::format("{} of {} poses are more than 5 cm off the ground truth, the worst {:.0f} cm.",
                    scores.off_by_5_cm, scores.pairs, 100 * scores.ate.maximum));
  }
  if (std::string warning = scale_warning(scores); !warning.empty()) lines.push_back(std::move(warning));
}

void warn_of_frames(const RunSummary& summary, const RunRecord& record, Lines& lines) {
  const int colour = summary.colour_without_depth + record.counts().total();
  if (summary.colour_without_depth > colour / 10) {
    lines.push_back(
        fmt::format("{} of {} colour images have no depth image near them in time: they are left out.",
                    summary.colour_without_depth, colour));
  }
  const auto period = frame_period(record.results());
  int gaps = 0, without_mask = 0;
  double longest = 0;
  for (std::size_t i = 0; i < record.results().size(); ++i) {
    const TrackingResult& result = record.results()[i];
    without_mask += result.segmentation && result.segmentation->mask_age < 0 ? 1 : 0;
    const double interval = i > 0 ? result.timestamp - record.results()[i - 1].timestamp : 0;
    gaps += period && interval > 2.5 * *period ? 1 : 0;
    longest = std::max(longest, interval);
  }
  if (gaps > 0) {
    lines.push_back(fmt::format(
        "{} of the input, the longest of {:.2f} s: tracking may be lost there.",
        gaps == 1 ? "There is a gap in the times" : fmt::format("There are {} gaps in the times", gaps),
        longest));
  }
  if (without_mask > 0)
    lines.push_back(fmt::format("{} had no mask of what moves.", frames_text(without_mask)));
}

}  // namespace

std::vector<std::string> run_warnings(const RunSummary& summary, const RunRecord& record,
                                      const std::vector<std::string>& about_depth) {
  Lines lines;
  warn_of_coverage(summary, record, lines);
  warn_of_bands(
      TrackingStatus::uncertain,
      "Too little of the static scene agrees with their poses, which are no part of the trajectory.", record,
      lines);
  warn_of_bands(TrackingStatus::lost, "They have no pose.", record, lines);
  for (const std::string& line : about_depth) lines.push_back(capital(line));
  warn_of_truth(summary, lines);
  warn_of_frames(summary, record, lines);
  warn_of_pace(record, lines);
  return lines;
}

}  // namespace stdc::app
