#include "report/pictures/debug_images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/images/image_codec.hpp"
#include "report/result_text.hpp"

namespace stdc::app {
namespace {

// BGR. Told apart also by those who do not see red and green: light blue, orange, light grey.
const cv::Scalar kInlier(255, 200, 60), kOutlier(40, 110, 255), kUnmatched(190, 190, 190),
    kText(255, 255, 255), kDynamic(200, 60, 160);
constexpr int kScale = 2;       // of the picture to the image
constexpr int kBarHeight = 34;  // of the line of text below [px]
constexpr int kShift = 4;       // fraction bits of OpenCV's drawing coordinates

/// Shows what counts as dynamic.
void tint(cv::Mat& picture, const cv::Mat& dynamic_mask) {
  constexpr double kShare = 0.4;
  cv::Mat mask, mixed;
  cv::resize(dynamic_mask, mask, picture.size(), 0, 0, cv::INTER_NEAREST);
  cv::addWeighted(picture, 1 - kShare, cv::Mat(picture.size(), CV_8UC3, kDynamic), kShare, 0, mixed);
  mixed.copyTo(picture, mask);
}

/// The image enlarged and darkened, so that marks stand out, with room for text below.
cv::Mat backdrop(const cv::Mat& colour, const cv::Mat& dynamic_mask) {
  cv::Mat grey = colour, large, dimmed, picture;
  if (colour.channels() == 3) cv::cvtColor(colour, grey, cv::COLOR_BGR2GRAY);
  cv::resize(grey, large, {}, kScale, kScale, cv::INTER_LINEAR);
  large.convertTo(dimmed, CV_8U, 0.7, 20);
  cv::cvtColor(dimmed, picture, cv::COLOR_GRAY2BGR);
  if (!dynamic_mask.empty()) tint(picture, dynamic_mask);
  cv::copyMakeBorder(picture, picture, 0, kBarHeight, 0, 0, cv::BORDER_CONSTANT, cv::Scalar(30, 30, 30));
  return picture;
}

/// Image coordinates (centre of the first pixel is 0) to fixed-point picture coordinates.
cv::Point at(float x, float y) {
  const auto fixed = [](float v) { return cvRound(((v + 0.5F) * kScale - 0.5F) * (1 << kShift)); };
  return {fixed(x), fixed(y)};
}

void mark(cv::Mat& picture, const cv::Point& position, const cv::Scalar& colour, KeypointQuality quality) {
  constexpr int kRadius = 4 << kShift;
  const int thickness = quality == KeypointQuality::high ? cv::FILLED : 1;
  cv::circle(picture, position, kRadius, colour, thickness, cv::LINE_AA, kShift);
}

/// Writes text in the bar, at `x`; returns where it ends.
int write(cv::Mat& picture, const std::string& text, int x, const cv::Scalar& colour) {
  constexpr double kSize = 0.55;
  int baseline = 0;
  const cv::Size size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kSize, 1, &baseline);
  cv::putText(picture, text, {x, picture.rows - (kBarHeight - size.height) / 2}, cv::FONT_HERSHEY_SIMPLEX,
              kSize, colour, 1, cv::LINE_AA);
  return x + size.width;
}

/// A sample mark with its meaning; returns where the next may start.
int legend(cv::Mat& picture, const char* text, int x, const cv::Scalar& colour, KeypointQuality quality) {
  const int y = picture.rows - kBarHeight / 2;
  mark(picture, cv::Point(x + 6, y) * (1 << kShift), colour, quality);
  return write(picture, text, x + 16, kText) + 16;
}

cv::Scalar colour_of(KeypointState state) {
  if (state == KeypointState::inlier) return kInlier;
  return state == KeypointState::outlier ? kOutlier : kUnmatched;
}

}  // namespace

cv::Mat draw_keypoints(const cv::Mat& colour, int frame, const TrackingResult& result) {
  cv::Mat picture = backdrop(colour, result.dynamic_mask);
  // Unmatched first: what matters lies on top.
  for (const KeypointState layer :
       {KeypointState::unmatched, KeypointState::outlier, KeypointState::inlier}) {
    for (std::size_t i = 0; i < result.keypoints.size(); ++i) {
      if (result.keypoint_states[i] != layer) continue;
      const Keypoint& keypoint = result.keypoints[i];
      mark(picture, at(keypoint.x, keypoint.y), colour_of(layer), keypoint.quality);
    }
  }
  int x = write(picture,
                fmt::format("frame {}  {}{}  {} inliers of {} matches", frame, status_name(result.status),
                            result.is_keyframe ? ", keyframe" : "", result.inliers, result.matches),
                10, kText) +
          30;
  x = legend(picture, "inlier", x, kInlier, KeypointQuality::high);
  x = legend(picture, "outlier", x, kOutlier, KeypointQuality::high);
  x = legend(picture, "unmatched", x, kUnmatched, KeypointQuality::high);
  legend(picture, "ring: low quality", x, kText, KeypointQuality::low);
  return picture;
}

cv::Mat draw_cells(const cv::Mat& colour, const cv::Mat& dynamic_mask, int frame,
                   const FeatureSettings& settings) {
  const cv::Scalar line(120, 170, 60), high(80, 220, 255), low(255, 120, 220);
  FeatureExtractor extractor(settings);
  cv::Mat grey = colour;
  if (colour.channels() == 3) cv::cvtColor(colour, grey, cv::COLOR_BGR2GRAY);
  extractor.detect(grey);
  extractor.reject(dynamic_mask);
  const Features features = extractor.select();
  cv::Mat picture = backdrop(grey, dynamic_mask);
  const std::vector<SelectionCell>& cells = extractor.cells();
  int count = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const SelectionCell& cell = cells[i];
    if (cell.level != 0) continue;  // all levels on top of each other cannot be read
    cv::rectangle(picture, at(cell.left, cell.top), at(cell.right, cell.bottom), line, 1, cv::LINE_AA,
                  kShift);
    const Keypoint& keypoint = features.keypoints[i];
    mark(picture, at(keypoint.x, keypoint.y), keypoint.quality == KeypointQuality::high ? high : low,
         KeypointQuality::high);
    ++count;
  }
  int x = write(picture,
                fmt::format("frame {}  {} selection, level 0 of {}: {} cells of {} keypoints", frame,
                            enum_name(settings.selection), extractor.levels(grey.size()), count,
                            features.keypoints.size()),
                10, kText) +
          30;
  x = legend(picture, "high quality", x, high, KeypointQuality::high);
  legend(picture, "low quality", x, low, KeypointQuality::high);
  return picture;
}

DebugImages::DebugImages(const std::filesystem::path& folder, int every, const FeatureSettings& settings)
    : folder_(folder), every_(every), settings_(settings) {}

void DebugImages::on_frame(const ObservedFrame& frame) {
  const TrackingResult& result = frame.result;
  if (frame.image == nullptr) return;
  const cv::Mat& colour = frame.image->colour;
  if (result.frame % every_ != 0 && result.status != TrackingStatus::lost) return;
  folder_.write(fmt::format("keypoints_{:06}.png", frame.number),
                encode_png(draw_keypoints(colour, frame.number, result)));
  folder_.write(fmt::format("cells_{:06}.png", frame.number),
                encode_png(draw_cells(colour, result.dynamic_mask, frame.number, settings_)));
}

void DebugImages::commit() { folder_.commit(); }

}  // namespace stdc::app
