// `ros2` in a build without Fast DDS: it says what is missing and how to get it.
#include "commands/commands.hpp"
#include "core/error.hpp"

namespace stdc::app {

void add_ros2_command(Command program) {
  Command command = program.add_subcommand("ros2", "Not in this build: it was made without Fast DDS");
  command.allow_extras();
  command.callback([] {
    throw Error("ros2", "this program was built without Fast DDS", "install libfastrtps-dev and build again");
  });
}

}  // namespace stdc::app
