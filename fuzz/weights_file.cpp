// Weights of the network. By the first byte of the input: 'H': the rest is the header of a file; 'M': the
// rest is "key=text" of the metadata of a file that is right otherwise; else: the input is the file.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "core/error.hpp"
#include "segmentation/network/test_random_weights.hpp"
#include "segmentation/network/weights_reader.hpp"

namespace {

constexpr std::size_t kDataBytes = 64;

/// A file that is right, taken apart, so that an input costs no more than reading does.
struct Parts {
  std::map<std::string, std::string> metadata;
  std::string entries, data;  ///< the header from its first tensor on; what follows the header
};

Parts take_apart() {
  const stdc::test::RandomWeights weights(false, {{2, 2}, {8, 8, 8}, 2, 2, 2, 2, 2});
  const std::string bytes = weights.bytes();
  std::uint64_t length = 0;
  std::memcpy(&length, bytes.data(), sizeof length);
  nlohmann::json header = nlohmann::json::parse(bytes.substr(sizeof length, length));
  header.erase("__metadata__");
  return {weights.metadata, header.dump().substr(1), bytes.substr(sizeof length + length)};
}

std::string with_length(const std::string& header) {
  const std::uint64_t length = header.size();
  return std::string(reinterpret_cast<const char*>(&length), sizeof length) + header;
}

std::string file_of(const std::string& input) {
  static const Parts valid = take_apart();
  if (!input.empty() && input[0] == 'H') return with_length(input.substr(1)) + std::string(kDataBytes, '\0');
  const std::size_t middle = input.find('=');
  if (!input.empty() && input[0] == 'M' && middle != std::string::npos) {
    auto metadata = valid.metadata;
    metadata[input.substr(1, middle - 1)] = input.substr(middle + 1);
    try {
      return with_length("{\"__metadata__\":" + nlohmann::json(metadata).dump() + "," + valid.entries) +
             valid.data;
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
    const stdc::SafetensorsFile file = stdc::test::RandomWeights::file(bytes);
    for (const auto& [name, entry] : file.tensors()) {
      if (size > 0 && data[0] == 'M') break;  // they are right, and many
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
