// Weights of the network. By the first byte of the input: 'H': the rest is the header of a file; 'M': the
// rest is "key=text" of the metadata of a file that is right otherwise; else: the input is the file.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "core/error.hpp"
#include "segmentation/random_weights.hpp"

namespace {

constexpr std::size_t kDataBytes = 64;

std::string file_of(const std::string& input) {
  static const stdc::testing::RandomWeights valid(false, {{2, 2}, {8, 8, 8}, 2, 2, 2, 2, 2});
  if (!input.empty() && input[0] == 'H') {
    const std::uint64_t length = input.size() - 1;
    return std::string(reinterpret_cast<const char*>(&length), sizeof length) + input.substr(1) +
           std::string(kDataBytes, '\0');
  }
  const std::size_t middle = input.find('=');
  if (!input.empty() && input[0] == 'M' && middle != std::string::npos) {
    stdc::testing::RandomWeights weights = valid;
    weights.metadata[input.substr(1, middle - 1)] = input.substr(middle + 1);
    try {
      return weights.bytes();
    } catch (const nlohmann::json::exception&) {  // not UTF-8
      return {};
    }
  }
  return input;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes = file_of(std::string(reinterpret_cast<const char*>(data), size));
  try {
    const stdc::SafetensorsFile file = stdc::testing::RandomWeights::file(bytes);
    for (const auto& [name, entry] : file.tensors()) {
      try {
        if (file.floats(name).size() * 2 > bytes.size()) std::abort();
      } catch (const stdc::Error&) {
      }
    }
    const stdc::NetworkWeights weights = stdc::read_network_weights(file);
    if (weights.classes.size() != static_cast<std::size_t>(weights.classify.outputs)) std::abort();
  } catch (const stdc::Error&) {
  }
  return 0;
}
