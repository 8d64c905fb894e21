#pragma once

#include <memory>

#include "commands/command.hpp"
#include "input/frame_source.hpp"
#include "run/sequence_input.hpp"

namespace stdc::app {

/// What an input is, for the help of commands that take one.
constexpr const char* kInputHelp =
    "RGB-D recording: a folder in the layout of TUM RGB-D, or any other of docs/inputs.md";

/// Adds the options that say how an input is to be read: --camera, --rate, --input-kind and the topics of
/// recordings. Not the input itself, nor --frames, which some commands have in their own form.
void add_input_options(Command command, InputOptions& options);
/// Adds --truth, for commands that score or hand on true poses.
void add_truth_option(Command command, InputOptions& options);
/// Adds --frames A:B.
void add_frames_option(Command command, InputOptions& options);

/// Opens an input that is looked at as a whole. A live camera, which has no end, is refused before it is
/// touched.
std::unique_ptr<FrameSource> open_recorded_input(const InputOptions& options);

}  // namespace stdc::app
