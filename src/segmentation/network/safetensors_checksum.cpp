#include "segmentation/network/safetensors_checksum.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include <vector>

#include "core/error.hpp"

namespace stdc {

bool check_safetensors_checksum(std::istream& stream, std::string header, const std::string& name) {
  constexpr std::string_view kKey = "\"crc32\":\"";
  constexpr std::size_t kDigits = 8, kChunk = std::size_t{1} << 20U;
  const std::size_t key = header.find(kKey);
  if (key == std::string::npos || header.size() < key + kKey.size() + kDigits) return false;
  const std::string written = header.substr(key + kKey.size(), kDigits);
  header.replace(key + kKey.size(), kDigits, kDigits, '0');
  const std::uint64_t length = header.size();
  std::uint32_t sum = libdeflate_crc32(0, &length, sizeof(length));
  sum = libdeflate_crc32(sum, header.data(), header.size());
  stream.clear();
  stream.seekg(static_cast<std::streamoff>(sizeof(length) + header.size()));
  std::vector<char> chunk(kChunk);
  while (stream.read(chunk.data(), static_cast<std::streamsize>(kChunk)) || stream.gcount() > 0)
    sum = libdeflate_crc32(sum, chunk.data(), static_cast<std::size_t>(stream.gcount()));
  stream.clear();
  if (fmt::format("{:08x}", sum) == written) return true;
  throw Error(name, "is damaged (its checksum is wrong)", "copy or download the file again");
}

}  // namespace stdc
