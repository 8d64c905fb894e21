#include "input/recordings/open_recording.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>

#include "core/error.hpp"
#include "input/recordings/containers/bag_recording.hpp"
#include "input/recordings/containers/db3_recording.hpp"
#include "input/recordings/containers/mcap_recording.hpp"
#include "input/recordings/containers/rosbag2_folder.hpp"
#include "input/recordings/containers/unpacked_file.hpp"
#include "input/recordings/containers/unpacked_messages.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

enum class Kind { none, mcap, bag, old_bag, db3, zstd };

Kind kind_of(Bytes beginning) {
  if (is_mcap(beginning)) return Kind::mcap;
  if (is_bag(beginning)) return Kind::bag;
  if (is_sqlite(beginning)) return Kind::db3;
  if (is_zstd(beginning)) return Kind::zstd;
  const std::string_view text(reinterpret_cast<const char*>(beginning.data()), beginning.size());
  return text.starts_with("#ROSBAG ") || text.starts_with("#ROSRECORD ") ? Kind::old_bag : Kind::none;
}

Kind kind_of(const fs::path& path) {
  std::array<char, 16> bytes{};
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), bytes.size());
  return kind_of(
      {reinterpret_cast<const std::uint8_t*>(bytes.data()), static_cast<std::size_t>(file.gcount())});
}

/// @param path  where the bytes are: the file, or what was unpacked of it
std::unique_ptr<Recording> open_file(const fs::path& path, const std::string& where) {
  constexpr const char* kKindHint = "give an .mcap, .bag or .db3 recording, or a folder of rosbag2";
  std::unique_ptr<ByteStore> bytes = open_byte_file(path);
  switch (kind_of(path)) {
    case Kind::mcap:
      return std::make_unique<McapRecording>(std::move(bytes), where);
    case Kind::bag:
      return std::make_unique<BagRecording>(std::move(bytes), where);
    case Kind::db3:
      return open_db3_recording(path, where);
    case Kind::old_bag:
      throw Error(where, "is a ROS bag of a version before 2.0",
                  "bring it up to date by 'rosbag fix' or 'rosbag reindex'");
    default:
      throw Error(where, bytes->size() == 0 ? "is empty" : "is no recording of a kind that is known",
                  kKindHint);
  }
}

}  // namespace

std::string recording_format(const fs::path& path) {
  std::error_code failed;
  if (fs::is_directory(path, failed)) return rosbag2_format(path);
  if (!fs::is_regular_file(path, failed)) return "";
  switch (kind_of(path)) {
    case Kind::mcap:
      return "mcap";
    case Kind::bag:
    case Kind::old_bag:
      return "bag";
    case Kind::db3:
      return "db3";
    case Kind::zstd:
      return storage_format(path);
    default:
      return "";
  }
}

static std::unique_ptr<Recording> open_recording_file(const fs::path& path) {
  if (kind_of(path) != Kind::zstd) return open_file(path, path.string());
  // What is open stays readable after its name is gone.
  const UnpackedFile unpacked(path);
  return open_file(unpacked.path(), path.string());
}

std::unique_ptr<Recording> open_recording(const fs::path& path) {
  std::error_code failed;
  const bool metadata = path.filename() == kRosbag2Metadata && fs::is_regular_file(path, failed);
  std::unique_ptr<Recording> recording;
  if (metadata || fs::is_directory(path, failed)) {
    const fs::path parent = path.parent_path();
    recording = open_rosbag2_folder(!metadata        ? path
                                    : parent.empty() ? fs::path(".")
                                                     : parent,
                                    open_recording_file);
  } else {
    recording = open_recording_file(path);
  }
  recording = unpack_messages(std::move(recording));
  if (recording->topics().empty()) {
    throw Error(path.string(), "holds no message",
                "record again; see that 'ros2 bag info' or 'rosbag info' lists topics");
  }
  return recording;
}

}  // namespace stdc
