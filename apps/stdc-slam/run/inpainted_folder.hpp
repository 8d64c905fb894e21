#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dense/inpainter.hpp"
#include "run/sequence_input.hpp"

namespace stdc::app {

/// A folder in TUM RGB-D layout for frames without what moves: rgb/, depth/, unknown/ (255 = not known; named
/// as the colour image), rgb.txt, depth.txt, camera.yaml, and groundtruth.txt if the sequence has one. All
/// files go to a hidden folder beside it, which takes its place at the end: it is never there half written.
class InpaintedFolder {
 public:
  /// @param input  the sequence, which must outlive this
  /// Throws Error if `folder` has something in it that is not of an earlier run of the same kind, or is that
  /// of the sequence, or if the place cannot be written to.
  InpaintedFolder(const std::filesystem::path& folder, const SequenceInput& input);
  /// Removes what was written if `commit` was not reached.
  ~InpaintedFolder();
  InpaintedFolder(const InpaintedFolder&) = delete;
  InpaintedFolder& operator=(const InpaintedFolder&) = delete;

  /// Writes the images of a frame of the input. Different frames may be written by different threads at once.
  /// Throws Error if the disk is full or a file cannot be written.
  void write(int index, const InpaintedFrame& frame);
  /// Writes the lists, of the frames that were written, and puts the folder in its place. Throws Error.
  void commit();

  /// As an absolute path without a slash at its end.
  const std::filesystem::path& path() const { return folder_; }

 private:
  void make_partial();
  void write_lists() const;
  void remove_what_was_made() noexcept;

  const SequenceInput& input_;
  std::filesystem::path folder_, partial_;
  std::vector<std::filesystem::path> made_;  ///< folders above that were not there before, outermost first
  std::vector<char> written_;                ///< by index; not bool: threads write side by side
};

}  // namespace stdc::app
