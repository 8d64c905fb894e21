#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "segmentation/network/network_weights.hpp"
#include "segmentation/network/safetensors.hpp"

namespace stdc::test {

/// A weights file that is put together in memory: random weights of any width for tests and benchmarks.
class RandomWeights {
 public:
  using Shape = std::vector<std::int64_t>;
  struct Widths {
    std::array<int, 2> stem{32, 64};
    std::array<int, 3> stages{256, 512, 1024};
    int context = 128, fusion = 256, squeezed = 64, head = 64, classes = 2;
  };

  explicit RandomWeights(bool stdc2 = false) : RandomWeights(stdc2, Widths{}) {}
  RandomWeights(bool stdc2, const Widths& widths);

  /// The bytes of the file.
  std::string bytes() const;
  static SafetensorsFile file(const std::string& bytes);
  NetworkWeights read() const;

  struct Values {
    Shape shape;
    std::vector<float> values;
  };
  std::map<std::string, std::string> metadata;
  std::map<std::string, Values> tensors;

 private:
  void add(const std::string& name, const Shape& shape, double low, double high);
  /// Weights that keep the variance of what passes through them and a ReLU.
  void add_plain(const std::string& name, int outputs, int inputs, int kernel);
  void add_normalised(const std::string& name, int outputs, int inputs, int kernel);
  void add_layers(const std::array<int, 3>& modules, const Widths& widths);

  Random random_{7};
  std::map<std::string, std::array<double, 2>> ranges_;  ///< of the inputs, by layer
};

}  // namespace stdc::test
