#include "dense/fusion/field_windows.hpp"

#include <algorithm>
#include <optional>

#include "dense/fusion/view_batches.hpp"
#include "dense/parallel.hpp"

namespace stdc {
namespace {

/// What a view may reach, without its pixels: tells which windows it need not be decoded for.
using ViewReach = std::optional<ViewSamples>;

struct FieldWindow {
  BlockRange held;  ///< voxels that are in memory
  BlockRange made;  ///< the last of them, which were not before
  BlockRange used;  ///< whose neighbours are all there now
};

/// Windows of about equal size, so that none is larger than need be.
std::vector<FieldWindow> plan_windows(const BlockIndex& blocks, std::size_t window_blocks) {
  const std::size_t count = blocks.size();
  const std::size_t windows =
      std::max<std::size_t>(1, (count + window_blocks / 2) / std::max<std::size_t>(1, window_blocks));
  const std::size_t enough = (count + windows - 1) / windows;
  std::vector<FieldWindow> planned;
  // The last layers that began before `made` and before `used` ends: a layer can be used when the next is
  // there, and is still looked at when the next is used.
  std::size_t kept = 0, unused = 0;
  for (std::size_t made = 0; made < count;) {
    FieldWindow window{{kept, made}, {made, made}, {unused, unused}};
    while (made < count && made - window.made.first < enough) {
      kept = unused, unused = made;
      made = blocks.end_of_layer(made);
    }
    if (made == count) unused = count;
    window.held.last = window.made.last = made;
    window.used.last = unused;
    planned.push_back(window);
  }
  return planned;
}

/// The field with all blocks there are, and what each view may reach.
std::vector<ViewReach> mark_surfaces(const std::vector<PlacedView>& views, const Pinhole& pinhole,
                                     int min_frames, int threads, DistanceField& field) {
  std::vector<ViewReach> reaches(views.size());
  for_each_view(views, pinhole, min_frames, threads, make_depth_samples,
                [&](std::size_t first, const SampleBatch& samples) {
                  for (std::size_t i = 0; i < samples.size(); ++i) {
                    if (samples[i].empty()) continue;
                    field.mark(samples[i], views[first + i].cam_from_world.inverse());
                    reaches[first + i] = samples[i].reach();
                  }
                });
  field.sort_blocks();
  return reaches;
}

/// Those of the views that may tell something of the blocks.
std::vector<PlacedView> views_of(const std::vector<PlacedView>& views, const std::vector<ViewReach>& reaches,
                                 const DistanceField& field, BlockRange blocks) {
  std::vector<PlacedView> found;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (reaches[i] && field.concerns(*reaches[i], views[i].cam_from_world, blocks)) found.push_back(views[i]);
  }
  return found;
}

void integrate_views(const std::vector<PlacedView>& views, const Pinhole& pinhole, int min_frames,
                     int threads, BlockRange blocks, DistanceField& field) {
  for_each_view(views, pinhole, min_frames, threads, make_samples,
                [&](std::size_t first, const SampleBatch& samples) {
                  parallel_for(blocks.size(), threads, [&](std::size_t begin, std::size_t end) {
                    for (std::size_t i = 0; i < samples.size(); ++i) {
                      if (samples[i].empty()) continue;
                      field.integrate(samples[i], views[first + i].cam_from_world,
                                      {blocks.first + begin, blocks.first + end});
                    }
                  });
                });
}

}  // namespace

void for_each_window(const std::vector<PlacedView>& views, const Pinhole& pinhole,
                     const DenseSettings& settings, int threads, std::size_t window_blocks,
                     const std::function<void(const DistanceField& field, BlockRange blocks)>& use) {
  threads = threads_or_cores(threads);
  const auto voxel = static_cast<float>(settings.voxel);
  DistanceField field(voxel, voxel * static_cast<float>(settings.truncation));
  // First all surfaces, then all views: so those that saw through a place before a surface was noted there
  // are heard as well.
  const std::vector<ViewReach> reaches = mark_surfaces(views, pinhole, settings.min_frames, threads, field);
  const std::vector<FieldWindow> windows = plan_windows(field.blocks(), window_blocks);
  std::size_t largest = 0;
  for (const FieldWindow& window : windows) largest = std::max(largest, window.held.size());
  field.reserve(largest);
  for (const FieldWindow& window : windows) {
    field.hold(window.held);
    integrate_views(views_of(views, reaches, field, window.made), pinhole, settings.min_frames, threads,
                    window.made, field);
    use(field, window.used);
  }
}

}  // namespace stdc
