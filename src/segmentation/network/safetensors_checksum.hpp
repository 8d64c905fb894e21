#pragma once

#include <cstdint>
#include <istream>
#include <string>

namespace stdc {

/// Checks a safetensors file that carries the metadata entry "crc32": eight hexadecimal digits, the CRC-32
/// (IEEE 802.3) of the whole file with zeros in place of these digits. The training package writes it; files
/// of other programs have none, and pass.
/// @returns false if the header carries none
/// @param stream  at any place, and left at any place
/// @param header  the JSON text that begins after the eight bytes of its length
/// Throws Error if a bit of the file is not as it was written.
bool check_safetensors_checksum(std::istream& stream, std::string header, const std::string& name);

}  // namespace stdc
