#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "viewer/messages/byte_writer.hpp"

namespace stdc {

/// What a message to the page is about. The page has the same list (apps/viewer/src/protocol.ts).
enum class ViewTopic : std::uint8_t { state = 1, frames = 2, image = 3, map = 4, mesh = 5, keyframe = 6 };

/// Of which only the latest counts, in the order in which they are sent: what is small and urgent first.
inline constexpr std::array kBoardTopics = {ViewTopic::state, ViewTopic::image, ViewTopic::map,
                                            ViewTopic::mesh};

/// A WebSocket message is a piece of a message: so a mesh of 20 MB does not hold up what is urgent.
/// Header: topic (u8), version of the protocol (u8), 0 (u16), revision (u32), size of the whole (u32),
/// offset of the piece (u32).
inline constexpr std::uint8_t kProtocolVersion = 2;
inline constexpr std::size_t kPieceHeader = 16, kMaxPiece = 256 * 1024;  // [bytes]

inline std::string make_piece(ViewTopic topic, std::uint32_t revision, std::string_view whole,
                              std::size_t offset) {
  ByteWriter piece;
  const std::string_view part = whole.substr(offset, kMaxPiece);
  piece.reserve(kPieceHeader + part.size());
  piece.put(static_cast<std::uint8_t>(topic));
  piece.put(kProtocolVersion);
  piece.put(std::uint16_t{0});
  piece.put(revision);
  piece.put(static_cast<std::uint32_t>(whole.size()));
  piece.put(static_cast<std::uint32_t>(offset));
  piece.put_bytes(part);
  return piece.take();
}

}  // namespace stdc
