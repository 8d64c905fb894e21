#include "segmentation/network/network_weights.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"

namespace stdc {

int ModuleWeights::outputs() const {
  int sum = 0;
  for (const ConvolutionWeights& block : blocks) sum += block.outputs;
  return sum;
}

bool NetworkWeights::calibrated() const {
  const auto known = [](const ConvolutionWeights& layer) { return layer.input_range.has_value(); };
  for (const auto& stage : stages) {
    for (const ModuleWeights& module : stage) {
      if (!std::all_of(module.blocks.begin(), module.blocks.end(), known)) return false;
    }
  }
  return known(stage2) && known(refinement4.convolution) && known(refinement5.convolution) && known(head4) &&
         known(head5) && known(fusion) && known(head);
}

void NetworkWeights::choose_dynamic(std::span<const std::string> names) {
  std::vector<bool> chosen(classes.size(), false);
  for (const std::string& name : names) {
    const auto found = std::find(classes.begin(), classes.end(), name);
    if (found == classes.end()) {
      throw Error(file, fmt::format("knows no class '{}'", name.substr(0, 80)),
                  fmt::format("choose from {}", fmt::join(classes, ", ")));
    }
    chosen[static_cast<std::size_t>(found - classes.begin())] = true;
  }
  const auto count = std::count(chosen.begin(), chosen.end(), true);
  if (count == 0 || count == static_cast<std::ptrdiff_t>(classes.size())) {
    throw Error(file, fmt::format("{} of its classes would be dynamic", count == 0 ? "none" : "all"),
                fmt::format("choose some of {}", fmt::join(classes, ", ")));
  }
  dynamic_classes = chosen;
}

void check_input_size(cv::Size size, const std::string& where) {
  constexpr int kStep = 32, kMax = 4096;
  const auto good = [](int side) { return side >= kStep && side <= kMax && side % kStep == 0; };
  if (good(size.width) && good(size.height)) return;
  throw Error(where, fmt::format("{}x{} is not a size that the network takes", size.width, size.height),
              "give multiples of 32 from 32 to 4096, for instance 512x384");
}

}  // namespace stdc
