#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/camera.hpp"
#include "input/frame_source.hpp"
#include "input/open_source.hpp"
#include "input/trajectory.hpp"
#include "run/frame_range.hpp"
#include "segmentation/frame_masks.hpp"

namespace stdc::app {

/// What the user says of an input.
struct InputOptions {
  std::filesystem::path path;                   ///< file or folder
  std::optional<std::filesystem::path> camera;  ///< camera file; goes before what the input says
  std::string frames;                           ///< "A:B": frames A..B-1; either may be missing
  SourceOptions source;
};

/// A sequence made ready to run on.
class SequenceInput {
 public:
  /// Opens the input, says on stderr how it was understood where that is not plain, and reads the ground
  /// truth where that takes no time. Throws Error for whatever is wrong with the input, the camera or the
  /// range.
  explicit SequenceInput(const InputOptions& options);
  /// The same of a source that was opened elsewhere.
  SequenceInput(const InputOptions& options, std::unique_ptr<FrameSource> source);
  /// The same with other cameras.
  /// @param used  nothing: those of the options or the source
  SequenceInput(const InputOptions& options, std::unique_ptr<FrameSource> source,
                const std::optional<RgbdCameras>& used);
  SequenceInput(const SequenceInput&) = delete;
  SequenceInput& operator=(const SequenceInput&) = delete;

  /// Where a ground truth is, or would be.
  std::filesystem::path truth_path() const { return source_->truth_where(); }
  /// The truth if it has any pose. Read when it is first asked for; that of a recording costs least when all
  /// its frames have been read. Throws Error if it cannot be read.
  const std::optional<Trajectory>& truth() const;
  /// The same as read, with what was left out.
  const std::optional<GroundTruth>& truth_file() const;
  /// Why there is no truth(), as Error words it: no such file, or no pose in it.
  std::string why_no_truth() const;
  /// The truth, for what makes no sense without it. Throws Error if there is none.
  const Trajectory& required_truth() const;

  /// The source at its first frame, which is not yet one of the chosen ones if first_frame() is not 0. Throws
  /// Error if it was used before and cannot be rewound.
  FrameSource& start() const;
  const FrameSource& source() const { return *source_; }
  /// Ends a live source.
  void stop() const { source_->stop(); }
  int first_frame() const { return range_.first; }
  /// The frame after the last chosen one, if that is known before it is reached.
  std::optional<int> end_frame() const { return range_.end; }
  /// How many frames are chosen, if that is known before the end.
  std::optional<int> frame_count() const;
  /// About how many, for a progress bar.
  std::optional<int> expected_frame_count() const;
  /// Times of the chosen frames [s], if they are known without reading them.
  std::optional<std::vector<double>> frame_times() const;
  /// What masks of the chosen frames may be named by, if their times are known.
  std::optional<std::vector<MaskedFrame>> masked_frames() const;

  std::string name;  ///< of the folder or file
  RgbdCameras cameras;
  const Camera& camera = cameras.colour;

 private:
  std::unique_ptr<FrameSource> source_;
  mutable bool used_ = false;
  mutable bool truth_is_read_ = false;
  mutable std::optional<Trajectory> truth_;
  mutable std::optional<GroundTruth> truth_file_;
  FrameRange range_;
};

}  // namespace stdc::app
