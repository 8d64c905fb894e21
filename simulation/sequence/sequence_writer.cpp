#include "simulation/sequence/sequence_writer.hpp"

#include <fmt/format.h>

#include <cassert>
#include <fstream>

#include "core/error.hpp"
#include "core/image_codec.hpp"
#include "input/camera_file.hpp"

namespace stdc::simulation {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannot_write(const fs::path& path, const std::string& why) {
  throw Error(path.string(), "cannot be written" + (why.empty() ? "" : " (" + why + ")"),
              "check the folder's permissions and the free space, or choose another --output");
}

void write_bytes(const fs::path& path, const char* data, std::size_t size) {
  std::ofstream file(path, std::ios::binary);
  file.write(data, static_cast<std::streamsize>(size));
  file.close();
  if (!file) cannot_write(path, "");
}

void write_text(const fs::path& path, const std::string& text) {
  write_bytes(path, text.data(), text.size());
}

void write_png(const fs::path& path, const cv::Mat& image) {
  const std::vector<std::uint8_t> bytes = encode_png(image, PngEffort::fast);
  write_bytes(path, reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

/// A folder that must not be replaced is an error.
void check_target(const fs::path& folder, bool overwrite) {
  std::error_code problem;
  const fs::file_status status = fs::status(folder, problem);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status)) throw Error(folder.string(), "is not a folder", "choose another --output");
  if (fs::is_empty(folder, problem)) return;
  if (!overwrite) {
    throw Error(folder.string(), "the output folder is not empty",
                "remove it, choose another --output or add --overwrite");
  }
  if (!fs::exists(folder / "rgb.txt")) {
    throw Error(folder.string(), "holds something else than a sequence",
                "remove it yourself or choose another --output");
  }
}

}  // namespace

SequenceWriter::SequenceWriter(const fs::path& folder, const Camera& camera, int frame_count, bool overwrite)
    : folder_(fs::absolute(folder).lexically_normal()),
      camera_(camera),
      entries_(static_cast<std::size_t>(frame_count)) {
  if (frame_count <= 0) throw Error("frames", "there is nothing to write", "ask for one frame or more");
  if (!folder_.has_filename()) folder_ = folder_.parent_path();  // a path that ends in a slash
  check_target(folder_, overwrite);
  partial_ = folder_.parent_path() / fmt::format(".{}.partial", folder_.filename().string());
  std::error_code problem;
  fs::remove_all(partial_, problem);  // what a killed run may have left
  for (const char* part : {"rgb", "depth", "mask"}) {
    fs::create_directories(partial_ / part, problem);
    if (problem) cannot_write(folder_, problem.message());
  }
}

SequenceWriter::~SequenceWriter() {
  if (finished_) return;
  std::error_code ignored;
  fs::remove_all(partial_, ignored);
}

void SequenceWriter::write(int index, const RenderedFrame& frame) {
  Entry& entry = entries_.at(static_cast<std::size_t>(index));
  const std::string stamp = fmt::format("{:.6f}", frame.image.timestamp);
  write_png(partial_ / "rgb" / (stamp + ".png"), frame.image.colour);
  write_png(partial_ / "depth" / (stamp + ".png"), frame.image.depth);
  write_png(partial_ / "mask" / (stamp + ".png"), frame.mask);
  if (!frame.moved.empty()) {
    std::error_code problem;
    fs::create_directories(partial_ / "moved", problem);
    if (problem) cannot_write(folder_, problem.message());
    write_png(partial_ / "moved" / (stamp + ".png"), frame.moved);
  }
  entry = {stamp, frame.world_from_cam};
}

void SequenceWriter::write_lists() const {
  std::string colour = "# color images\n# timestamp filename\n",
              depth = "# depth maps\n# timestamp filename\n";
  std::string poses =
      "# ground truth: pose of the colour camera in the world\n# timestamp tx ty tz qx qy qz qw\n";
  for (const Entry& entry : entries_) {
    assert(!entry.stamp.empty());
    const Eigen::Vector3d& t = entry.world_from_cam.translation;
    const Eigen::Quaterniond& q = entry.world_from_cam.rotation;
    colour += fmt::format("{0} rgb/{0}.png\n", entry.stamp);
    depth += fmt::format("{0} depth/{0}.png\n", entry.stamp);
    poses += fmt::format("{} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f} {:.9f}\n", entry.stamp, t.x(), t.y(),
                         t.z(), q.x(), q.y(), q.z(), q.w());
  }
  write_text(partial_ / "rgb.txt", colour);
  write_text(partial_ / "depth.txt", depth);
  write_text(partial_ / "groundtruth.txt", poses);
  write_text(partial_ / "camera.yaml", "# Lengths in pixels.\n" + format_camera(camera_));
}

void SequenceWriter::finish() {
  write_lists();
  std::error_code problem;
  fs::remove_all(folder_, problem);  // empty, or a sequence that may be overwritten: see check_target
  fs::rename(partial_, folder_, problem);
  if (problem) cannot_write(folder_, problem.message());
  finished_ = true;
}

}  // namespace stdc::simulation
