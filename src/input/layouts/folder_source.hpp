#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "input/frame_source.hpp"
#include "input/image_file.hpp"

namespace stdc {

/// A frame of a folder: two files.
struct FolderFrame {
  double timestamp = 0, depth_timestamp = 0;  ///< [s]
  ImageFile colour, depth;
  ImageFile confidence = {};  ///< of the depth, 8 bits: 0 = not to be used; no path: none
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
};

/// Frames that lie in files, whatever the layout.
class FolderSource final : public FrameSource {
 public:
  explicit FolderSource(FolderContents contents) : contents_(std::move(contents)) {}

  std::optional<SourceFrame> next() override;
  void rewind() override { at_ = 0; }
  std::optional<int> frame_count() const override { return static_cast<int>(contents_.frames.size()); }
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
  int colour_without_depth() const override { return contents_.colour_without_depth; }

 private:
  FolderContents contents_;
  std::size_t at_ = 0;
};

}  // namespace stdc
