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
  NetworkPrecision precision = NetworkPrecision::automatic;
  int threads = 1;
  int input_width = 0, input_height = 0;

  template <typename Self, typename Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Setting{"precision", "", "How the network computes; automatic: int8 if the weights are calibrated"},
          self.precision);
    visit(Setting{"threads", "count", "Threads of inference; above 1 OMP_WAIT_POLICY=PASSIVE must be set", 1,
                  64},
          self.threads);
    visit(Setting{"input_width", "px", "Images are resized to this, a multiple of 32; 0: as the weights say",
                  0, 4096},
          self.input_width);
    visit(Setting{"input_height", "px", "Images are resized to this, a multiple of 32; 0: as the weights say",
                  0, 4096},
          self.input_height);
  }
};

}  // namespace stdc
