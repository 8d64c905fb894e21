#include "dense/fusion/make_field.hpp"

#include <algorithm>

#include "dense/fusion/view_codec.hpp"
#include "dense/parallel.hpp"

namespace stdc {

void for_each_view(const std::vector<PlacedView>& views, const Pinhole& pinhole, int min_frames, int threads,
                   ViewSamples (*make)(const FusedDepth&, const Pinhole&, int),
                   const std::function<void(std::size_t first, const SampleBatch& samples)>& use) {
  constexpr std::size_t kAtATime = 8;  // so that a block is fetched once for all of them
  const cv::Size size(pinhole.width, pinhole.height);
  for (std::size_t first = 0; first < views.size(); first += kAtATime) {
    SampleBatch samples(std::min(kAtATime, views.size() - first));
    parallel_for(samples.size(), threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const FusedDepth fused = decode_depth(*views[first + i].view, size);
        if (!fused.depth.empty()) samples[i] = make(fused, pinhole, min_frames);
      }
    });
    use(first, samples);
  }
}

DistanceField make_field(const std::vector<PlacedView>& views, const Pinhole& pinhole,
                         const DenseSettings& settings, int threads) {
  threads = threads_or_cores(threads);
  const auto voxel = static_cast<float>(settings.voxel);
  DistanceField field(voxel, voxel * static_cast<float>(settings.truncation));
  // First all surfaces, then all views: so those that saw through a place before a surface was noted there
  // are heard as well.
  for_each_view(views, pinhole, settings.min_frames, threads, make_depth_samples,
                [&](std::size_t first, const SampleBatch& samples) {
                  for (std::size_t i = 0; i < samples.size(); ++i) {
                    if (samples[i]) field.mark(*samples[i], views[first + i].cam_from_world.inverse());
                  }
                });
  field.allocate();
  for_each_view(views, pinhole, settings.min_frames, threads, make_samples,
                [&](std::size_t first, const SampleBatch& samples) {
                  parallel_for(field.blocks().size(), threads, [&](std::size_t begin, std::size_t end) {
                    for (std::size_t i = 0; i < samples.size(); ++i) {
                      if (samples[i])
                        field.integrate(*samples[i], views[first + i].cam_from_world, begin, end);
                    }
                  });
                });
  return field;
}

}  // namespace stdc
