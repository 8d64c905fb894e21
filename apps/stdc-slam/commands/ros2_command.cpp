// stdc-slam ros2: a part of a robot that speaks ROS 2, without an installation of ROS.
#include <memory>

#include "commands/commands.hpp"
#include "commands/options/ros2_camera_arguments.hpp"
#include "commands/options/view_options.hpp"
#include "run/ros2/run_ros2.hpp"

namespace stdc::app {
namespace {

constexpr const char* kRos2Footer = R"(
Joins the ROS 2 system of ROS_DOMAIN_ID as a node would (by DDS; ROS_LOCALHOST_ONLY is heeded) and works until Ctrl-C,
which writes what --output and --save-map ask for. The camera is taken from --camera, else from its camera_info; depth
of another camera is registered by its camera_info and /tf_static. TOPIC/compressed and TOPIC/compressedDepth are read
as compressed images.

Published, stamped as the colour image:
  /stdc_slam/odometry       nav_msgs/Odometry: odom -> base_link, with covariance, smooth
  /tf                       map -> odom -> base_link (REP 105); a loop that is closed moves map -> odom
  /stdc_slam/path           nav_msgs/Path: the keyframes in the map, once a second
  /stdc_slam/landmarks      sensor_msgs/PointCloud2 in the map, once a second
  /stdc_slam/dynamic_mask   sensor_msgs/Image mono8, 255 = moves; with --dynamic-mask
  /stdc_slam/debug_image    sensor_msgs/Image bgr8; with --debug-image
  /diagnostics              diagnostic_msgs/DiagnosticArray, once a second

Asked for by a message of std_msgs/Empty:
  /stdc_slam/save_map            writes the map to the file of --save-map
  /stdc_slam/reset               forgets the map and begins anew
  /stdc_slam/start_localisation  keeps the map as it is, and only finds the camera in it
  /stdc_slam/start_mapping       lets the map grow again

Exit code: 0, 2 for bad input, 3 if no frame got a pose.

Examples:
  stdc-slam ros2 --color /camera/color/image_raw --depth /camera/aligned_depth_to_color/image_raw
  stdc-slam ros2 --color /camera/color/image_raw --depth /camera/depth/image_rect_raw --base-frame base_footprint
  stdc-slam ros2 --color ... --depth ... --view                        (watch it at http://localhost:8080/)
  stdc-slam ros2 --color ... --depth ... --load-map office.map --localisation-only
  stdc-slam ros2 --color ... --depth ... --reception every-frame --output results     (beside ros2 bag play)
  ros2 topic pub --once /stdc_slam/save_map std_msgs/msg/Empty)";

void add_names(Command command, Ros2Options& options) {
  command.add_option("--base-frame", options.names.base, "Frame of the robot's base").capture_default_str();
  command.add_option("--odom-frame", options.names.odom, "Frame of odometry").capture_default_str();
  command.add_option("--map-frame", options.names.map, "Frame of the map").capture_default_str();
  command.add_option("--prefix", options.names.prefix, "Prefix of the topics of its own")
      .capture_default_str();
}

}  // namespace

void add_ros2_command(Command program) {
  auto options = std::make_shared<Ros2Options>();
  Command command = program.add_subcommand("ros2", "Be part of a robot that speaks ROS 2");
  add_ros2_camera_arguments(command, options->images, true);
  command.add_option("--camera", options->camera, "Camera file; goes before what camera_info says");
  add_names(command, *options);
  add_settings_options(command, options->settings);
  add_motion_option(command, options->settings);
  add_segmentation_options(command, options->segmentation);
  command.add_option("--load-map", options->load_map, "Map of an earlier run to start from");
  command.add_option("--save-map", options->save_map, "File for the map: at the end, and at request");
  command.add_flag("--localisation-only", options->localisation_only,
                   "Only find the camera in the loaded map, and leave that as it is");
  command.add_option("--output,-o", options->output,
                     "Folder for trajectory.txt, keyframes.txt and frames.csv, written at the end");
  command.add_option("--frames", options->frames, "Only frames A to B-1, counted from 0; then it ends")
      .type_name("A:B");
  command.add_flag("--dynamic-mask", options->publish_mask, "Publish the mask of what moves; costs latency");
  command.add_flag("--debug-image", options->publish_debug_image,
                   "Publish a picture of the keypoints; costs latency");
  add_view_options(command, options->view);
  command.add_flag("--quiet,-q", options->quiet, "Print only what goes wrong");
  command.footer(kRos2Footer);
  command.callback([options] {
    constexpr int kNothingFound = 3;
    if (!run_ros2(*options)) throw ExitStatus{kNothingFound};
  });
}

}  // namespace stdc::app
