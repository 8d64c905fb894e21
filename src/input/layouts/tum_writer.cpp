#include "input/layouts/tum_writer.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <span>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "core/images/image_codec.hpp"
#include "input/camera_file.hpp"

namespace stdc {
namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 4> kFiles{"rgb.txt", "depth.txt", "camera.yaml", "groundtruth.txt"};
constexpr const char* kDiskHint = "check the folder's permissions and the free space";

void write_bytes(const fs::path& path, std::span<const char> bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw Error(path.string(), "cannot be written", kDiskHint);
}

}  // namespace

TumWriter::TumWriter(TumTarget target) : target_(std::move(target)) {
  target_.folder = fs::absolute(target_.folder).lexically_normal();
  if (!target_.folder.has_filename()) target_.folder = target_.folder.parent_path();  // "sequence/"
  check_place();
  const fs::path above = target_.folder.parent_path();
  if (const std::error_code problem = above_.make(above)) cannot_write(problem.message());
  const fs::path partial =
      above / fmt::format(".{}.partial-{}", target_.folder.filename().string(), getpid());
  std::error_code problem;
  fs::remove_all(partial, problem);  // what a killed run may have left
  fs::create_directory(partial, problem);
  if (problem) cannot_write(problem.message());
  partial_ = partial;
}

TumWriter::~TumWriter() {
  std::error_code ignored;
  if (!partial_.empty()) fs::remove_all(partial_, ignored);
}

void TumWriter::cannot_write(const std::string& why) const {
  throw Error(target_.folder.string(), fmt::format("cannot be written ({})", why),
              fmt::format("{}, or choose another {}", kDiskHint, target_.option));
}

void TumWriter::check_place() const {
  const std::string where = target_.folder.string();
  std::error_code problem;
  const fs::file_status status = fs::status(target_.folder, problem);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status)) throw Error(where, "is not a folder", "choose another " + target_.option);
  bool empty = true, replaceable = false;
  for (fs::directory_iterator entry(target_.folder, problem), end; !problem && entry != end;
       entry.increment(problem)) {
    const std::string name = entry->path().filename().string();
    if (target_.replaceable.empty()) throw Error(where, "the folder is not empty", target_.hint);
    if (std::ranges::find(kFiles, name) == kFiles.end() &&
        std::ranges::find(target_.parts, name) == target_.parts.end()) {
      throw Error(where, fmt::format("has something else in it (\"{}\")", name), target_.hint);
    }
    empty = false;
    replaceable = replaceable || name == target_.replaceable;
  }
  if (problem) throw Error(where, fmt::format("cannot be read ({})", problem.message()), target_.hint);
  if (empty || replaceable) return;
  throw Error(where, fmt::format("holds a sequence that {} did not write", target_.option), target_.hint);
}

void TumWriter::write_image(const std::string& part, double timestamp, const cv::Mat& image) {
  write_image_file(part, timestamp, "png", encode_png(image, PngEffort::fast));
}

void TumWriter::write_image_file(const std::string& part, double timestamp, const std::string& extension,
                                 std::span<const std::uint8_t> bytes) {
  const std::string name = fmt::format("{:.6f}.{}", timestamp, extension);
  {
    const std::lock_guard lock(mutex_);
    auto& names = names_[part];
    std::error_code problem;
    if (names.empty()) fs::create_directory(partial_ / part, problem);
    if (problem) cannot_write(problem.message());
    names[timestamp] = name;
  }
  write_bytes(partial_ / part / name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void TumWriter::write_camera(const Camera& camera) {
  write_text("camera.yaml", "# Lengths in pixels.\n" + format_camera(camera));
}

void TumWriter::write_text(const std::string& name, const std::string& text) {
  write_bytes(partial_ / name, text);
}

void TumWriter::copy_file(const std::string& name, const fs::path& source) {
  std::error_code problem;
  fs::copy_file(source, partial_ / name, problem);
  if (problem)
    throw Error(source.string(), fmt::format("cannot be copied ({})", problem.message()), kDiskHint);
}

void TumWriter::write_list(const std::string& part, const std::string& title) const {
  std::string list = fmt::format("# {}\n# timestamp filename\n", title);
  if (const auto names = names_.find(part); names != names_.end()) {
    for (const auto& [timestamp, name] : names->second)
      list += fmt::format("{:.6f} {}/{}\n", timestamp, part, name);
  }
  write_bytes(partial_ / (part + ".txt"), list);
}

void TumWriter::commit() {
  write_list("rgb", "color images");
  write_list("depth", "depth maps");
  std::error_code problem;
  fs::remove_all(target_.folder, problem);  // empty, or may be replaced: see check_place
  fs::rename(partial_, target_.folder, problem);
  if (problem) cannot_write(problem.message());
  partial_.clear();
  above_.keep();
}

}  // namespace stdc
