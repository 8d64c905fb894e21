#include "run/run_outputs.hpp"

#include "run/dense/run_dense.hpp"
#include "run/masks/mask_check.hpp"
#include "run/run_checks.hpp"

namespace stdc::app {
namespace {

std::optional<InpaintedFolder> inpainted_folder(const RunOptions& options, const SequenceInput& input) {
  if (!options.inpaint) return std::nullopt;
  return std::optional<InpaintedFolder>(std::in_place, *options.inpaint, input);
}

OutputFolder output_folder(const RunOptions& options, const std::optional<InpaintedFolder>& inpainted) {
  if (inpainted) check_apart(options, *inpainted);
  return OutputFolder(options.output);
}

}  // namespace

RunOutputs::RunOutputs(const RunOptions& options, const Settings& settings, const SequenceInput& input)
    : inpainted(inpainted_folder(options, input)), folder(output_folder(options, inpainted)) {
  check_place_for_map(options);
  dense = dense_output(options.dense);
  if (options.debug_images) pictures.emplace(*options.debug_images, options.debug_every, settings.features);
  if (options.save_masks) masks.emplace(*options.save_masks);
  if (options.true_masks) {
    auto truth = masks_of_input(*options.true_masks, input);
    mask_scoring.emplace(truth ? std::move(*truth) : list_masks(*options.true_masks));
  }
}

std::vector<FrameObserver*> RunOutputs::observers() {
  std::vector<FrameObserver*> all;
  if (pictures) all.push_back(&*pictures);
  if (masks) all.push_back(&*masks);
  if (mask_scoring) all.push_back(&*mask_scoring);
  if (inpainted) all.push_back(&mask_record);
  if (samples) all.push_back(&*samples);
  return all;
}

void RunOutputs::commit() {
  if (pictures) pictures->commit();
  if (masks) masks->commit();
  if (inpainted) inpainted->commit();
  if (dense) dense->commit();
  folder.commit();
}

}  // namespace stdc::app
