#include "run/inpaint/inpaint_sequence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <thread>

#include "core/error.hpp"
#include "core/stopwatch.hpp"
#include "dense/inpainting/inpainter.hpp"
#include "run/frame_loader.hpp"
#include "run/progress.hpp"
#include "slam/threads/worker.hpp"

namespace stdc::app {
namespace {

class SecondPass {
 public:
  SecondPass(const SequenceInput& input, const InpaintingSettings& settings, const InpaintOptions& options,
             const std::vector<FramePose>& poses, const MaskRecord& masks, const InterruptWatch& interrupts,
             InpaintedFolder& folder)
      : input_(input),
        masks_(masks),
        interrupts_(interrupts),
        folder_(folder),
        quiet_(options.quiet),
        inpainter_(input.camera, settings),
        store_(settings) {
    for (const FramePose& pose : poses) {
      poses_[pose.frame] = {pose.frame, pose.timestamp, pose.map, pose.world_from_cam};
    }
    const int cores = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 16);
    lanes_ = std::vector<Lane>(static_cast<std::size_t>(options.threads > 0 ? options.threads : cores));
  }

  InpaintReport run(bool all) {
    Stopwatch watch;
    if (all) {
      for_each_frame("collecting", [this](const LoadedFrame& frame) {
        if (auto view = view_of(frame)) store_.add(std::move(view));
      });
    }
    for_each_frame("inpainting", [this, all](const LoadedFrame& frame) {
      auto view = view_of(frame);
      start(frame, view);
      if (view && !all) store_.add(std::move(view));
    });
    for (Lane& lane : lanes_) finish(lane);
    report_.seconds = 1e-3 * watch.lap_ms();
    return report_;
  }

 private:
  struct Lane {
    std::unique_ptr<Worker> worker = std::make_unique<Worker>();
    std::int64_t replaced = 0, unknown = 0;  ///< of its last frame
  };

  template <typename Action>
  void for_each_frame(const char* label, const Action& action) {
    FrameLoader loader(input_, ColourMode::as_stored);
    Progress progress(label, "frames", input_.expected_frame_count(), quiet_);
    while (const auto frame = loader.next()) {
      if (frame->image) action(*frame);
      if (interrupts_.interrupted()) {
        const auto count = input_.frame_count();
        progress.message(fmt::format("stdc-slam: interrupted while {} frame {}{}; nothing was written", label,
                                     frame->index + 1, count ? fmt::format(" of {}", *count) : ""));
        throw Error("interrupted", "nothing was written", "start again, perhaps with --frames");
      }
      progress.update(frame->index + 1);
    }
  }

  std::shared_ptr<const BackgroundView> view_of(const LoadedFrame& frame) const {
    const auto pose = poses_.find(frame.index);
    if (pose == poses_.end()) return nullptr;
    return std::make_shared<const BackgroundView>(
        inpainter_.view(*frame.image, masks_.mask(frame.index), pose->second));
  }

  /// Fills the frame beside the next ones. Which views it is filled from is settled here, in order of time.
  void start(const LoadedFrame& frame, const std::shared_ptr<const BackgroundView>& view) {
    Lane& lane = lanes_[static_cast<std::size_t>(frame.index) % lanes_.size()];
    finish(lane);
    ++report_.frames;
    cv::Mat dynamic = masks_.mask(frame.index);
    if (dynamic.empty()) dynamic = cv::Mat(inpainter_.rays().size(), CV_8UC1, cv::Scalar(0));
    if (!view) ++report_.without_pose;
    BackgroundStore::Views views;
    if (view && cv::countNonZero(dynamic) > 0) {
      views = store_.choose(view->at, inpainter_.region(dynamic), inpainter_.rays());
    }
    lane.worker->start([this, &lane, view, dynamic, views = std::move(views), image = *frame.image,
                        depth_timestamp = frame.depth_timestamp] {
      const InpaintedFrame result =
          view ? inpainter_.inpaint(image, *view, dynamic, views) : inpainter_.blank(image, dynamic);
      lane.replaced = cv::countNonZero(result.replaced);
      lane.unknown = cv::countNonZero(result.unknown);
      folder_.write(image.timestamp, depth_timestamp, result);
    });
  }

  void finish(Lane& lane) {
    lane.worker->wait();
    report_.replaced += lane.replaced;
    report_.unknown += lane.unknown;
    lane.replaced = lane.unknown = 0;
  }

  const SequenceInput& input_;
  const MaskRecord& masks_;
  const InterruptWatch& interrupts_;
  InpaintedFolder& folder_;
  bool quiet_;
  Inpainter inpainter_;
  BackgroundStore store_;
  std::map<int, ViewPose> poses_;
  InpaintReport report_;
  std::vector<Lane> lanes_;  ///< last, so that their threads end before what they work on
};

}  // namespace

InpaintReport inpaint_sequence(const SequenceInput& input, const InpaintingSettings& settings,
                               const InpaintOptions& options, const std::vector<FramePose>& poses,
                               const MaskRecord& masks, const InterruptWatch& interrupts,
                               InpaintedFolder& folder) {
  return SecondPass(input, settings, options, poses, masks, interrupts, folder).run(options.all);
}

}  // namespace stdc::app
