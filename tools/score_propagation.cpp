// How well masks are carried to later frames: score_propagation SEQUENCE... prints, for sequences with
// ground-truth masks (as `stdc-slam render` writes them), the intersection over union with the true mask, of
// the mask of n frames before as it is, carried, and carried and refined by depth; for n = 0 `carried` stands
// for settle_by_depth(). With --pictures DIR it also writes overlays: green where both are, red what is too
// much, blue what is missing.
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/images/image_codec.hpp"
#include "input/layouts/tum_sequence.hpp"
#include "segmentation/mask_file_segmenter.hpp"
#include "segmentation/propagation/mask_propagator.hpp"
#include "segmentation/propagation/mask_settling.hpp"
#include "segmentation/srm/refinement.hpp"

namespace stdc {
namespace {

constexpr int kMax = 6, kEvery = 5, kPictureEvery = 45;

struct Frame {
  cv::Mat colour, grey, depth, mask;
  Pose world_from_cam;
};

struct Tally {
  std::vector<double> overlaps;
  double kept = 0, spilled = 0;  // shares of the truth that is found, and of what is found that is wrong

  void add(const cv::Mat& mask, const cv::Mat& truth) {
    const double both = cv::countNonZero(mask & truth), all = cv::countNonZero(mask | truth);
    overlaps.push_back(all > 0 ? both / all : 1);
    kept += both / std::max(cv::countNonZero(truth), 1);
    spilled += 1 - both / std::max(cv::countNonZero(mask), 1);
  }
  std::string text() {
    std::sort(overlaps.begin(), overlaps.end());
    double sum = 0;
    for (const double overlap : overlaps) sum += overlap;
    const auto n = static_cast<double>(overlaps.size());
    return fmt::format("{:5.1f} ({:4.1f}; {:4.1f} {:4.1f})", 100 * sum / n,
                       100 * overlaps[overlaps.size() / 20], 100 * kept / n, 100 * spilled / n);
  }
};

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double middle_of(std::vector<double>& values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

std::vector<Frame> load(const std::filesystem::path& folder, Camera& camera) {
  const TumSequence sequence(folder);
  camera = find_camera(sequence, {});
  MaskFileSegmenter masks(folder / "mask");
  const Trajectory poses = sequence.ground_truth().poses;
  std::vector<Frame> frames;
  for (const SequenceFrame& listed : sequence.frames()) {
    Frame& frame = frames.emplace_back();
    const RgbdImage image = load_frame(listed, camera);
    frame.colour = image.colour;
    cv::cvtColor(image.colour, frame.grey, cv::COLOR_BGR2GRAY);
    frame.depth = image.depth;
    frame.mask = masks.segment({image.colour, listed.timestamp, 0});
    const auto pose = std::min_element(poses.begin(), poses.end(), [&](const auto& a, const auto& b) {
      return std::abs(a.timestamp - listed.timestamp) < std::abs(b.timestamp - listed.timestamp);
    });
    frame.world_from_cam = pose->world_from_cam;
  }
  return frames;
}

void write_picture(const std::filesystem::path& path, const Frame& frame, const cv::Mat& mask) {
  cv::Mat picture = frame.colour / 2;
  picture.setTo(cv::Scalar(0, 120, 0), mask & frame.mask);
  picture.setTo(cv::Scalar(0, 0, 230), mask & ~frame.mask);
  picture.setTo(cv::Scalar(230, 80, 0), ~mask & frame.mask);
  cv::addWeighted(picture, 0.6, frame.colour, 0.4, 0, picture);
  const auto bytes = encode_png(picture);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

void score(const std::filesystem::path& folder, const std::filesystem::path& pictures) {
  Camera camera;
  const std::vector<Frame> frames = load(folder, camera);
  Tally stale[kMax + 1], stale_refined[kMax + 1], carried[kMax + 1], refined[kMax + 1];
  std::vector<double> adding, showing, late;
  int starts = 0;
  const int last = static_cast<int>(frames.size()) - kMax - 1;
  for (int start = 0; start <= last; start += kEvery, ++starts) {
    MaskPropagator propagator(camera);
    const auto& first = frames[static_cast<std::size_t>(start)];
    propagator.add_frame(start, first.grey, first.depth);
    propagator.set_mask(start, first.mask);
    const cv::Mat settled = settle_by_depth(first.mask, first.depth, camera.depth_units_per_metre);
    stale[0].add(first.mask, first.mask);
    stale_refined[0].add(refine(first.mask, first.depth, camera.depth_units_per_metre), first.mask);
    carried[0].add(settled, first.mask);
    refined[0].add(refine(settled, first.depth, camera.depth_units_per_metre), first.mask);
    for (int n = 1; n <= kMax; ++n) {
      const Frame &before = frames[static_cast<std::size_t>(start + n - 1)],
                  &now = frames[static_cast<std::size_t>(start) + static_cast<std::size_t>(n)];
      const double t0 = thread_seconds();
      propagator.add_frame(start + n, now.grey, now.depth,
                           now.world_from_cam.inverse() * before.world_from_cam);
      const double t1 = thread_seconds();
      const cv::Mat mask = propagator.mask();
      const double t2 = thread_seconds();
      adding.push_back(t1 - t0);
      showing.push_back(t2 - t1);
      const cv::Mat complete = refine(mask, now.depth, camera.depth_units_per_metre);
      stale[n].add(first.mask, now.mask);
      stale_refined[n].add(refine(first.mask, now.depth, camera.depth_units_per_metre), now.mask);
      carried[n].add(mask, now.mask);
      refined[n].add(complete, now.mask);
      if (!pictures.empty() && start % kPictureEvery == 0 && n % 3 == 0) {
        const std::string name = fmt::format("{}_{:03d}_{}", folder.filename().string(), start, n);
        write_picture(pictures / (name + "_carried.png"), now, mask);
        write_picture(pictures / (name + "_refined.png"), now, complete);
      }
    }
    const double t0 = thread_seconds();
    propagator.set_mask(start, first.mask);
    late.push_back(thread_seconds() - t0);
  }
  fmt::print("{}: {} masks, mean IoU % (worst twentieth; found %, wrong %)\n", folder.string(), starts);
  fmt::print(
      "  n        as it was           as it was, refined            carried              carried, refined\n");
  for (int n = 0; n <= kMax; ++n) {
    fmt::print("  {} {} {} {} {}\n", n, stale[n].text(), stale_refined[n].text(), carried[n].text(),
               refined[n].text());
  }
  fmt::print(
      "  CPU ms, half of the times below: {:.2f} to add a frame, {:.2f} to show the mask, {:.2f} to set it "
      "{} frames late\n",
      1e3 * middle_of(adding), 1e3 * middle_of(showing), 1e3 * middle_of(late), kMax);
}

}  // namespace
}  // namespace stdc

int main(int argc, char** argv) {
  try {
    std::filesystem::path pictures;
    for (int i = 1; i < argc; ++i) {
      if (std::string(argv[i]) == "--pictures" && i + 1 < argc) {
        pictures = argv[++i];
        std::filesystem::create_directories(pictures);
      } else {
        stdc::score(argv[i], pictures);
      }
    }
  } catch (const stdc::Error& error) {
    fmt::print(stderr, "score_propagation: {}\n", error.what());
    return 1;
  }
  return 0;
}
