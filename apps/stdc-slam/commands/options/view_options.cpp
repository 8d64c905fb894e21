#include "commands/options/view_options.hpp"

namespace stdc::app {

CommandOption add_view_options(Command command, LiveViewOptions& options) {
  CommandOption view = command
                           .add_option("--view", options.port,
                                       "Show it in a browser while it goes on, at http://localhost:PORT/")
                           .optional_number("PORT", "8080");
  command
      .add_option("--view-address", options.address,
                  "Address of this machine to show it at to others too, 0.0.0.0 for all; the link, which is "
                  "printed, then has a token")
      .needs(view);
  return view;
}

}  // namespace stdc::app
