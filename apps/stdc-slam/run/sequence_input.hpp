#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "core/camera.hpp"
#include "input/layouts/tum_sequence.hpp"
#include "input/trajectory.hpp"

namespace stdc::app {

/// A sequence made ready to run on.
struct SequenceInput {
  /// @param camera  camera file; goes before that of the sequence
  /// @param rate    [Hz] see TumSequence
  /// @param range   "A:B", frames A..B-1; either may be missing
  /// Throws Error for whatever is wrong with the lists, the camera or the range.
  SequenceInput(const std::filesystem::path& folder, const std::optional<std::filesystem::path>& camera,
                const std::string& range, std::optional<double> rate = {});

  /// Where a ground truth is, or would be.
  std::filesystem::path truth_path() const { return sequence.folder() / "groundtruth.txt"; }
  /// Why there is no `truth`, as Error words it: no such file, or no pose in it.
  std::string why_no_truth() const;
  /// The truth, for what makes no sense without it. Throws Error if there is none.
  const Trajectory& required_truth() const;

  SequenceInput(const SequenceInput&) = delete;
  SequenceInput& operator=(const SequenceInput&) = delete;

  TumSequence sequence;
  std::string name;  ///< of the folder
  Camera camera;
  std::optional<Trajectory> truth;        ///< if it has any pose
  std::optional<GroundTruth> truth_file;  ///< the same as read, with what was left out
  int first_frame = 0;
  std::span<const SequenceFrame> frames;  ///< the chosen ones, of `sequence`
};

}  // namespace stdc::app
