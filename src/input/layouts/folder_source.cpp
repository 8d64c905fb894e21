#include "input/layouts/folder_source.hpp"

#include <opencv2/core.hpp>
#include <utility>

namespace stdc {
namespace {

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
  cv::Mat depth(cv::Size size) const override {
    cv::Mat depth = read_depth_file(frame_.depth, size);
    if (missing_from_ && depth.type() == CV_16UC1) depth.setTo(0, depth >= *missing_from_);
    if (!frame_.confidence.path.empty()) {
      depth.setTo(0, read_colour_file(frame_.confidence, depth.size(), ColourMode::grey) == 0);
    }
    return depth;
  }

 private:
  FolderFrame frame_;
  std::optional<std::uint16_t> missing_from_;
};

}  // namespace

std::optional<SourceFrame> FolderSource::next() {
  if (at_ == contents_.frames.size()) return std::nullopt;
  const FolderFrame& files = contents_.frames[at_++];
  SourceFrame frame;
  frame.timestamp = files.timestamp;
  frame.depth_timestamp = files.depth_timestamp;
  frame.name = files.colour.path.stem().string();
  frame.where = files.colour.where;
  frame.images = std::make_shared<ImageFiles>(files, contents_.missing_from);
  return frame;
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
