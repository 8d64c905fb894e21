#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "input/layouts/image_folder.hpp"
#include "input/layouts/layouts.hpp"
#include "input/layouts/pose_files.hpp"
#include "input/layouts/record3d_metadata.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRecord3dHint = "export the recording again, as 'EXR + JPG', and copy the whole folder";

using NumberedFiles = std::map<std::size_t, ImageFile>;

/// "41.jpg" is frame 41.
NumberedFiles by_frame(const std::vector<NamedImage>& images) {
  constexpr double kMaxFrame = 1e9;
  NumberedFiles files;
  for (const NamedImage& image : images) {
    if (!image.number || *image.number != std::floor(*image.number) || *image.number > kMaxFrame) continue;
    files[static_cast<std::size_t>(*image.number)] = {image.path, image.path.string()};
  }
  return files;
}

/// The folder that holds metadata.json.
fs::path root_of_export(const fs::path& path) {
  return is_file(path / "metadata.json") ? path : path / "EXR_RGBD";
}

/// Depth is registered to colour, mostly with fewer pixels.
RgbdCameras record3d_cameras(const Camera& camera, const FolderFrame& first, const std::string& where) {
  const cv::Size size = size_of_image(first.colour.path),
                 depth_size = read_depth_file(first.depth, {}).size();
  const double x = static_cast<double>(size.width) / camera.width;
  const double y = static_cast<double>(size.height) / camera.height;
  if (std::abs(x / y - 1) > 0.02) {
    throw Error(first.colour.where,
                fmt::format("is {} x {} pixels, but by {} it has {} x {}", size.width, size.height, where,
                            camera.width, camera.height),
                "restore the files, or put a camera.yaml into the folder");
  }
  RgbdCameras cameras;
  cameras.colour = scaled_camera(camera, size);
  if (depth_size != size) cameras.depth = DepthCamera{scaled_camera(cameras.colour, depth_size), {}};
  return cameras;
}

/// Gives each frame its time; those of the app if it wrote one for each.
void set_record3d_times(const std::vector<double>& times, std::optional<double> rate, double usual_rate,
                        const std::vector<std::size_t>& numbers, FolderContents& contents) {
  const bool known = !rate && numbers.back() < times.size();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double time =
        known ? times[numbers[i]] : static_cast<double>(numbers[i]) / rate.value_or(usual_rate);
    contents.frames[i].timestamp = contents.frames[i].depth_timestamp = time;
  }
  if (known || rate) return;
  contents.notes.push_back(fmt::format("{}: has no times: frame n is taken to be at n / {:g} s (--rate)",
                                       contents.where, usual_rate));
}

/// Frames that have both images. @returns their numbers
std::vector<std::size_t> add_record3d_frames(const fs::path& root, FolderContents& contents) {
  const NumberedFiles colour = by_frame(list_colour_images(root / "rgb"));
  const NumberedFiles depth = by_frame(list_depth_images(root / "depth"));
  NumberedFiles confidence;
  const auto folder = first_folder(root, {"confidence", "conf"});
  if (folder) confidence = by_frame(list_images(*folder, {".png"}));
  std::vector<std::size_t> numbers;
  for (const auto& [number, file] : colour) {
    const auto found = depth.find(number);
    if (found == depth.end()) continue;
    const auto sure = confidence.find(number);
    contents.frames.push_back(
        {0, 0, file, found->second, sure == confidence.end() ? ImageFile{} : sure->second, {}});
    numbers.push_back(number);
  }
  if (numbers.empty()) throw Error(root.string(), "no frame has images in both rgb and depth", kRecord3dHint);
  contents.colour_without_depth = static_cast<int>(colour.size() - numbers.size());
  contents.streams = {{"rgb", "colour images", static_cast<int>(colour.size())},
                      {"depth", "depth images", static_cast<int>(depth.size())}};
  if (folder) {
    contents.streams.push_back({folder->filename().string(), "depth without confidence is left out",
                                static_cast<int>(confidence.size())});
  }
  return numbers;
}

/// ARKit's poses of the frames.
GroundTruth record3d_truth(const std::vector<std::optional<Pose>>& poses,
                           const std::vector<std::size_t>& numbers, const std::vector<FolderFrame>& frames) {
  GroundTruth truth;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    add_row(truth, frames[i].timestamp, numbers[i] < poses.size() ? poses[numbers[i]] : std::nullopt);
  }
  return truth;
}

}  // namespace

bool is_record3d(const fs::path& path) {
  const fs::path root = root_of_export(path);
  return is_file(root / "metadata.json") && is_folder(root / "rgb") && is_folder(root / "depth");
}

std::unique_ptr<FrameSource> open_record3d(const fs::path& path, const SourceOptions& options) {
  constexpr std::size_t kMaxMetadata = std::size_t{1} << 26;
  const fs::path root = root_of_export(path), file = root / "metadata.json";
  const Record3dMetadata metadata =
      parse_record3d_metadata(read_file(file, kRecord3dHint, kMaxMetadata), file.string());
  FolderContents contents;
  contents.kind = "record3d";
  contents.where = path.string();
  const std::vector<std::size_t> numbers = add_record3d_frames(root, contents);
  set_record3d_times(metadata.times, options.rate, metadata.camera.frames_per_second, numbers, contents);
  contents.cameras = own_cameras(path);
  if (!contents.cameras) contents.cameras = own_cameras(root);
  if (!contents.cameras) {
    contents.cameras = record3d_cameras(metadata.camera, contents.frames.front(), file.string());
  }
  contents.truth_where = file.string();
  if (metadata.poses.empty()) return std::make_unique<FolderSource>(std::move(contents));
  contents.read_truth = [truth = record3d_truth(metadata.poses, numbers, contents.frames)] { return truth; };
  contents.streams.push_back(
      {"metadata.json", "camera, times, and poses of ARKit", static_cast<int>(metadata.poses.size())});
  contents.notes.push_back(file.string() +
                           ": what is scored against are poses that ARKit found, no ground truth");
  return std::make_unique<FolderSource>(std::move(contents));
}

}  // namespace stdc
