#pragma once

#include "run/run_options.hpp"

namespace stdc::app {

/// Runs on a sequence and writes the results. Throws Error for bad input; then nothing is written.
/// @return whether any frame got a pose; if none did, that is said on stderr and no map is saved
bool run_sequence(const RunOptions& options);

}  // namespace stdc::app
