#include "segmentation/network/test_random_weights.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "segmentation/network/weights_reader.hpp"

namespace stdc::test {

RandomWeights::RandomWeights(bool stdc2, const Widths& widths) {
  metadata = {{"format", "stdc-weights-1"},     {"architecture", stdc2 ? "STDC2-Seg" : "STDC1-Seg"},
              {"dynamic_classes", R"(["c1"])"}, {"input_width", "512"},
              {"input_height", "384"},          {"mean", "[0.485, 0.456, 0.406]"},
              {"std", "[0.229, 0.224, 0.225]"}, {"licence", "none"}};
  nlohmann::json names = nlohmann::json::array();
  for (int i = 0; i < widths.classes; ++i) names.push_back(fmt::format("c{}", i));
  metadata["classes"] = names.dump();
  add_layers(stdc2 ? std::array{4, 5, 3} : std::array{2, 2, 2}, widths);
  metadata["activation_ranges"] = nlohmann::json(ranges_).dump();
}

std::string RandomWeights::bytes() const {
  nlohmann::json header;
  header["__metadata__"] = metadata;
  std::uint64_t end = 0;
  for (const auto& [name, tensor] : tensors) {
    const std::uint64_t begin = end;
    end += tensor.values.size() * sizeof(float);
    header[name] = {{"dtype", "F32"}, {"shape", tensor.shape}, {"data_offsets", {begin, end}}};
  }
  const std::string text = header.dump();
  const std::uint64_t length = text.size();
  std::string result(reinterpret_cast<const char*>(&length), sizeof length);
  result += text;
  for (const auto& [name, tensor] : tensors) {
    result.append(reinterpret_cast<const char*>(tensor.values.data()), tensor.values.size() * sizeof(float));
  }
  return result;
}

SafetensorsFile RandomWeights::file(const std::string& bytes) {
  return {std::make_unique<std::istringstream>(bytes), bytes.size(), "random weights"};
}

NetworkWeights RandomWeights::read() const { return read_network_weights(file(bytes())); }

void RandomWeights::add(const std::string& name, const Shape& shape, double low, double high) {
  Values& tensor = tensors[name];
  tensor.shape = shape;
  std::int64_t count = 1;
  for (const std::int64_t size : shape) count *= size;
  for (std::int64_t i = 0; i < count; ++i) {
    tensor.values.push_back(static_cast<float>(random_.uniform(low, high)));
  }
}

void RandomWeights::add_plain(const std::string& name, int outputs, int inputs, int kernel) {
  const double bound = std::sqrt(6.0 / (inputs * kernel * kernel));
  add(name + ".weight", {outputs, inputs, kernel, kernel}, -bound, bound);
  constexpr double kRange = 6;
  ranges_[name] = {0, kRange};
}

void RandomWeights::add_normalised(const std::string& name, int outputs, int inputs, int kernel) {
  add_plain(name + ".conv", outputs, inputs, kernel);
  add(name + ".bn.weight", {outputs}, 0.8, 1.2);
  add(name + ".bn.bias", {outputs}, -0.2, 0.2);
  add(name + ".bn.running_mean", {outputs}, -0.2, 0.2);
  add(name + ".bn.running_var", {outputs}, 0.8, 1.2);
}

void RandomWeights::add_layers(const std::array<int, 3>& modules, const Widths& widths) {
  add_normalised("backbone.stage1", widths.stem[0], 3, 3);
  add_normalised("backbone.stage2", widths.stem[1], widths.stem[0], 3);
  int channels = widths.stem[1];
  for (std::size_t stage = 0; stage < 3; ++stage) {
    for (int i = 0; i < modules[stage]; ++i) {
      const std::string name = fmt::format("backbone.stage{}.{}.blocks.", stage + 3, i);
      const int width = widths.stages[stage];
      add_normalised(name + "0", width / 2, channels, 1);
      add_normalised(name + "1", width / 4, width / 2, 3);
      add_normalised(name + "2", width / 8, width / 4, 3);
      add_normalised(name + "3", width / 8, width / 8, 3);
      channels = width;
    }
  }
  add_normalised("context.pool", widths.context, widths.stages[2], 1);
  for (const auto& [name, inputs] : {std::pair{"4", widths.stages[1]}, std::pair{"5", widths.stages[2]}}) {
    add_normalised(std::string("context.arm") + name + ".conv", widths.context, inputs, 3);
    add_normalised(std::string("context.arm") + name + ".attention", widths.context, widths.context, 1);
    add_normalised(std::string("context.head") + name, widths.context, widths.context, 3);
  }
  add_normalised("ffm.conv", widths.fusion, widths.stages[0] + widths.context, 1);
  add_plain("ffm.squeeze", widths.squeezed, widths.fusion, 1);
  add_plain("ffm.excite", widths.fusion, widths.squeezed, 1);
  add_normalised("head.conv", widths.head, widths.fusion, 3);
  add_plain("head.classify", widths.classes, widths.head, 1);
  add("head.classify.bias", {widths.classes}, -0.2, 0.2);
}

}  // namespace stdc::test
