#pragma once

#include <array>
#include <utility>

#include "core/setting.hpp"
#include "segmentation/network/network_precision.hpp"

namespace stdc {

template <>
struct EnumNames<NetworkPrecision> {
  static constexpr std::array values{std::pair{NetworkPrecision::automatic, "automatic"},
                                     std::pair{NetworkPrecision::fp32, "fp32"},
                                     std::pair{NetworkPrecision::int8, "int8"}};
};

/// Settings of the segmentation network.
struct NetworkSettings {
  STDC_SETTING(NetworkPrecision, precision, NetworkPrecision::automatic,
               "Arithmetic of the network; automatic: int8 if the weights are calibrated");
  STDC_SETTING(int, threads, 1, "count", 1, 64,
               "Threads of inference; above 1 OMP_WAIT_POLICY=PASSIVE must be set");
  STDC_SETTING(int, input_width, 0, "px", 0, 4096,
               "Images are resized to this, a multiple of 32; 0: as the weights say");
  STDC_SETTING(int, input_height, 0, "px", 0, 4096,
               "Images are resized to this, a multiple of 32; 0: as the weights say");
};

}  // namespace stdc
