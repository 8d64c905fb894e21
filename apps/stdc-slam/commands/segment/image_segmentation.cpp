#include "commands/segment/image_segmentation.hpp"

#include <fmt/format.h>

#include <opencv2/core.hpp>

#include "core/error.hpp"
#include "core/images/image_codec.hpp"
#include "core/stopwatch.hpp"
#include "report/pictures/mask_overlay.hpp"

namespace stdc::app {
namespace {

SegmentedPixels turned(const SegmentedPixels& upright, Orientation orientation) {
  const auto turn = [&](const cv::Mat& map) { return map.empty() ? map : from_upright(map, orientation); };
  return {turn(upright.mask), turn(upright.classes), turn(upright.probability)};
}

}  // namespace

ImageSegmentation::ImageSegmentation(Segmenter& segmenter, const SegmentationRequest& wanted,
                                     const std::optional<Camera>& camera, bool is_of_images, bool overlays,
                                     OutputFolder& output)
    : segmenter_(segmenter),
      network_(dynamic_cast<NetworkSegmenter*>(&segmenter)),
      wanted_(wanted),
      camera_(camera),
      is_of_images_(is_of_images),
      overlays_(overlays),
      output_(output) {
  if (network_ == nullptr) return;
  for (std::size_t k = 0; k < network_->classes().size(); ++k) {
    if (network_->dynamic_classes()[k]) shared_classes_.push_back(network_->classes()[k]);
  }
  if (shared_classes_.size() < 2) shared_classes_.clear();
}

/// Which way up an image is: as the camera is mounted, else as a photo's EXIF data say.
Orientation ImageSegmentation::orientation_of(const StoredImage& stored, const SegmentImage& image) const {
  if (!camera_) return stored.orientation;
  if (is_of_images_ && stored.colour.size() != cv::Size(camera_->width, camera_->height)) {
    throw Error(image.where,
                fmt::format("is {} x {} pixels, but the camera has {} x {}", stored.colour.cols,
                            stored.colour.rows, camera_->width, camera_->height),
                "give the --camera that took these images");
  }
  return orientation_of_rotation(camera_->rotation);
}

SegmentedPixels ImageSegmentation::segment_pixels(const SegmenterInput& input) {
  if (network_ == nullptr) return {segmenter_.segment(input), {}, {}};
  SegmentationRequest request = wanted_;
  request.classes |= !shared_classes_.empty();
  return network_->segment_pixels(input, request);
}

std::vector<double> ImageSegmentation::class_shares(const cv::Mat& classes) const {
  std::vector<double> shares;
  if (shared_classes_.empty()) return shares;
  for (std::size_t k = 0; k < network_->classes().size(); ++k) {
    if (!network_->dynamic_classes()[k]) continue;
    shares.push_back(cv::countNonZero(classes == static_cast<double>(k)) /
                     static_cast<double>(classes.total()));
  }
  return shares;
}

void ImageSegmentation::write(const std::string& name, const SegmentedPixels& upright,
                              Orientation orientation) {
  const SegmentedPixels stored = turned(upright, orientation);
  output_.write(name + ".png", encode_png(stored.mask, PngEffort::fast));
  if (wanted_.classes) output_.write(name + "-classes.png", encode_png(stored.classes, PngEffort::fast));
  if (!wanted_.probability) return;
  cv::Mat whole;
  constexpr double kWhite = 65535;
  stored.probability.convertTo(whole, CV_16UC1, kWhite);
  output_.write(name + "-probability.png", encode_png(whole, PngEffort::fast));
}

void ImageSegmentation::write_overlay(const std::string& name, const cv::Mat& image,
                                      const SegmentedPixels& pixels) {
  const cv::Mat overlay = shared_classes_.empty()
                              ? draw_overlay(image, pixels.mask)
                              : draw_overlay(image, pixels.mask, pixels.classes, network_->dynamic_classes());
  output_.write(name + "-overlay.jpg", encode_jpeg(overlay));
}

SegmentedImage ImageSegmentation::segment(const SegmentImage& image, int frame,
                                          std::optional<TruthMasks>& truths) {
  const StoredImage stored = image.load();
  const Orientation orientation = orientation_of(stored, image);
  const cv::Mat upright = to_upright(stored.colour, orientation);
  SegmentedImage result;
  result.name = image.name;
  Stopwatch watch;
  const double cpu_before = thread_cpu_ms();
  const SegmentedPixels pixels = segment_pixels({upright, image.timestamp.value_or(0), frame});
  result.cpu_ms = thread_cpu_ms() - cpu_before;
  result.wall_ms = watch.lap_ms();
  result.dynamic_share = cv::countNonZero(pixels.mask) / static_cast<double>(pixels.mask.total());
  result.class_shares = class_shares(pixels.classes);
  write(image.name, pixels, orientation);
  // As a viewer shows the image: only EXIF data turn it there.
  if (overlays_ && camera_) write_overlay(image.name, stored.colour, turned(pixels, orientation));
  if (overlays_ && !camera_) write_overlay(image.name, upright, pixels);
  if (truths) {
    const cv::Mat mask = from_upright(pixels.mask, orientation);
    const auto truth = truths->load(image, mask.size(), orientation);
    if (truth) result.counts = count_mask(mask, truth->mask, truth->ignore);
  }
  return result;
}

}  // namespace stdc::app
