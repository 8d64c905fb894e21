#pragma once

#include "commands/command.hpp"

namespace stdc::app {

// Each adds its subcommand to the program; the work is done in the subcommand's callback, which throws
// stdc::Error for whatever the user can correct (exit code 2).
void add_calibrate_command(Command program);
void add_convert_command(Command program);
void add_evaluate_command(Command program);
void add_ablation_command(Command program);
void add_features_command(Command program);
void add_info_command(Command program);
void add_map_command(Command program);
void add_places_command(Command program);
void add_record_command(Command program);
void add_render_command(Command program);
void add_report_command(Command program);
void add_ros2_command(Command program);
void add_run_command(Command program);
void add_segment_command(Command program);
void add_settings_command(Command program);

}  // namespace stdc::app
