#include "features/extractor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "features/description/brief.hpp"
#include "features/description/orientation.hpp"
#include "features/detection/blur.hpp"
#include "features/detection/candidates.hpp"
#include "features/detection/fast.hpp"
#include "features/detection/harris.hpp"
#include "features/detection/pyramid.hpp"
#include "features/detection/quadtree.hpp"
#include "features/mask.hpp"

namespace stdc {
namespace {

std::size_t level_index(int index) { return static_cast<std::size_t>(index); }

void check_image(const cv::Mat& image, const char* what) {
  constexpr int kMin = 64, kMax = 32767;
  if (image.type() != CV_8UC1) {
    throw Error(what, "the image is not of 8-bit grey levels", "convert it to CV_8UC1");
  }
  if (std::min(image.cols, image.rows) < kMin || std::max(image.cols, image.rows) > kMax) {
    throw Error(what, fmt::format("an image of {} x {} pixels", image.cols, image.rows),
                fmt::format("give one of {} to {} pixels per side", kMin, kMax));
  }
}

}  // namespace

struct FeatureExtractor::Implementation {
  explicit Implementation(const FeatureSettings& s) : settings(s) { settings.validate(); }

  Cell area(int level) const {
    const cv::Size size = pyramid->sizes()[level_index(level)];
    return {kBorder, kBorder, size.width - kBorder, size.height - kBorder};
  }
  float scale(int level) const { return static_cast<float>(std::pow(settings.scale_factor, level)); }
  void detect(const cv::Mat& grey);
  void reject(const cv::Mat& dynamic_mask);
  Features select();
  void check_detected(const char* what) const;
  int select_level(int level, int budget, Features& features);

  FeatureSettings settings;
  std::shared_ptr<Pyramid> pyramid = std::make_shared<Pyramid>();
  std::shared_ptr<Pyramid> earlier;  // that of the image before, for whose memory it is kept
  std::vector<int> budgets;
  std::vector<std::vector<Corner>> corners;  // by level, at T_L
  std::vector<PaddedImage> smoothed;         // by level
  DynamicArea dynamic;
  std::vector<int> nearest;  // scratch: pixel of the image, by column or row of a level
  CandidateChooser chooser;
  std::vector<Candidate> candidates;
  Quadtree quadtree;
  SteeredBrief brief;
  std::vector<SelectionCell> cells;
};

void FeatureExtractor::Implementation::check_detected(const char* what) const {
  if (pyramid->levels() == 0) throw Error(what, "no image was given", "call detect() before it");
}

void FeatureExtractor::Implementation::detect(const cv::Mat& grey) {
  check_image(grey, "FeatureExtractor::detect");
  // A frame that somebody still looks at keeps its pyramid.
  std::swap(pyramid, earlier);
  if (!pyramid || pyramid.use_count() > 1) pyramid = std::make_shared<Pyramid>();
  pyramid->build(grey, settings);
  budgets = level_budgets(settings, pyramid->sizes());
  corners.resize(at(pyramid->levels()));
  smoothed.resize(at(pyramid->levels()));
  for (int i = 0; i < pyramid->levels(); ++i) {
    corners[level_index(i)].clear();
    if (budgets[level_index(i)] == 0) continue;
    const ImageView image = pyramid->level(i).view();
    find_fast_corners(image, kBorder, settings.threshold_low, corners[level_index(i)]);
    gaussian_blur(image, smoothed[level_index(i)]);
  }
}

void FeatureExtractor::Implementation::reject(const cv::Mat& dynamic_mask) {
  check_detected("FeatureExtractor::reject");
  if (dynamic_mask.empty()) return;
  check_image(dynamic_mask, "FeatureExtractor::reject");
  if (dynamic_mask.size() != pyramid->sizes()[0]) {
    throw Error("FeatureExtractor::reject", "the mask is not of the size of the image", "resize the mask");
  }
  dynamic.set(dynamic_mask);
  if (dynamic.empty()) return;
  // The circle of FAST and the smoothing of the pixels beside the corner stay off the dynamic object; to keep
  // the whole descriptor patch off would cost the static points near people, which hold the pose best.
  constexpr float kMargin = 4;  // level pixels
  for (int level = 0; level < pyramid->levels(); ++level) {
    const float s = scale(level);
    dynamic.spread(static_cast<int>(std::lround(kMargin * s)));
    const cv::Size size = pyramid->sizes()[level_index(level)];
    nearest.resize(at(std::max(size.width, size.height)));
    for (std::size_t x = 0; x < nearest.size(); ++x)
      nearest[x] = static_cast<int>(std::lround(level_to_image(static_cast<float>(x), s)));
    std::erase_if(corners[level_index(level)], [&](const Corner& corner) {
      return dynamic.near(nearest[at(corner.x)], nearest[at(corner.y)]);
    });
  }
}

int FeatureExtractor::Implementation::select_level(int level, int budget, Features& features) {
  const ImageView image = pyramid->level(level).view();
  candidates = chooser.choose(corners[level_index(level)], area(level), budget, settings);
  if (settings.selection == Selection::improved) {
    for (Candidate& candidate : candidates)
      candidate.response = harris_response(image, candidate.x, candidate.y);
  }
  const std::vector<int>& winners = quadtree.select(candidates, area(level), budget, settings.selection);
  const float s = scale(level);
  for (const int winner : winners) {
    const Candidate& c = candidates[level_index(winner)];
    const PatchMoments moments = patch_moments(image, c.x, c.y);
    features.keypoints.push_back({level_to_image(c.x, s), level_to_image(c.y, s), angle_of(moments),
                                  c.response, static_cast<std::uint8_t>(level), c.quality});
    features.descriptors.push_back(
        brief.describe(smoothed[level_index(level)].view(), c.x, c.y, direction_of(moments)));
  }
  for (const Cell& cell : quadtree.cells()) {
    // Edges lie between pixels: half a pixel before the first one.
    const auto edge = [&](int e) { return static_cast<float>(e) * s - 0.5F; };
    cells.push_back({level, edge(cell.left), edge(cell.top), edge(cell.right), edge(cell.bottom)});
  }
  return static_cast<int>(winners.size());
}

Features FeatureExtractor::Implementation::select() {
  check_detected("FeatureExtractor::select");
  Features features;
  features.keypoints.reserve(at(settings.keypoints));
  features.descriptors.reserve(at(settings.keypoints));
  cells.clear();
  int unspent = 0;
  for (int level = 0; level < pyramid->levels(); ++level) {
    if (budgets[level_index(level)] == 0) continue;
    const int budget = budgets[level_index(level)] + unspent;
    unspent = budget - select_level(level, budget, features);
    if (settings.selection == Selection::orb_slam3) unspent = 0;
  }
  return features;
}

FeatureExtractor::FeatureExtractor(const FeatureSettings& settings)
    : implementation_(std::make_unique<Implementation>(settings)) {}
FeatureExtractor::~FeatureExtractor() = default;
FeatureExtractor::FeatureExtractor(FeatureExtractor&&) noexcept = default;
FeatureExtractor& FeatureExtractor::operator=(FeatureExtractor&&) noexcept = default;

Features FeatureExtractor::extract(const cv::Mat& grey) {
  detect(grey);
  return select();
}
void FeatureExtractor::detect(const cv::Mat& grey) { implementation_->detect(grey); }
void FeatureExtractor::reject(const cv::Mat& dynamic_mask) { implementation_->reject(dynamic_mask); }
Features FeatureExtractor::select() { return implementation_->select(); }
int FeatureExtractor::levels(cv::Size image_size) const {
  return level_count(implementation_->settings, image_size);
}
std::shared_ptr<const Pyramid> FeatureExtractor::pyramid() const { return implementation_->pyramid; }
float FeatureExtractor::scale(int level) const { return implementation_->scale(level); }
const FeatureSettings& FeatureExtractor::settings() const { return implementation_->settings; }
const std::vector<SelectionCell>& FeatureExtractor::cells() const { return implementation_->cells; }

}  // namespace stdc
