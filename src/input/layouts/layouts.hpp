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
/// depth images will do.
bool is_open3d(const std::filesystem::path& path);
std::unique_ptr<FrameSource> open_open3d(const std::filesystem::path& path, const SourceOptions& options);

/// rgb/ (frames of rgb.mp4), depth/, confidence/, camera_matrix.csv, odometry.csv, as the app Stray Scanner.
bool is_stray_scanner(const std::filesystem::path& path);
std::unique_ptr<FrameSource> open_stray_scanner(const std::filesystem::path& path,
                                                const SourceOptions& options);

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
