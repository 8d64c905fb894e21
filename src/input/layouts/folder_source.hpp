#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "input/frame_source.hpp"
#include "input/image_file.hpp"
#include "input/video/video_reader.hpp"

namespace stdc {

/// A frame of a folder: two files, or a frame of a video and a file.
struct FolderFrame {
  double timestamp = 0, depth_timestamp = 0;  ///< [s]
  ImageFile colour, depth;
  ImageFile confidence = {};  ///< of the depth, 8 bits: 0 = not to be used; no path: none
  std::optional<int> video_frame =
      {};  ///< its number; then colour.path is the name that it would have as a file
};

/// What a layout found in a folder.
struct FolderContents {
  std::string kind, where;
  std::vector<FolderFrame> frames;  ///< by time
  std::optional<RgbdCameras> cameras;
  std::string camera_hint = "give a camera file with --camera";
  std::function<GroundTruth()> read_truth;  ///< null: there is none
  std::string truth_where;
  std::vector<StreamInfo> streams;
  std::vector<std::string> notes;
  int colour_without_depth = 0;
  /// Depths of this value and above are missing ones, beside 0.
  std::optional<std::uint16_t> missing_from;
  std::optional<VideoFile> video;  ///< if the colour images are in one
};

/// Frames that lie in files, whatever the layout. Those of a video are decoded when they are given: it ends
/// where it is damaged.
class FolderSource final : public FrameSource {
 public:
  explicit FolderSource(FolderContents contents);

  std::optional<SourceFrame> next() override;
  void rewind() override;
  /// How many frames of a video can be decoded shows only at its end.
  std::optional<int> frame_count() const override { return video_ ? std::nullopt : expected_frame_count(); }
  std::optional<int> expected_frame_count() const override {
    return static_cast<int>(contents_.frames.size());
  }
  std::optional<std::vector<double>> frame_times() const override;
  std::vector<std::string> frame_names() const override;
  std::optional<RgbdCameras> cameras() const override { return contents_.cameras; }
  std::string camera_hint() const override { return contents_.camera_hint; }
  std::optional<GroundTruth> ground_truth() const override;
  std::string truth_where() const override { return contents_.truth_where; }
  std::string kind() const override { return contents_.kind; }
  std::string where() const override { return contents_.where; }
  std::vector<StreamInfo> streams() const override { return contents_.streams; }
  std::vector<std::string> notes() const override { return contents_.notes; }
  std::vector<std::string> faults() const override;
  int colour_without_depth() const override { return contents_.colour_without_depth; }

 private:
  std::shared_ptr<const PackedImages> images_of(const FolderFrame& frame);
  std::string why_video_ended() const;

  FolderContents contents_;
  std::optional<VideoReader> video_;
  std::size_t at_ = 0;
  bool ended_early_ = false;  ///< at_ is the frame that the video does not give
};

}  // namespace stdc
