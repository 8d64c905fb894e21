// `render` as a user meets it, in builds with the renderer and without it.
#include <gtest/gtest.h>

#include "commands/test_command_line.hpp"

namespace stdc::app {
namespace {

class RenderCommandLine : public CommandLine {};

#ifdef STDC_WITH_SIMULATION

TEST_F(RenderCommandLine, RefusesWhatWouldHaveNoEffect) {
  expect_refusal("render static-room --without-people --output o",
                 "--without-people: has no effect, nothing moves in static-room");
  Camera camera = stdc::test::test_camera();
  camera.rotation = 90;
  folder_.write("turned.yaml", format_camera(camera));
  expect_refusal("render static-room --camera turned.yaml --output o",
                 "turned.yaml: rotation 90 cannot be rendered");
  expect_refusal("render walking --output o", "there is no preset \"walking\"");
}

#else

TEST_F(RenderCommandLine, WithoutTheRendererItSaysHowToGetIt) {
  for (const char* arguments : {"render", "render static-room --output o --seed 3"}) {
    expect_refusal(
        arguments,
        "render: this program was built without the renderer; install libembree-dev and build with "
        "-DSTDC_BUILD_SIMULATION=ON");
  }
}

#endif

}  // namespace
}  // namespace stdc::app
