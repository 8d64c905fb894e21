#pragma once

#include "commands/command.hpp"
#include "run/live_view.hpp"

namespace stdc::app {

/// Adds --view and --view-address.
/// @returns --view, for options that need it
CommandOption add_view_options(Command command, LiveViewOptions& options);

}  // namespace stdc::app
