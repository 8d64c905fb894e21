#include "input/live/openni_images.hpp"

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>
#include <utility>

#include "core/error.hpp"

namespace stdc {
namespace {

void check_openni_size(const std::string& where, cv::Size has, cv::Size wanted) {
  if (wanted.empty() || has == wanted) return;
  throw Error(where,
              fmt::format("gives images of {} x {} pixels, but the camera has {} x {}", has.width, has.height,
                          wanted.width, wanted.height),
              "give the camera of these images with --camera");
}

class OpenNiImages : public PackedImages {
 public:
  OpenNiImages(std::string where, OpenNiImage colour, OpenNiImage depth)
      : where_(std::move(where)), colour_(std::move(colour)), depth_(std::move(depth)) {}

  cv::Mat colour(cv::Size size, ColourMode mode) const override {
    check_openni_size(where_, colour_.image.size(), size);
    if (colour_.image.channels() == 1) return colour_.image.clone();
    cv::Mat result;
    cv::cvtColor(colour_.image, result, mode == ColourMode::grey ? cv::COLOR_RGB2GRAY : cv::COLOR_RGB2BGR);
    return result;
  }
  cv::Mat depth(cv::Size size) const override {
    check_openni_size(where_, depth_.image.size(), size);
    return depth_.image.clone();
  }

 private:
  std::string where_;
  OpenNiImage colour_, depth_;
};

}  // namespace

std::shared_ptr<const PackedImages> pack_openni_images(std::string where, OpenNiImage colour,
                                                       OpenNiImage depth) {
  return std::make_shared<OpenNiImages>(std::move(where), std::move(colour), std::move(depth));
}

}  // namespace stdc
