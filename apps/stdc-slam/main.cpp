// stdc-slam: the command line of the library. Each subcommand lives in a file of its own.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "commands/commands.hpp"
#include "core/error.hpp"

int main(int argc, char** argv) {
  constexpr int kBadInput = 2;
  CLI::App app{"STDC-SLAM: RGB-D visual SLAM that keeps its accuracy when people walk through the scene"};
  app.set_version_flag("--version", STDC_VERSION);
  app.require_subcommand(1);
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string("stdc-slam: ") + error.what() + "; run with --help to see the options\n";
  });
  stdc::app::add_run_command(app);
  stdc::app::add_segment_command(app);
  stdc::app::add_evaluate_command(app);
  stdc::app::add_ablation_command(app);
  stdc::app::add_features_command(app);
  stdc::app::add_map_command(app);
  stdc::app::add_places_command(app);
  stdc::app::add_render_command(app);
  stdc::app::add_settings_command(app);
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::RuntimeError& error) {
    return error.get_exit_code();  // said already
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : kBadInput;
  } catch (const stdc::Error& error) {
    std::fprintf(stderr, "stdc-slam: %s\n", error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stdc-slam: internal error: %s; please report it\n", error.what());
    return 1;
  }
}
