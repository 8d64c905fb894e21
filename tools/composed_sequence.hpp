#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "input/layouts/tum_sequence.hpp"
#include "simulation/compose/mover_paster.hpp"
#include "simulation/compose/passage.hpp"

namespace stdc {

/// A recorded sequence with a mover in it, written in TUM layout with mask/ beside its place and moved there
/// when it is complete.
class ComposedSequence {
 public:
  /// Keeps references to both. Throws Error if `output` is there already.
  ComposedSequence(const TumSequence& recorded, const Camera& camera, const std::filesystem::path& output);
  /// Removes what was written if `finish` was not reached.
  ~ComposedSequence();
  ComposedSequence(const ComposedSequence&) = delete;
  ComposedSequence& operator=(const ComposedSequence&) = delete;

  /// Writes a frame with the mover in it, or as it was recorded if the mover is not seen. Returns the share
  /// of the view that it covers. Throws Error for a grey frame, or if a file cannot be read or written.
  double paste(int index, const simulation::Passage& passage, const simulation::MoverPaster& paster,
               std::uint64_t seed);
  /// Writes the frame as it was recorded, byte by byte.
  void keep(int index);
  /// Writes the lists, camera.yaml and groundtruth.txt; every frame must have been written.
  void finish();

 private:
  const TumSequence& recorded_;
  const Camera& camera_;
  std::filesystem::path output_, partial_;
  std::vector<std::pair<std::string, std::string>> names_;  ///< colour and depth, as in the lists
};

}  // namespace stdc
