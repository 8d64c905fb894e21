// stdc-slam run: a sequence in, a trajectory and its scores out.
#include <fmt/format.h>

#include <memory>

#include "commands/commands.hpp"
#include "commands/options/input_options.hpp"
#include "commands/options/view_options.hpp"
#include "core/error.hpp"
#include "run/run_sequence.hpp"

namespace stdc::app {
namespace {

constexpr const char* kRunFooter = R"(
INPUT is a folder in TUM RGB-D layout: rgb.txt and depth.txt with "timestamp filename" lines, images as PNG or
JPEG, depth as 16-bit PNG, perhaps groundtruth.txt. Or a folder in the layout of another data set, or a recording:
docs/inputs.md has them all, `stdc-slam info INPUT` says what one is. The camera is taken from --camera, else from
camera.yaml in the folder, else as the kind of input says. Depth that is not registered to the colour images is
registered if the depth camera is known (depth_camera in the camera file).

Written to the output folder, all at the end or nothing:
  trajectory.txt  "timestamp tx ty tz qx qy qz qw" of every frame that has a pose; world = first camera of the
                  map. Where tracking was lost for good another map was started: then those of the map that
                  holds most of them
  trajectory-map-N.txt  the frames of each other map that was not joined to it, in coordinates of its own
  keyframes.txt   the same as trajectory.txt of the keyframes
  frames.csv      status, map at the time, keypoints, matches, inliers, milliseconds per stage and loops of
                  every frame
  summary.json    coverage (share of the frames that are in trajectory.txt), maps, loops, times, memory, scores,
                  camera, settings, version
  report.html     all of it to look at, in a browser: figures, sample frames, warnings, settings, commands; one
                  file that loads nothing. `stdc-slam report A B` puts runs side by side

--inpaint DIR makes DIR a sequence of the same layout without what moves: rgb, depth, their lists, camera.yaml and
groundtruth.txt, and unknown: masks of what no frame has seen (255; black there, depth 0). It is filled with what frames
before it saw, with --inpaint-all also with what came later. A frame without a pose keeps only what does not move.

--dense FILE makes a map of the surfaces that do not move, in the coordinates of trajectory.txt (octree and plan:
z up, floor at 0). With --save-map the map file keeps what it is made of, for map export.

A map saved by --save-map holds all maps of the run. --load-map goes on with it: once a mapped place is seen
again, poses are in its coordinates. With --localisation-only nothing is added to it.

Exit code: 0, 2 for bad input (nothing is written), 3 if no frame got a pose (results are written, no map).

Examples:
  stdc-slam run rgbd_dataset_freiburg1_xyz --output results
  stdc-slam run my-sequence --camera my-camera.yaml --output results --frames 100:400
  stdc-slam run my-sequence --output results --set features.keypoints=2000 --selection orb-slam3
  stdc-slam run my-sequence --output results --realtime --set segmentation.pace=asynchronous
  stdc-slam run stamps-made-by-hand --output results --rate 30
  stdc-slam run empty-room --output results --segmentation off --motion off
  stdc-slam run my-sequence --output results --segmentation off --motion map --save-masks masks
  stdc-slam run my-sequence --output results --inpaint empty-room --inpaint-all
  stdc-slam run my-sequence --output results --dense room.glb --dense map.yaml
  stdc-slam run my-sequence --output results --save-map office.map
  stdc-slam run second-visit --output results --load-map office.map --save-map office.map
  stdc-slam run third-visit --output results --load-map office.map --localisation-only
  stdc-slam run my-sequence --output results --debug-images pictures --debug-every 30)";

void add_options(Command command, RunOptions& options) {
  command.add_option("INPUT", options.input.path, kInputHelp).required();
  command.add_option("--output,-o", options.output, "Folder for the results; made if need be").required();
  add_input_options(command, options.input);
  add_truth_option(command, options.input);
  add_settings_options(command, options.settings);
  add_motion_option(command, options.settings);
  add_segmentation_options(command, options.segmentation);
  command.add_option("--load-map", options.load_map, "Map of an earlier run to start from");
  command.add_option("--save-map", options.save_map, "File for the map; written when all went well");
  command
      .add_option("--dense", options.dense.files,
                  "File for the dense map of all that does not move: .glb or .ply (mesh), .pcd (cloud), .bt "
                  "(OctoMap), .yaml or .pgm (plan for robots); may be given several times")
      .one_value_each();
  add_detail_options(command, "--dense-", options.dense.detail);
  command.add_flag("--localisation-only", options.localisation_only,
                   "Only find the camera in the loaded map, and leave that as it is");
  add_frames_option(command, options.input);
  const CommandOption debug_images =
      command.add_option("--debug-images", options.debug_images, "Folder for pictures of what was found");
  command
      .add_option("--debug-every", options.debug_every, "A picture of every n-th frame and of the lost ones")
      .capture_default_str()
      .needs(debug_images);
  command.add_option(
      "--save-masks", options.save_masks,
      "Folder for the mask of what moves in each frame (255 = dynamic), as --masks reads them");
  command.add_option("--true-masks", options.true_masks,
                     "Folder of true masks, named like --masks, to score the masks of what moves against");
  const CommandOption inpaint = command.add_option(
      "--inpaint", options.inpaint,
      "Folder for the sequence without what moves, filled with what earlier frames saw behind it");
  command.add_flag("--inpaint-all", options.inpaint_all, "Fill it with what later frames saw, too")
      .needs(inpaint);
  command.add_flag("--realtime", options.realtime,
                   "Give frames out at the pace of their timestamps, and tell how long each took from there");
  const CommandOption view = add_view_options(command, options.view);
  command.add_flag("--view-wait", options.view.wait, "Begin when somebody looks").needs(view);
  command.add_flag("--no-report", options.no_report, "Leave out report.html");
  command.add_flag("--quiet,-q", options.quiet, "Print only what goes wrong");
  command.footer(kRunFooter);
}

}  // namespace

void add_run_command(Command program) {
  auto options = std::make_shared<RunOptions>();
  Command command = program.add_subcommand("run", "Find the camera's trajectory through an RGB-D sequence");
  add_options(command, *options);
  command.callback([options] {
    if (options->debug_every < 1) {
      throw Error("--debug-every", fmt::format("{} is less than 1", options->debug_every), "give 1 or more");
    }
    constexpr int kNothingFound = 3;
    if (!run_sequence(*options)) throw ExitStatus{kNothingFound};
  });
}

}  // namespace stdc::app
