// A map that begins while things come in and the camera sets off: whatever map a frame is in, a pose that is
// called ok is right.
#include <gtest/gtest.h>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <opencv2/imgproc.hpp>

#include "core/random.hpp"
#include "slam/test_board.hpp"
#include "slam/test_walk.hpp"

namespace stdc {
namespace {

using test::Board;
using test::Walk;

struct BusyStart {
  int seed, left_width, right_width, left_step, right_step, first, begin, direction;
  double left_depth = 1, right_depth = 1.2, contrast = 1;
};

TEST(MotionStart, Scratch) {
  std::vector<BusyStart> cases;
  const int only = getenv("ONLY") ? atoi(getenv("ONLY")) : -1;
  const int count = getenv("COUNT") ? atoi(getenv("COUNT")) : 24;
  cases.push_back({20, 70, 60, 8, 7, 1, 0, 1});
  Random random(77);
  while ((int)cases.size() < count) {
    BusyStart c{};
    c.seed = 100 + cases.size();
    c.left_width = 50 + random.below(120);
    c.right_width = 40 + random.below(100);
    c.left_step = 3 + random.below(10);
    c.right_step = 3 + random.below(10);
    c.first = random.below(6);
    c.direction = random.below(2) ? 1 : -1;
    c.begin = c.direction > 0 ? random.below(70) : 119 - random.below(70);
    c.left_depth = 0.7 + 0.01 * random.below(80);
    c.right_depth = 0.7 + 0.01 * random.below(80);
    c.contrast = random.below(2) ? 1 : 0.4;
    cases.push_back(c);
  }
  for (int k = 0; k < (int)cases.size(); ++k) {
    if (only >= 0 && k != only) continue;
    const BusyStart& c = cases[k];
    Settings settings;
    settings.segmentation.source = SegmentationSource::off;
    settings.system.report_keypoints = settings.system.report_masks = getenv("DUMP") != nullptr;
    Walk walk(settings);
    cv::Mat seen;
    std::vector<cv::Mat> dumped;
    int frame = 0;
    int i = 0;
    for (int round = 0; round < 4; ++round) {
    const Board left(c.left_width, 200, c.left_depth, c.seed + round, c.contrast), right(c.right_width, 200, c.right_depth, c.seed + 20 + round, c.contrast);
      const auto busy = [&](RgbdImage& image) {
        if (frame++ < c.first) return;
        left.paste(image, -c.left_width + c.left_step * (i % ((320 + c.left_width) / c.left_step + 3)), 30);
        right.paste(image, 320 - c.right_step * (i % ((320 + c.right_width) / c.right_step + 3)), 40);
        ++i;
        if (getenv("DUMP")) seen = image.colour.clone();
      };
      const int a = c.begin, b = c.begin + 40 * c.direction;
      const int from = round % 2 ? b : a, to = round % 2 ? a : b;
      if (!getenv("DUMP")) walk.go(from, to, busy);
      else for (int place = from; place != to + (to > from ? 1 : -1); place += to > from ? 1 : -1) {
        const TrackingResult r = walk.see(place, busy);
        cv::Mat show = seen.empty() ? cv::Mat(240, 320, CV_8UC3, cv::Scalar(0)) : seen.clone();
        if (!r.dynamic_mask.empty()) { cv::Mat red(show.size(), CV_8UC3, cv::Scalar(0, 0, 255)); cv::Mat mix; cv::addWeighted(show, 0.5, red, 0.5, 0, mix); mix.copyTo(show, r.dynamic_mask); }
        for (std::size_t q = 0; q < r.keypoints.size(); ++q) if (r.keypoint_states[q] != KeypointState::unmatched) cv::circle(show, cv::Point(r.keypoints[q].x, r.keypoints[q].y), 2, r.keypoint_states[q] == KeypointState::inlier ? cv::Scalar(0, 255, 0) : cv::Scalar(255, 255, 0));
        dumped.push_back(show);
      }
    }
    if (const char* dump = getenv("DUMP")) {
      for (std::size_t f = 0; f < dumped.size(); ++f) { cv::Mat rgb; cv::cvtColor(dumped[f], rgb, cv::COLOR_BGR2RGB); std::ofstream o(std::string(dump) + "/" + std::to_string(1000 + f) + ".ppm", std::ios::binary); o << "P6 " << rgb.cols << " " << rgb.rows << " 255\n"; o.write((const char*)rgb.data, rgb.total() * 3); }
    }
    const auto errors = walk.live_errors();
    int wrong = 0; double worst = 0; int first_wrong = -1;
    std::string line;
    for (std::size_t f = 0; f < errors.size(); ++f) {
      const auto& r = walk.results[f];
      char s = r.status == TrackingStatus::ok ? '.' : r.status == TrackingStatus::uncertain ? 'u' : r.status == TrackingStatus::lost ? 'L' : 'i';
      if (r.status == TrackingStatus::ok) {
        if (errors[f] > 0.05) { ++wrong; s = 'X'; if (first_wrong < 0) first_wrong = f; }
        else if (r.map.value > 0) s = 'a' + r.map.value - 1;
        worst = std::max(worst, errors[f]);
      }
      line += s;
    }
    double final_worst = walk.worst_error_of_all();
    printf("case %d w %d/%d step %d/%d z %.2f/%.2f first %d begin %d dir %d contrast %.1f: ok %d wrong %d worst %.3f final %.3f first wrong %d\n  %s\n", k, c.left_width, c.right_width, c.left_step, c.right_step, c.left_depth, c.right_depth, c.first, c.begin, c.direction, c.contrast, walk.count(TrackingStatus::ok), wrong, worst, final_worst, first_wrong, line.c_str());
    if (getenv("DETAIL")) for (std::size_t f = 0; f < errors.size(); ++f) {
      const auto& r = walk.results[f];
      printf("   %zu status %d map %d err %.3f matches %d inliers %d kf %d agree %.2f likes %.2f dyn %.2f loop %d sigma %.4f\n", f, (int)r.status, (int)r.map.value, errors[f], r.matches, r.inliers, r.is_keyframe, r.motion ? r.motion->agreement.value_or(-1) : -2, r.motion ? r.motion->likeness.value_or(-1) : -2, r.motion ? r.motion->dynamic_share : -1, r.loop.has_value(), r.covariance ? std::sqrt(r.covariance->diagonal().head<3>().maxCoeff()) : 0);
    }
    fflush(stdout);
  }
}

}  // namespace
}  // namespace stdc
