#include "input/layouts/scannet/sens_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <istream>

#include "core/error.hpp"
#include "input/layouts/number_file.hpp"

namespace stdc {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is little-endian");

constexpr const char* kIndexHint = "restore the file";
constexpr std::uint32_t kVersion = 4;

/// Reads numbers as they lie in the file; false at its end.
class Reader {
 public:
  explicit Reader(std::istream& file) : file_(file) {
    file_.seekg(0, std::ios::end);
    size_ = static_cast<std::uint64_t>(std::max<std::streamoff>(0, file_.tellg()));
    file_.seekg(0);
  }
  template <typename T>
  bool read(T& value) {
    if (left() < sizeof(T)) return false;
    file_.read(reinterpret_cast<char*>(&value), sizeof(T));
    at_ += sizeof(T);
    return static_cast<bool>(file_);
  }
  bool skip(std::uint64_t bytes) {
    if (bytes > left()) return false;
    at_ += bytes;
    file_.seekg(static_cast<std::streamoff>(at_));
    return static_cast<bool>(file_);
  }
  std::uint64_t at() const { return at_; }
  std::uint64_t left() const { return size_ - at_; }

 private:
  std::istream& file_;
  std::uint64_t at_ = 0, size_ = 0;
};

using FileMatrix = std::array<float, 16>;

Eigen::Matrix4d matrix_of(const FileMatrix& rows) {
  return Eigen::Map<const Eigen::Matrix<float, 4, 4, Eigen::RowMajor>>(rows.data()).cast<double>();
}

/// "cut short" for the head, whose parts are all needed.
void require(bool there, const std::string& name) {
  if (!there) throw Error(name, "ends within its head", kIndexHint);
}

void read_calibration(Reader& reader, const std::string& name, ScanNetCalibration& calibration) {
  for (Eigen::Matrix4d* matrix : {&calibration.colour_intrinsic, &calibration.colour_extrinsic,
                                  &calibration.depth_intrinsic, &calibration.depth_extrinsic}) {
    FileMatrix rows;
    require(reader.read(rows), name);
    *matrix = matrix_of(rows);
  }
}

cv::Size read_size(Reader& reader, const std::string& name) {
  constexpr std::uint32_t kMaxSide = 16384;
  std::uint32_t width = 0, height = 0;
  require(reader.read(width) && reader.read(height), name);
  if (width == 0 || height == 0 || width > kMaxSide || height > kMaxSide) {
    throw Error(name, fmt::format("says that its images have {} x {} pixels", width, height), kIndexHint);
  }
  return {static_cast<int>(width), static_cast<int>(height)};
}

void read_head(Reader& reader, const std::string& name, SensIndex& index) {
  std::uint32_t version = 0;
  std::uint64_t name_length = 0;
  require(reader.read(version), name);
  if (version != kVersion) {
    throw Error(name, fmt::format("is no .sens file of version {} (but of {})", kVersion, version),
                "give a recording of ScanNet as it is published");
  }
  require(reader.read(name_length) && reader.skip(name_length), name);
  read_calibration(reader, name, index.calibration);
  std::int32_t colour = 0, depth = 0;
  require(reader.read(colour) && reader.read(depth), name);
  if (colour < 0 || colour > 2 || depth < 0 || depth > 1) {
    throw Error(name, fmt::format("has images of an unknown compression ({} and {})", colour, depth),
                "raw, PNG and JPEG colour, raw and zlib depth are read");
  }
  index.colour = static_cast<SensColour>(colour);
  index.depth = static_cast<SensDepth>(depth);
  index.calibration.colour_size = read_size(reader, name);
  index.calibration.depth_size = read_size(reader, name);
  float shift = 0;
  require(reader.read(shift) && reader.read(index.stated_frames), name);
  if (!(shift > 0 && shift < 1e6F))
    throw Error(name, fmt::format("has {} depth units per metre", shift), kIndexHint);
  index.calibration.depth_units_per_metre = shift;
}

/// The next frame; false where the file ends before it does.
bool read_frame(Reader& reader, SensFrame& frame) {
  FileMatrix pose;
  if (!(reader.read(pose) && reader.read(frame.colour_time) && reader.read(frame.depth_time) &&
        reader.read(frame.colour_bytes) && reader.read(frame.depth_bytes))) {
    return false;
  }
  std::array<double, 16> numbers{};
  std::copy(pose.begin(), pose.end(), numbers.begin());
  frame.world_from_cam = pose_of_matrix(numbers.data());
  frame.colour_at = reader.at();
  if (!reader.skip(frame.colour_bytes)) return false;
  frame.depth_at = reader.at();
  return reader.skip(frame.depth_bytes);
}

}  // namespace

SensIndex read_sens_index(std::istream& file, const std::string& name) {
  Reader reader(file);
  SensIndex index;
  read_head(reader, name, index);
  SensFrame frame;
  while (index.frames.size() < index.stated_frames && read_frame(reader, frame))
    index.frames.push_back(frame);
  if (index.frames.empty()) throw Error(name, "holds no frame", kIndexHint);
  return index;
}

}  // namespace stdc
