#pragma once

#include <filesystem>

#include "dense/inpainting/inpainter.hpp"
#include "input/layouts/tum_writer.hpp"
#include "run/sequence_input.hpp"

namespace stdc::app {

/// A folder in TUM RGB-D layout for frames without what moves: rgb/, depth/, unknown/ (255 = not known; named
/// as the colour image), camera.yaml, and groundtruth.txt if the sequence has one; all of it or nothing.
class InpaintedFolder {
 public:
  /// @param input  the sequence, which must outlive this
  /// Throws Error if `folder` has something in it that is not of an earlier run of the same kind, or is that
  /// of the sequence, or if the place cannot be written to.
  InpaintedFolder(const std::filesystem::path& folder, const SequenceInput& input);

  /// Writes the images of a frame, at the times of its colour and depth images. Different frames may be
  /// written by different threads at once. Throws Error if the disk is full or a file cannot be written.
  void write(double timestamp, double depth_timestamp, const InpaintedFrame& frame);
  /// Puts the folder in its place. Throws Error.
  void commit();

  /// As an absolute path without a slash at its end.
  const std::filesystem::path& path() const { return writer_.folder(); }

 private:
  const SequenceInput& input_;
  TumWriter writer_;
};

/// Writes the truth of an input as groundtruth.txt, if it has one: that of a TUM folder as it is.
void write_truth(const SequenceInput& input, TumWriter& writer);

}  // namespace stdc::app
