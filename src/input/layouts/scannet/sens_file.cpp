#include "input/layouts/scannet/sens_file.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "input/layouts/image_folder.hpp"
#include "input/layouts/layouts.hpp"
#include "input/layouts/number_file.hpp"
#include "input/layouts/pose_files.hpp"
#include "input/layouts/scannet/sens_index.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSensHint = "restore the file";

std::vector<std::uint8_t> read_bytes(const fs::path& path, std::uint64_t at, std::uint64_t count,
                                     const std::string& where) {
  constexpr std::uint64_t kMaxImage = std::uint64_t{1} << 28U;
  if (count > kMaxImage) throw Error(where, fmt::format("is an image of {} bytes", count), kSensHint);
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(at));
  std::vector<std::uint8_t> bytes(count);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count));
  if (!file) throw Error(where, "cannot be read", kSensHint);
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
      if (!decoded.problem.empty()) throw Error(where, decoded.problem, kSensHint);
      return decoded.image;
    }
    if (bytes.size() != static_cast<std::size_t>(colour_size_.area()) * 3) {
      throw Error(where, fmt::format("has {} bytes", bytes.size()), kSensHint);
    }
    cv::Mat image;
    cv::cvtColor(cv::Mat(colour_size_, CV_8UC3, bytes.data()), image,
                 mode == ColourMode::grey ? cv::COLOR_RGB2GRAY : cv::COLOR_RGB2BGR);
    return image;
  }

  bool stores_brightness() const override { return colour_kind_ == SensColour::jpeg; }
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
    if (!sound || got != wanted) throw Error(where, "is damaged", kSensHint);
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

bool is_sens_file(const fs::path& path) { return is_file(path) && path.extension() == ".sens"; }

std::unique_ptr<FrameSource> open_sens_file(const fs::path& path, const SourceOptions& options) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(path.string(), "cannot be opened", kSensHint);
  return std::make_unique<SensSource>(path, read_sens_index(file, path.string()), rate_of(options, 30));
}

}  // namespace stdc
