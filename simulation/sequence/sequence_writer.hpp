#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "simulation/sequence/rendered_sequence.hpp"

namespace stdc::simulation {

/// Writes rendered frames as a folder in TUM RGB-D layout: rgb/, depth/, rgb.txt, depth.txt, groundtruth.txt,
/// camera.yaml, mask/ (255 = dynamic; a mask has the name of its colour image), and moved/ for frames that
/// have such a mask. All files go to a temporary folder beside the target, which is renamed when all is
/// written: a sequence is never left half written.
class SequenceWriter {
 public:
  /// @param overwrite  whether a sequence that is already there may be replaced
  /// Throws Error if `folder` has something in it (and must not be overwritten, or is no sequence), or if the
  /// place cannot be written to.
  SequenceWriter(const std::filesystem::path& folder, const Camera& camera, int frame_count, bool overwrite);
  /// Removes what was written if `finish` was not reached.
  ~SequenceWriter();
  SequenceWriter(const SequenceWriter&) = delete;
  SequenceWriter& operator=(const SequenceWriter&) = delete;

  /// Writes the images of frame `index` in 0..frame_count-1. Different frames may be written by different
  /// threads at once. Throws Error if the disk is full or a file cannot be written.
  void write(int index, const RenderedFrame& frame);
  /// Writes the lists and puts the folder in its place; every frame must have been written.
  void finish();

 private:
  struct Entry {
    std::string stamp;  ///< timestamp as it stands in names and lists; empty: not written yet
    Pose world_from_cam;
  };
  void write_lists() const;

  std::filesystem::path folder_, partial_;
  Camera camera_;
  std::vector<Entry> entries_;
  bool finished_ = false;
};

}  // namespace stdc::simulation
