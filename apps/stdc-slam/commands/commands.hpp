#pragma once

#include <CLI/CLI.hpp>

namespace stdc::app {

// Each adds its subcommand to the program; the work is done in the subcommand's callback, which throws
// stdc::Error for whatever the user can correct (exit code 2).
void add_evaluate_command(CLI::App& app);
void add_ablation_command(CLI::App& app);
void add_features_command(CLI::App& app);
void add_map_command(CLI::App& app);
void add_places_command(CLI::App& app);
void add_render_command(CLI::App& app);
void add_run_command(CLI::App& app);
void add_segment_command(CLI::App& app);
void add_settings_command(CLI::App& app);

}  // namespace stdc::app
