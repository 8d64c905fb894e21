#include "dense/fusion/view_batches.hpp"

#include <algorithm>

#include "dense/fusion/view_codec.hpp"
#include "dense/parallel.hpp"

namespace stdc {

void for_each_view(const std::vector<PlacedView>& views, const Pinhole& pinhole, int min_frames, int threads,
                   void (*make)(const FusedDepth&, const Pinhole&, int, SampleScratch&, ViewSamples&),
                   const std::function<void(std::size_t first, const SampleBatch& samples)>& use) {
  constexpr std::size_t kAtATime = 4;  // so that a block is fetched once for all of them
  const cv::Size size(pinhole.width, pinhole.height);
  // Kept from batch to batch: to get, clear and give back 4 MB for each view takes as long as to decode it.
  SampleBatch samples;
  struct Worker {
    FusedDepth fused;
    SampleScratch scratch;
  };
  std::vector<Worker> workers(std::min(kAtATime, static_cast<std::size_t>(std::max(1, threads))));
  for (std::size_t first = 0; first < views.size(); first += kAtATime) {
    samples.resize(std::min(kAtATime, views.size() - first));
    parallel_for(workers.size(), threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t w = begin; w < end; ++w) {
        for (std::size_t i = w; i < samples.size(); i += workers.size()) {
          samples[i].clear();
          if (decode_depth(*views[first + i].view, size, workers[w].fused))
            make(workers[w].fused, pinhole, min_frames, workers[w].scratch, samples[i]);
        }
      }
    });
    use(first, samples);
  }
}

}  // namespace stdc
