#include "input/layouts/folder_source.hpp"

#include <opencv2/core.hpp>
#include <utility>

namespace stdc {
namespace {

class ImageFiles final : public PackedImages {
 public:
  ImageFiles(ImageFile colour, ImageFile depth, std::optional<std::uint16_t> missing_from)
      : colour_(std::move(colour)), depth_(std::move(depth)), missing_from_(missing_from) {}

  cv::Mat colour(cv::Size size, ColourMode mode) const override {
    return read_colour_file(colour_, size, mode);
  }
  cv::Mat depth(cv::Size size) const override {
    cv::Mat depth = read_depth_file(depth_, size);
    if (missing_from_ && depth.type() == CV_16UC1) depth.setTo(0, depth >= *missing_from_);
    return depth;
  }

 private:
  ImageFile colour_, depth_;
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
  frame.images = std::make_shared<ImageFiles>(files.colour, files.depth, contents_.missing_from);
  return frame;
}

std::optional<GroundTruth> FolderSource::ground_truth() const {
  if (!contents_.read_truth) return std::nullopt;
  return contents_.read_truth();
}

}  // namespace stdc
