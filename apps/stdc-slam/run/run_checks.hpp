#pragma once

#include "run/inpaint/inpainted_folder.hpp"
#include "run/run_options.hpp"
#include "slam/settings.hpp"

namespace stdc::app {

// Contradictions among the options of `run`, and places that cannot be written to: what would otherwise come
// to light at the end. All throw Error.

/// --load-map, --save-map and --localisation-only, on their own and against the settings.
void check_map_options(const RunOptions& options, const Settings& settings);
/// Whether the map can be written. The output folder, which may be its place, must be there.
void check_place_for_map(const RunOptions& options);
/// Whether there will be masks to inpaint by.
void check_inpainting(const RunOptions& options, const Settings& settings);
/// A live source is there once, and has a pace of its own.
void check_live(const RunOptions& options, const SequenceInput& input);
/// The folder of --inpaint, which appears at the end, must not hold other results.
void check_apart(const RunOptions& options, const InpaintedFolder& inpainted);

}  // namespace stdc::app
