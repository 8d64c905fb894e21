#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/images/image_codec.hpp"

namespace stdc {

/// No chunk or message of a recording may be larger, packed or not: recorders make chunks of 1 to 8 MB.
constexpr std::uint64_t kMaxPiece = std::uint64_t{256} << 20U;

/// Unpacks a piece of a recording. Memory is taken as the data comes, not for what its size claims.
/// @param method  "" or "none", "lz4" (LZ4 frames), "zstd", "bz2"
/// @param size    of the result, if it is known: another one is a problem
/// @param out     the result; with a problem what could be unpacked before it
/// @return        half a sentence on what is wrong, or ""
std::string decompress(std::string_view method, Bytes packed, std::optional<std::uint64_t> size,
                       std::vector<std::uint8_t>& out);

}  // namespace stdc
