#include "segmentation/network/network_segmenter.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "segmentation/network/kernels/dnnl_convolution.hpp"
#include "segmentation/network/kernels/probability_map.hpp"
#include "segmentation/network/weights_reader.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

cv::Size chosen_size(const NetworkWeights& weights, const NetworkSettings& settings) {
  check_ranges("network", settings);
  const cv::Size size(settings.input_width > 0 ? settings.input_width : weights.input_size.width,
                      settings.input_height > 0 ? settings.input_height : weights.input_size.height);
  check_input_size(size, "network.input_width, network.input_height");
  return size;
}

}  // namespace

NetworkSegmenter::NetworkSegmenter(const fs::path& weights, const NetworkSettings& settings)
    : NetworkSegmenter(read_network_weights(weights), settings) {}

NetworkSegmenter::NetworkSegmenter(const NetworkWeights& weights, const NetworkSettings& settings)
    : architecture_(weights.architecture),
      has_checksum_(weights.has_checksum),
      classes_(weights.classes),
      dynamic_classes_(weights.dynamic_classes),
      probability_(weights.probability),
      network_(weights, chosen_size(weights, settings), settings.precision, settings.threads) {}

const cv::Mat& NetworkSegmenter::prepare(const cv::Mat& image) {
  const cv::Size size = network_.input_size();
  const cv::Mat* small = &image;
  if (image.size() != size) {
    // Bilinear sampling skips pixels when an image shrinks to less than half.
    const bool skips = image.cols > 2 * size.width || image.rows > 2 * size.height;
    cv::resize(image, resized_, size, 0, 0, skips ? cv::INTER_AREA : cv::INTER_LINEAR);
    small = &resized_;
  }
  if (small->channels() == 3) return *small;
  cv::cvtColor(*small, colour_, cv::COLOR_GRAY2BGR);
  return colour_;
}

cv::Mat NetworkSegmenter::segment(const SegmenterInput& input) { return segment_pixels(input, {}).mask; }

SegmentedPixels NetworkSegmenter::segment_pixels(const SegmenterInput& input,
                                                 const SegmentationRequest& request) {
  const cv::Mat& image = input.colour;
  if (image.empty() || (image.type() != CV_8UC3 && image.type() != CV_8UC1)) {
    throw Error(fmt::format("image of frame {}", input.frame), "is not an 8-bit colour or grey image",
                "give CV_8UC3 (BGR) or CV_8UC1");
  }
  const Logits logits = network_.run(prepare(image));
  if (!map_ || map_->size() != image.size()) {
    map_.emplace(cv::Size(logits.width, logits.height), image.size(), dynamic_classes_);
  }
  SegmentedPixels pixels{map_->draw(logits), {}, {}};
  constexpr std::size_t kMaxNumber = 256;
  if (request.classes && classes_.size() > kMaxNumber) {
    throw Error("class map", fmt::format("{} classes do not fit 8 bits", classes_.size()),
                "ask for masks only");
  }
  if (request.classes) pixels.classes = map_->draw_classes(logits);
  if (request.probability)
    pixels.probability = draw_probabilities(logits, image.size(), dynamic_classes_, probability_);
  return pixels;
}

std::string NetworkSegmenter::description() const {
  const cv::Size size = network_.input_size();
  return fmt::format("{}, {}, {}x{}, {}{}", architecture_, enum_name(network_.precision()), size.width,
                     size.height, DnnlEngine::description(),
                     has_checksum_ ? "" : "; weights without a checksum: damage would pass unnoticed");
}

namespace {

/// The file of the program or shared library that this code is in; empty if that cannot be found out.
fs::path own_file() {
  Dl_info info{};
  std::error_code fault;
  if (dladdr(reinterpret_cast<const void*>(&find_network_weights), &info) == 0 || info.dli_fname == nullptr)
    return {};
  const fs::path file = fs::canonical(info.dli_fname, fault);
  return fault ? fs::path() : file;
}

/// The places of a file of weights, first the one that counts: the folder that the user names, then what
/// belongs to the program and to the library, installed (share/stdc-slam/) or not (models/), wherever they
/// were moved, and last where `cmake --install` puts them: a program with the static library may be anywhere.
std::vector<fs::path> places_of_weights(const fs::path& name) {
  std::vector<fs::path> places;
  if (const char* folder = std::getenv("STDC_SLAM_MODELS"))
    places.push_back(fs::path(folder) / name.filename());
  std::error_code fault;
  for (const fs::path& file : {fs::read_symlink("/proc/self/exe", fault), own_file()}) {
    fs::path folder = file.parent_path();
    constexpr int kHighest = 4;
    for (int i = 0; i <= kHighest && folder.has_relative_path(); ++i, folder = folder.parent_path()) {
      for (fs::path place : {folder / "share/stdc-slam" / name, folder / name}) {
        if (std::find(places.begin(), places.end(), place) == places.end())
          places.push_back(std::move(place));
      }
    }
  }
  places.push_back(fs::path(STDC_INSTALLED_DATA) / name);
  return places;
}

}  // namespace

fs::path find_network_weights(const std::string& variant) {
  const fs::path name =
      fmt::format("models/stdc1-person-{}.safetensors", variant.empty() ? kDefaultWeights : variant);
  const std::vector<fs::path> places = places_of_weights(name);
  std::error_code fault;
  for (const fs::path& place : places) {
    if (fs::is_regular_file(place, fault)) return place;
  }
  std::vector<std::string> tried;
  for (const fs::path& place : places) tried.push_back(place.string());
  throw Error(name.filename().string(),
              fmt::format("the network's weights were not found (tried {})", fmt::join(tried, ", ")),
              "give their file with --weights, or their folder in STDC_SLAM_MODELS, or do without "
              "(--segmentation off)");
}

}  // namespace stdc
