#include "slam/make_segmenter.hpp"

#include <utility>

#include "segmentation/mask_file_segmenter.hpp"
#include "segmentation/network/weights_segmenter.hpp"
#include "segmentation/upright_segmenter.hpp"

namespace stdc {
namespace {

std::unique_ptr<Segmenter> upright(std::unique_ptr<Segmenter> network, int rotation) {
  if (rotation == 0) return network;
  return std::make_unique<UprightSegmenter>(std::move(network), orientation_of_rotation(rotation));
}

std::unique_ptr<Segmenter> make_source(const Settings& settings, const SegmenterFiles& files, int rotation) {
  switch (settings.segmentation.source) {
    case SegmentationSource::masks:
      if (files.found_masks) return std::make_unique<MaskFileSegmenter>(*files.found_masks);
      return std::make_unique<MaskFileSegmenter>(files.masks);
    case SegmentationSource::network:
      return upright(make_weights_segmenter(files.weights, settings.network, files.dynamic_classes),
                     rotation);
    case SegmentationSource::off:
      break;
  }
  return nullptr;
}

}  // namespace

std::unique_ptr<Segmenter> make_segmenter(const Settings& settings, const SegmenterFiles& files,
                                          int rotation) {
  std::unique_ptr<Segmenter> segmenter = make_source(settings, files, rotation);
  if (!segmenter || !settings.mask_degradation.any()) return segmenter;
  return std::make_unique<DegradedSegmenter>(std::move(segmenter), settings.mask_degradation);
}

}  // namespace stdc
