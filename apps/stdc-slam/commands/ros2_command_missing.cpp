// `ros2` and `record ros2:` in a build without Fast DDS: they say what is missing and how to get it.
#include "commands/commands.hpp"
#include "core/error.hpp"
#include "run/ros2/record_ros2.hpp"

namespace stdc::app {
namespace {

[[noreturn]] void say_what_is_missing(const char* what) {
  throw Error(what, "this program was built without Fast DDS", "install libfastrtps-dev and build again");
}

}  // namespace

void add_ros2_command(Command program) {
  Command command = program.add_subcommand("ros2", "Not in this build: it was made without Fast DDS");
  command.allow_extras();
  command.callback([] { say_what_is_missing("ros2"); });
}

void with_ros2_camera(const Ros2CameraOptions&, const InputOptions&, const InterruptWatch&,
                      const std::function<void(const SequenceInput&)>&) {
  say_what_is_missing("ros2:");
}

}  // namespace stdc::app
