#include "run/inpainted_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <span>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "core/image_codec.hpp"
#include "input/camera_file.hpp"

namespace stdc::app {
namespace fs = std::filesystem;

namespace {

constexpr const char* kHint = "give another --inpaint folder or free it";
constexpr std::array<const char*, 3> kParts{"rgb", "depth", "unknown"};

void write_bytes(const fs::path& path, std::span<const char> bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw Error(path.string(), "cannot be written", "check the free space and the permissions");
}

void write_png(const fs::path& path, const cv::Mat& image) {
  const std::vector<std::uint8_t> png = encode_png(image, PngEffort::fast);
  write_bytes(path, {reinterpret_cast<const char*>(png.data()), png.size()});
}

bool is_of_this_kind(const fs::path& name) {
  constexpr std::array<std::string_view, 7> kOwn{"rgb",       "depth",       "unknown",        "rgb.txt",
                                                 "depth.txt", "camera.yaml", "groundtruth.txt"};
  return std::find(kOwn.begin(), kOwn.end(), name.string()) != kOwn.end();
}

/// What stands at the place must be nothing, or of an earlier run.
void check_place(const fs::path& folder) {
  std::error_code problem;
  const fs::file_status status = fs::status(folder, problem);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status)) throw Error(folder.string(), "is not a folder", "give another --inpaint");
  bool empty = true;
  for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end;
       entry.increment(problem)) {
    empty = false;
    if (is_of_this_kind(entry->path().filename())) continue;
    throw Error(folder.string(),
                fmt::format("has something else in it (\"{}\")", entry->path().filename().string()), kHint);
  }
  if (problem) throw Error(folder.string(), fmt::format("cannot be read ({})", problem.message()), kHint);
  if (empty || fs::is_directory(folder / "unknown", problem)) return;
  throw Error(folder.string(), "holds a sequence that --inpaint did not write", kHint);
}

}  // namespace

InpaintedFolder::InpaintedFolder(const fs::path& folder, const SequenceInput& input)
    : input_(input), folder_(fs::absolute(folder).lexically_normal()), written_(input.frames.size(), 0) {
  if (!folder_.has_filename()) folder_ = folder_.parent_path();  // a path that ends in a slash
  std::error_code problem;
  if (fs::equivalent(folder_, input.sequence.folder(), problem)) {
    throw Error(folder_.string(), "is the folder of the sequence itself", "give another --inpaint folder");
  }
  check_place(folder_);
  partial_ = folder_.parent_path() / fmt::format(".{}.partial-{}", folder_.filename().string(), getpid());
  make_partial();
}

InpaintedFolder::~InpaintedFolder() {
  if (!partial_.empty()) remove_what_was_made();
}

void InpaintedFolder::make_partial() {
  std::error_code problem;
  for (fs::path above = folder_.parent_path(); !above.empty() && !fs::exists(above, problem);
       above = above.parent_path()) {
    made_.insert(made_.begin(), above);
  }
  for (const char* part : kParts) {
    fs::create_directories(partial_ / part, problem);
    if (!problem) continue;
    remove_what_was_made();
    throw Error(folder_.string(), fmt::format("cannot be written to ({})", problem.message()), kHint);
  }
}

void InpaintedFolder::remove_what_was_made() noexcept {
  std::error_code ignored;
  fs::remove_all(partial_, ignored);
  // Innermost first; a folder that somebody else has put something into stays.
  for (auto path = made_.rbegin(); path != made_.rend(); ++path) fs::remove(*path, ignored);
}

void InpaintedFolder::write(int index, const InpaintedFrame& frame) {
  const SequenceFrame& source = input_.frames[static_cast<std::size_t>(index)];
  const std::string name = fmt::format("{:.6f}.png", source.timestamp);
  write_png(partial_ / "rgb" / name, frame.colour);
  write_png(partial_ / "depth" / fmt::format("{:.6f}.png", source.depth_timestamp), frame.depth);
  write_png(partial_ / "unknown" / name, frame.unknown);
  written_[static_cast<std::size_t>(index)] = 1;
}

void InpaintedFolder::write_lists() const {
  std::string colour = "# color images without what moves\n# timestamp filename\n";
  std::string depth = "# depth maps without what moves\n# timestamp filename\n";
  for (std::size_t i = 0; i < written_.size(); ++i) {
    if (written_[i] == 0) continue;
    colour += fmt::format("{0:.6f} rgb/{0:.6f}.png\n", input_.frames[i].timestamp);
    depth += fmt::format("{0:.6f} depth/{0:.6f}.png\n", input_.frames[i].depth_timestamp);
  }
  write_bytes(partial_ / "rgb.txt", colour);
  write_bytes(partial_ / "depth.txt", depth);
  write_bytes(partial_ / "camera.yaml", "# Lengths in pixels.\n" + format_camera(input_.camera));
  std::error_code problem;
  if (!fs::exists(input_.truth_path(), problem)) return;
  fs::copy_file(input_.truth_path(), partial_ / "groundtruth.txt", problem);
  if (problem) {
    throw Error(input_.truth_path().string(), fmt::format("cannot be copied ({})", problem.message()),
                "check the free space and the permissions");
  }
}

void InpaintedFolder::commit() {
  write_lists();
  std::error_code problem;
  fs::remove_all(folder_, problem);  // empty, or of an earlier run: see check_place
  fs::rename(partial_, folder_, problem);
  if (problem)
    throw Error(folder_.string(), fmt::format("cannot be replaced ({})", problem.message()), kHint);
  partial_.clear();
}

}  // namespace stdc::app
