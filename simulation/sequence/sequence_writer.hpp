#pragma once

#include <filesystem>
#include <vector>

#include "input/layouts/tum_writer.hpp"
#include "input/trajectory.hpp"
#include "simulation/sequence/rendered_sequence.hpp"

namespace stdc::simulation {

/// Writes rendered frames as a folder in TUM RGB-D layout with groundtruth.txt, mask/ (255 = dynamic; a mask
/// has the name of its colour image), and moved/ for frames that have such a mask; all of it or nothing.
class SequenceWriter {
 public:
  /// @param overwrite  whether a sequence that is already there may be replaced
  /// Throws Error if `folder` has something in it (and must not be overwritten, or is no sequence), or if the
  /// place cannot be written to.
  SequenceWriter(const std::filesystem::path& folder, const Camera& camera, int frame_count, bool overwrite);

  /// Writes the images of frame `index` in 0..frame_count-1. Different frames may be written by different
  /// threads at once. Throws Error if the disk is full or a file cannot be written.
  void write(int index, const RenderedFrame& frame);
  /// Puts the folder in its place; every frame must have been written.
  void finish();

 private:
  TumWriter writer_;
  Trajectory truth_;  ///< by index
};

}  // namespace stdc::simulation
