#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/types.hpp>
#include <optional>

#include "input/frame_source.hpp"
#include "input/source_options.hpp"

namespace stdc {

// Layouts of folders beside TUM's, each in a file of its own. matches: by the names of files alone. open:
// throws Error for whatever is wrong; a camera.yaml in the folder goes before what the layout says of the
// camera.

/// associations.txt, rgb/, depth/ and *.gt.freiburg, as the "TUM RGB-D compatible PNGs" of ICL-NUIM (Handa et
/// al., ICRA 2014). Their fy is negative: the true poses are those of a camera whose y points up, in a
/// left-handed world; they are turned into the usual axes.
bool is_icl_nuim(const std::filesystem::path& path);
std::unique_ptr<FrameSource> open_icl_nuim(const std::filesystem::path& path, const SourceOptions& options);

/// color.txt, aligned_depth.txt, sensors.yaml, as OpenLORIS-Scene (Shi et al., ICRA 2020). Its true poses are
/// those of the robot's base; with trans_matrix.yaml they become those of the colour camera.
bool is_openloris(const std::filesystem::path& path);
std::unique_ptr<FrameSource> open_openloris(const std::filesystem::path& path, const SourceOptions& options);

/// frame-000000.color.png, .depth.png (not registered, millimetres, 65535 = missing), .pose.txt, as 7-Scenes
/// (Shotton et al., CVPR 2013).
bool is_seven_scenes(const std::filesystem::path& path);
std::unique_ptr<FrameSource> open_seven_scenes(const std::filesystem::path& path,
                                               const SourceOptions& options);

/// color/, depth/, pose/, intrinsic/, as the frames of ScanNet (Dai et al., CVPR 2017) are exported.
bool is_scannet(const std::filesystem::path& path);
std::unique_ptr<FrameSource> open_scannet(const std::filesystem::path& path, const SourceOptions& options);

/// color/ or image/ or rgb/, depth/ (millimetres), an intrinsic JSON, trajectory.log: what Open3D's
/// reconstruction system reads, and the Redwood scans (Choi et al., 2016). Any two folders of colour and
/// depth images will do; the colour images may be one video beside depth/.
bool is_open3d(const std::filesystem::path& path);
std::unique_ptr<FrameSource> open_open3d(const std::filesystem::path& path, const SourceOptions& options);

/// rgb.mp4 (or its frames in rgb/), depth/, confidence/, camera_matrix.csv, odometry.csv, as the app Stray
/// Scanner writes. Its poses have the usual axes (https://github.com/strayrobots/scanner/issues/11).
bool is_stray_scanner(const std::filesystem::path& path);
std::unique_ptr<FrameSource> open_stray_scanner(const std::filesystem::path& path,
                                                const SourceOptions& options);

/// metadata.json, rgb/N.jpg, depth/N.exr in metres, also below EXR_RGBD/, as the app Record3D exports by "EXR
/// + JPG". By what its author says (https://github.com/marek-simonik/record3d/issues/27, 36, 64, 75, 108): K,
/// column by column, is that of the colour images; depth is registered to them, of fewer pixels; the poses
/// are ARKit's, world from camera with the axes of OpenGL; frameTimestamps are seconds after the first frame.
bool is_record3d(const std::filesystem::path& path);
std::unique_ptr<FrameSource> open_record3d(const std::filesystem::path& path, const SourceOptions& options);

/// cam0/data.csv with nanoseconds and cam0/sensor.yaml, as EuRoC (Burri et al., IJRR 2016), with a folder of
/// depth images beside it.
bool is_euroc(const std::filesystem::path& path);
std::unique_ptr<FrameSource> open_euroc(const std::filesystem::path& path, const SourceOptions& options);

/// The cameras of camera.yaml in a folder; nothing if it has none.
std::optional<RgbdCameras> own_cameras(const std::filesystem::path& folder);
/// The camera of an image of the same view with another number of pixels.
Camera scaled_camera(const Camera& camera, cv::Size size);
/// Frame rate by which frame numbers become times: --rate, else what the layout says.
double rate_of(const SourceOptions& options, double usual);

}  // namespace stdc
