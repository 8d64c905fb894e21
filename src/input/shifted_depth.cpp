#include "input/shifted_depth.hpp"

#include <cmath>
#include <deque>
#include <utility>

namespace stdc {
namespace {

/// The colour of one frame and the depth of another.
class RepairedImages : public PackedImages {
 public:
  RepairedImages(std::shared_ptr<const PackedImages> colour, std::shared_ptr<const PackedImages> depth)
      : colour_(std::move(colour)), depth_(std::move(depth)) {}

  cv::Mat colour(cv::Size size, ColourMode mode) const override { return colour_->colour(size, mode); }
  bool stores_brightness() const override { return colour_->stores_brightness(); }
  cv::Mat depth(cv::Size size) const override { return depth_->depth(size); }
  std::optional<std::vector<std::uint8_t>> colour_file() const override { return colour_->colour_file(); }

 private:
  std::shared_ptr<const PackedImages> colour_, depth_;
};

class ShiftedDepthSource : public FrameSource {
 public:
  ShiftedDepthSource(std::unique_ptr<FrameSource> source, double offset, double max_difference)
      : source_(std::move(source)), offset_(offset), max_difference_(max_difference) {}

  std::optional<SourceFrame> next() override {
    while (auto frame = next_colour()) {
      if (const Depth* depth = nearest_depth(frame->timestamp)) {
        frame->images = std::make_shared<RepairedImages>(frame->images, depth->images);
        frame->depth_timestamp = depth->depth_timestamp;
        return frame;
      }
      ++without_depth_;
    }
    return std::nullopt;
  }
  void rewind() override {
    source_->rewind();
    colours_.clear();
    depths_.clear();
    ended_ = false;
    without_depth_ = 0;
  }
  // How many colour images find a depth image shows only at the end.
  std::optional<int> frame_count() const override { return std::nullopt; }
  std::optional<int> expected_frame_count() const override { return source_->expected_frame_count(); }
  int colour_without_depth() const override { return source_->colour_without_depth() + without_depth_; }

  bool can_rewind() const override { return source_->can_rewind(); }
  bool is_live() const override { return source_->is_live(); }
  void stop() override { source_->stop(); }
  int dropped() const override { return source_->dropped(); }
  std::optional<RgbdCameras> cameras() const override { return source_->cameras(); }
  std::string camera_hint() const override { return source_->camera_hint(); }
  std::optional<GroundTruth> ground_truth() const override { return source_->ground_truth(); }
  bool truth_comes_last() const override { return source_->truth_comes_last(); }
  std::string truth_where() const override { return source_->truth_where(); }
  std::string kind() const override { return source_->kind(); }
  std::string where() const override { return source_->where(); }
  std::vector<StreamInfo> streams() const override { return source_->streams(); }
  std::vector<std::string> notes() const override { return source_->notes(); }
  std::vector<std::string> faults() const override { return source_->faults(); }

 private:
  struct Depth {
    double taken = 0, depth_timestamp = 0;  ///< [s]
    std::shared_ptr<const PackedImages> images;
  };

  /// Reads on until a depth image is known that was taken after the next colour image, if there is one.
  std::optional<SourceFrame> next_colour() {
    while (!ended_ &&
           (colours_.empty() || depths_.empty() || depths_.back().taken < colours_.front().timestamp)) {
      auto frame = source_->next();
      if (!frame) {
        ended_ = true;
        break;
      }
      depths_.push_back({frame->depth_timestamp + offset_, frame->depth_timestamp, frame->images});
      colours_.push_back(std::move(*frame));
    }
    if (colours_.empty()) return std::nullopt;
    SourceFrame frame = std::move(colours_.front());
    colours_.pop_front();
    return frame;
  }

  /// The nearest; what was taken before it will not be asked for again.
  const Depth* nearest_depth(double time) {
    const auto distance = [time](const Depth& depth) { return std::abs(depth.taken - time); };
    while (depths_.size() > 1 && distance(depths_[1]) <= distance(depths_[0])) depths_.pop_front();
    return !depths_.empty() && distance(depths_.front()) <= max_difference_ ? &depths_.front() : nullptr;
  }

  std::unique_ptr<FrameSource> source_;
  double offset_, max_difference_;
  std::deque<SourceFrame> colours_;
  std::deque<Depth> depths_;
  bool ended_ = false;
  int without_depth_ = 0;
};

}  // namespace

std::unique_ptr<FrameSource> shift_depth(std::unique_ptr<FrameSource> source, double offset,
                                         double max_difference) {
  return std::make_unique<ShiftedDepthSource>(std::move(source), offset, max_difference);
}

}  // namespace stdc
