#include "input/layouts/sens_file.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fstream>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "input/layouts/image_folder.hpp"
#include "input/layouts/layouts.hpp"
#include "input/layouts/number_file.hpp"
#include "input/layouts/pose_files.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "the file is little-endian");

constexpr const char* kHint = "restore the file";
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
  if (!there) throw Error(name, "ends within its head", kHint);
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
    throw Error(name, fmt::format("says that its images have {} x {} pixels", width, height), kHint);
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
    throw Error(name, fmt::format("has {} depth units per metre", shift), kHint);
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

std::vector<std::uint8_t> read_bytes(const fs::path& path, std::uint64_t at, std::uint64_t count,
                                     const std::string& where) {
  constexpr std::uint64_t kMaxImage = std::uint64_t{1} << 28U;
  if (count > kMaxImage) throw Error(where, fmt::format("is an image of {} bytes", count), kHint);
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(at));
  std::vector<std::uint8_t> bytes(count);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count));
  if (!file) throw Error(where, "cannot be read", kHint);
  return bytes;
}

/// The two images of a frame, in the file.
class SensImages final : public PackedImages {
 public:
  SensImages(fs::path path, std::string where, const SensIndex& index, const SensFrame& frame)
      : path_(std::move(path)),
        where_(std::move(where)),
        frame_(frame),
        colour_kind_(index.colour),
        depth_kind_(index.depth),
        colour_size_(index.calibration.colour_size),
        depth_size_(index.calibration.depth_size) {}

  cv::Mat colour(cv::Size size, ColourMode mode) const override {
    const std::string where = where_ + " (colour)";
    check_size(colour_size_, size, where);
    auto bytes = read_bytes(path_, frame_.colour_at, frame_.colour_bytes, where);
    if (colour_kind_ != SensColour::raw) {
      const DecodedImage decoded = decode_colour(bytes, colour_size_, mode);
      if (!decoded.problem.empty()) throw Error(where, decoded.problem, kHint);
      return decoded.image;
    }
    if (bytes.size() != static_cast<std::size_t>(colour_size_.area()) * 3) {
      throw Error(where, fmt::format("has {} bytes", bytes.size()), kHint);
    }
    cv::Mat image;
    cv::cvtColor(cv::Mat(colour_size_, CV_8UC3, bytes.data()), image,
                 mode == ColourMode::grey ? cv::COLOR_RGB2GRAY : cv::COLOR_RGB2BGR);
    return image;
  }

  std::optional<std::vector<std::uint8_t>> colour_file() const override {
    if (colour_kind_ == SensColour::raw) return std::nullopt;
    return read_bytes(path_, frame_.colour_at, frame_.colour_bytes, where_ + " (colour)");
  }

  cv::Mat depth(cv::Size size) const override {
    const std::string where = where_ + " (depth)";
    check_size(depth_size_, size, where);
    const auto bytes = read_bytes(path_, frame_.depth_at, frame_.depth_bytes, where);
    cv::Mat image(depth_size_, CV_16UC1);
    const std::size_t wanted = image.total() * image.elemSize();
    std::size_t got = bytes.size();
    bool sound = true;
    if (depth_kind_ == SensDepth::raw) {
      if (got == wanted) std::copy(bytes.begin(), bytes.end(), image.data);
    } else {
      const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> inflate(
          libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
      sound =
          inflate != nullptr && libdeflate_zlib_decompress(inflate.get(), bytes.data(), bytes.size(),
                                                           image.data, wanted, &got) == LIBDEFLATE_SUCCESS;
    }
    if (!sound || got != wanted) throw Error(where, "is damaged", kHint);
    return image;
  }

 private:
  static void check_size(cv::Size is, cv::Size wanted, const std::string& where) {
    if (wanted.empty() || is == wanted) return;
    throw Error(where,
                fmt::format("is {} x {} pixels, but the camera has {} x {}", is.width, is.height,
                            wanted.width, wanted.height),
                "give the camera of these images");
  }

  fs::path path_;
  std::string where_;
  SensFrame frame_;
  SensColour colour_kind_;
  SensDepth depth_kind_;
  cv::Size colour_size_, depth_size_;
};

/// Microseconds, where the recording has them: many have zeros.
bool has_times(const SensIndex& index) {
  const auto later = [](const SensFrame& a, const SensFrame& b) { return a.colour_time >= b.colour_time; };
  return index.frames.size() > 1 &&
         std::adjacent_find(index.frames.begin(), index.frames.end(), later) == index.frames.end();
}

class SensSource final : public FrameSource {
 public:
  SensSource(const fs::path& path, SensIndex index, double rate)
      : path_(path),
        index_(std::move(index)),
        cameras_(scannet_cameras(index_.calibration, path.string())),
        has_times_(has_times(index_)),
        rate_(rate) {}

  std::optional<SourceFrame> next() override {
    if (at_ == index_.frames.size()) return std::nullopt;
    const SensFrame& stored = index_.frames[at_];
    SourceFrame frame;
    frame.timestamp = time(at_, stored.colour_time);
    frame.depth_timestamp = time(at_, stored.depth_time);
    frame.name = fmt::format("{:06d}", at_);
    frame.where = fmt::format("{} (frame {})", path_.string(), at_);
    frame.images = std::make_shared<SensImages>(path_, frame.where, index_, stored);
    ++at_;
    return frame;
  }
  void rewind() override { at_ = 0; }
  std::optional<int> frame_count() const override { return static_cast<int>(index_.frames.size()); }
  std::optional<std::vector<double>> frame_times() const override {
    std::vector<double> times;
    for (std::size_t i = 0; i < index_.frames.size(); ++i)
      times.push_back(time(i, index_.frames[i].colour_time));
    return times;
  }
  std::optional<RgbdCameras> cameras() const override { return cameras_; }
  std::optional<GroundTruth> ground_truth() const override {
    GroundTruth truth;
    for (std::size_t i = 0; i < index_.frames.size(); ++i) {
      add_row(truth, time(i, index_.frames[i].colour_time), index_.frames[i].world_from_cam);
    }
    return truth;
  }
  std::string kind() const override { return "sens"; }
  std::string where() const override { return path_.string(); }
  std::vector<StreamInfo> streams() const override {
    const int count = static_cast<int>(index_.frames.size());
    return {{"colour", "colour images", count},
            {"depth", "depth images, not registered", count},
            {"pose", "ground truth", count}};
  }
  std::vector<std::string> notes() const override {
    std::vector<std::string> notes;
    if (!has_times_) {
      notes.push_back(fmt::format("{}: has no times: frame n is taken to be at n / {:g} s (--rate)",
                                  path_.string(), rate_));
    }
    if (index_.stated_frames > index_.frames.size()) {
      notes.push_back(fmt::format("{}: ends too early: {} of {} frames are whole", path_.string(),
                                  index_.frames.size(), index_.stated_frames));
    }
    return notes;
  }

 private:
  double time(std::size_t frame, std::uint64_t stored) const {
    constexpr double kMicrosecond = 1e-6;
    return has_times_ ? static_cast<double>(stored) * kMicrosecond : static_cast<double>(frame) / rate_;
  }

  fs::path path_;
  SensIndex index_;
  RgbdCameras cameras_;
  bool has_times_;
  double rate_;
  std::size_t at_ = 0;
};

}  // namespace

SensIndex read_sens_index(std::istream& file, const std::string& name) {
  Reader reader(file);
  SensIndex index;
  read_head(reader, name, index);
  SensFrame frame;
  while (index.frames.size() < index.stated_frames && read_frame(reader, frame))
    index.frames.push_back(frame);
  if (index.frames.empty()) throw Error(name, "holds no frame", kHint);
  return index;
}

bool is_sens_file(const fs::path& path) { return is_file(path) && path.extension() == ".sens"; }

std::unique_ptr<FrameSource> open_sens_file(const fs::path& path, const SourceOptions& options) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(path.string(), "cannot be opened", kHint);
  return std::make_unique<SensSource>(path, read_sens_index(file, path.string()), rate_of(options, 30));
}

}  // namespace stdc
