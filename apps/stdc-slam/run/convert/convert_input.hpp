#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "run/frame_loader.hpp"
#include "run/interrupt_watch.hpp"
#include "run/sequence_input.hpp"

namespace stdc::app {

/// What was written, and what could not be.
struct ConvertReport {
  int frames = 0, unreadable = 0;
  int imu_readings = 0;
  std::int64_t too_far = 0;  ///< depths in metres that 16 bits cannot hold: written as missing
};

/// Hands on the frames of an input, colour as it is stored, and counts what came; `write` may count too.
/// Frames that cannot be read are reported on stderr and left out, as are the source's faults.
/// A live source ends when the program is interrupted.
/// Throws Error if there is no frame, the first cannot be read, or the program is interrupted.
ConvertReport convert_frames(const SequenceInput& input, bool quiet, const InterruptWatch& interrupts,
                             const std::function<void(const LoadedFrame&, ConvertReport&)>& write);

/// Writes an input as a folder in TUM RGB-D layout: colour and registered depth as PNG, camera.yaml,
/// groundtruth.txt and imu.txt ("timestamp wx wy wz ax ay az", as ETH3D has it) if the input has them; all of
/// it or nothing.
/// @param overwrite  replace a sequence that is there
/// Throws Error as convert_frames() does, and if the folder cannot be written.
ConvertReport convert_input(const SequenceInput& input, const std::filesystem::path& folder, bool overwrite,
                            bool quiet, const InterruptWatch& interrupts);

}  // namespace stdc::app
