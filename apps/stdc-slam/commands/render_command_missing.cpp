// `render` in a build without the renderer: it says what is missing and how to get it.
#include "commands/commands.hpp"
#include "core/error.hpp"

namespace stdc::app {

void add_render_command(Command program) {
  Command command = program.add_subcommand("render", "Not in this build: it was made without the renderer");
  command.allow_extras();
  command.callback([] {
    throw Error("render", "this program was built without the renderer",
                "install libembree-dev and build with -DSTDC_BUILD_SIMULATION=ON");
  });
}

}  // namespace stdc::app
