#include "composed_sequence.hpp"

#include <fmt/format.h>

#include <fstream>
#include <opencv2/core.hpp>

#include "core/error.hpp"
#include "core/images/image_codec.hpp"
#include "input/camera_file.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

void write_bytes(const fs::path& path, const char* data, std::size_t size) {
  std::ofstream file(path, std::ios::binary);
  file.write(data, static_cast<std::streamsize>(size));
  file.close();
  if (!file)
    throw Error(path.string(), "cannot be written", "check the folder's permissions and the free space");
}

void write_png(const fs::path& path, const cv::Mat& image) {
  const std::vector<std::uint8_t> bytes = encode_png(image, PngEffort::fast);
  write_bytes(path, reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

}  // namespace

ComposedSequence::ComposedSequence(const TumSequence& recorded, const Camera& camera, const fs::path& output)
    : recorded_(recorded), camera_(camera), output_(fs::absolute(output).lexically_normal()) {
  if (!output_.has_filename()) output_ = output_.parent_path();
  if (fs::exists(output_))
    throw Error(output_.string(), "is there already", "remove it or choose another folder");
  partial_ = output_.parent_path() / fmt::format(".{}.partial", output_.filename().string());
  fs::remove_all(partial_);
  for (const char* part : {"rgb", "depth", "mask"}) fs::create_directories(partial_ / part);
  names_.resize(recorded.frames().size());
}

ComposedSequence::~ComposedSequence() {
  std::error_code ignored;
  fs::remove_all(partial_, ignored);
}

double ComposedSequence::paste(int index, const simulation::Passage& passage,
                               const simulation::MoverPaster& paster, std::uint64_t seed) {
  const SequenceFrame& frame = recorded_.frames()[index];
  const RgbdImage image = load_frame(frame, camera_);
  if (image.colour.channels() != 3)
    throw Error(frame.colour.string(), "is grey", "movers are pasted into colour images only");
  const auto mover = passage.mover(index);
  const simulation::PastedFrame pasted =
      paster.paste(image, passage.room_from_cam(index), *mover, seed * 1000003ULL + index);
  const int count = cv::countNonZero(pasted.mask);
  if (count == 0) {
    keep(index);
    return 0;
  }
  const std::string name = frame.colour.stem().string() + ".png",
                    depth = frame.depth.stem().string() + ".png";
  write_png(partial_ / "rgb" / name, pasted.image.colour);
  write_png(partial_ / "depth" / depth, pasted.image.depth);
  write_png(partial_ / "mask" / name, pasted.mask);
  names_[index] = {"rgb/" + name, "depth/" + depth};
  return static_cast<double>(count) / static_cast<double>(pasted.mask.total());
}

void ComposedSequence::keep(int index) {
  const SequenceFrame& frame = recorded_.frames()[index];
  fs::copy_file(frame.colour, partial_ / "rgb" / frame.colour.filename());
  fs::copy_file(frame.depth, partial_ / "depth" / frame.depth.filename());
  write_png(partial_ / "mask" / (frame.colour.stem().string() + ".png"),
            cv::Mat::zeros(camera_.height, camera_.width, CV_8UC1));
  names_[index] = {"rgb/" + frame.colour.filename().string(), "depth/" + frame.depth.filename().string()};
}

void ComposedSequence::finish() {
  std::string colour = "# color images\n# timestamp filename\n",
              depth = "# depth maps\n# timestamp filename\n";
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const SequenceFrame& frame = recorded_.frames()[i];
    colour += fmt::format("{:.6f} {}\n", frame.timestamp, names_[i].first);
    depth += fmt::format("{:.6f} {}\n", frame.depth_timestamp, names_[i].second);
  }
  write_bytes(partial_ / "rgb.txt", colour.data(), colour.size());
  write_bytes(partial_ / "depth.txt", depth.data(), depth.size());
  const std::string yaml = "# Lengths in pixels.\n" + format_camera(camera_);
  write_bytes(partial_ / "camera.yaml", yaml.data(), yaml.size());
  if (recorded_.has_ground_truth())
    fs::copy_file(recorded_.folder() / "groundtruth.txt", partial_ / "groundtruth.txt");
  fs::rename(partial_, output_);
}

}  // namespace stdc
