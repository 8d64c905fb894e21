#include "input/layouts/folder_source.hpp"

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/error.hpp"

namespace stdc {
namespace {

/// The depth image of a frame, without what its confidence forbids.
cv::Mat read_folder_depth(const FolderFrame& frame, std::optional<std::uint16_t> missing_from,
                          cv::Size size) {
  cv::Mat depth = read_depth_file(frame.depth, size);
  if (missing_from && depth.type() == CV_16UC1) depth.setTo(0, depth >= *missing_from);
  if (!frame.confidence.path.empty()) {
    depth.setTo(0, read_colour_file(frame.confidence, depth.size(), ColourMode::grey) == 0);
  }
  return depth;
}

class ImageFiles final : public PackedImages {
 public:
  ImageFiles(const FolderFrame& frame, std::optional<std::uint16_t> missing_from)
      : frame_(frame), missing_from_(missing_from) {}

  cv::Mat colour(cv::Size size, ColourMode mode) const override {
    return read_colour_file(frame_.colour, size, mode);
  }
  bool stores_brightness() const override { return is_jpeg_file(frame_.colour); }
  std::optional<std::vector<std::uint8_t>> colour_file() const override {
    const std::string text = read_image_file(frame_.colour);
    return std::vector<std::uint8_t>(text.begin(), text.end());
  }
  cv::Mat depth(cv::Size size) const override { return read_folder_depth(frame_, missing_from_, size); }

 private:
  FolderFrame frame_;
  std::optional<std::uint16_t> missing_from_;
};

/// A frame of a video, decoded already, and a depth image that is a file.
class VideoImages final : public PackedImages {
 public:
  VideoImages(const FolderFrame& frame, std::optional<std::uint16_t> missing_from, cv::Mat red_green_blue)
      : frame_(frame), missing_from_(missing_from), colour_(std::move(red_green_blue)) {}

  cv::Mat colour(cv::Size size, ColourMode mode) const override {
    if (!size.empty() && size != colour_.size()) {
      throw Error(frame_.colour.where,
                  fmt::format("is {} x {} pixels, but the camera has {} x {}", colour_.cols, colour_.rows,
                              size.width, size.height),
                  "give the camera of these images (--camera)");
    }
    cv::Mat image;
    cv::cvtColor(colour_, image, mode == ColourMode::grey ? cv::COLOR_RGB2GRAY : cv::COLOR_RGB2BGR);
    return image;
  }
  cv::Mat depth(cv::Size size) const override { return read_folder_depth(frame_, missing_from_, size); }

 private:
  FolderFrame frame_;
  std::optional<std::uint16_t> missing_from_;
  cv::Mat colour_;
};

}  // namespace

FolderSource::FolderSource(FolderContents contents) : contents_(std::move(contents)) {
  if (contents_.video) video_.emplace(*contents_.video);
}

void FolderSource::rewind() {
  at_ = 0;
  ended_early_ = false;
}

std::optional<SourceFrame> FolderSource::next() {
  if (ended_early_ || at_ == contents_.frames.size()) return std::nullopt;
  const FolderFrame& files = contents_.frames[at_];
  SourceFrame frame;
  frame.timestamp = files.timestamp;
  frame.depth_timestamp = files.depth_timestamp;
  frame.name = files.colour.path.stem().string();
  frame.where = files.colour.where;
  frame.images = images_of(files);
  ended_early_ = frame.images == nullptr;
  if (ended_early_) return std::nullopt;
  ++at_;
  return frame;
}

/// Null where a video ends too early.
std::shared_ptr<const PackedImages> FolderSource::images_of(const FolderFrame& frame) {
  if (!video_) return std::make_shared<ImageFiles>(frame, contents_.missing_from);
  auto image = video_->frame(frame.video_frame.value());
  if (image) return std::make_shared<VideoImages>(frame, contents_.missing_from, *std::move(image));
  if (at_ > 0) return nullptr;
  throw Error(contents_.video->path.string(),
              fmt::format("none of its frames can be decoded ({})", why_video_ended()),
              "restore the file or record it again");
}

std::vector<std::string> FolderSource::faults() const {
  if (!ended_early_) return {};
  return {fmt::format("{}: cannot be decoded from frame {} on ({}): {} of {} frames are left out",
                      contents_.video->path.string(), contents_.frames[at_].video_frame.value(),
                      why_video_ended(), contents_.frames.size() - at_, contents_.frames.size())};
}

std::string FolderSource::why_video_ended() const {
  return video_->problem().empty() ? "it holds fewer than it says" : video_->problem();
}

std::optional<std::vector<double>> FolderSource::frame_times() const {
  std::vector<double> times;
  times.reserve(contents_.frames.size());
  for (const FolderFrame& frame : contents_.frames) times.push_back(frame.timestamp);
  return times;
}

std::vector<std::string> FolderSource::frame_names() const {
  std::vector<std::string> names;
  names.reserve(contents_.frames.size());
  for (const FolderFrame& frame : contents_.frames) names.push_back(frame.colour.path.stem().string());
  return names;
}

std::optional<GroundTruth> FolderSource::ground_truth() const {
  if (!contents_.read_truth) return std::nullopt;
  return contents_.read_truth();
}

}  // namespace stdc
