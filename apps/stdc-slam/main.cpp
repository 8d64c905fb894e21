// stdc-slam: the command line of the library. Each subcommand lives in a file of its own.
#include <cstdio>
#include <exception>

#include "commands/commands.hpp"
#include "core/error.hpp"

int main(int argc, char** argv) {
  constexpr int kBadInput = 2;
  stdc::app::Program program(
      "STDC-SLAM: RGB-D visual SLAM that keeps its accuracy when people walk through the scene",
      STDC_VERSION);
  stdc::app::add_run_command(program.root());
  stdc::app::add_ros2_command(program.root());
  stdc::app::add_info_command(program.root());
  stdc::app::add_calibrate_command(program.root());
  stdc::app::add_convert_command(program.root());
  stdc::app::add_record_command(program.root());
  stdc::app::add_segment_command(program.root());
  stdc::app::add_evaluate_command(program.root());
  stdc::app::add_ablation_command(program.root());
  stdc::app::add_features_command(program.root());
  stdc::app::add_map_command(program.root());
  stdc::app::add_places_command(program.root());
  stdc::app::add_render_command(program.root());
  stdc::app::add_report_command(program.root());
  stdc::app::add_settings_command(program.root());
  try {
    return program.run(argc, argv);
  } catch (const stdc::app::ExitStatus& status) {
    return status.code;
  } catch (const stdc::Error& error) {
    std::fprintf(stderr, "stdc-slam: %s\n", error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stdc-slam: internal error: %s; please report it\n", error.what());
    return 1;
  }
}
