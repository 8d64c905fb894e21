#include "masked_footage.hpp"

#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "core/files/text_file.hpp"
#include "core/images/image_codec.hpp"
#include "input/layouts/tum_sequence.hpp"
#include "simulation/sequence/rendered_sequence.hpp"

namespace stdc {
namespace {

cv::Mat grey_of(const cv::Mat& colour) {
  cv::Mat grey = colour;
  if (colour.channels() == 3) cv::cvtColor(colour, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

std::vector<MaskedFrame> rendered() {
  constexpr int kFirst = 120, kCount = 40;
  const simulation::RenderedSequence sequence(simulation::Preset::walking_static, {});
  std::vector<MaskedFrame> frames;
  for (int i = 0; i < kCount; ++i) {
    const simulation::RenderedFrame frame = sequence.render(kFirst + i);
    frames.push_back({grey_of(frame.image.colour), frame.image.depth, frame.mask});
  }
  return frames;
}

}  // namespace

std::vector<MaskedFrame> load_masked_footage() {
  constexpr std::size_t kMax = 300;
  const char* folder = std::getenv("STDC_MASKED_SEQUENCE");
  if (folder == nullptr) return rendered();
  const TumSequence sequence(folder);
  const Camera camera = find_camera(sequence, {});
  std::vector<MaskedFrame> frames;
  for (const SequenceFrame& listed : sequence.frames()) {
    if (frames.size() == kMax) break;
    const RgbdImage image = load_frame(listed, camera, ColourMode::grey);
    const std::string bytes =
        read_file(sequence.folder() / "mask" / listed.colour.filename(), "render it with stdc-slam");
    const Bytes span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    frames.push_back(
        {image.colour, image.depth, decode_png_colour(span, image.colour.size(), ColourMode::grey).image});
  }
  return frames;
}

}  // namespace stdc
