#include "viewer/view_feed.hpp"

#include <gtest/gtest.h>

#include "viewer/messages/test_message.hpp"

namespace stdc {
namespace {

using test::number_at;

struct Piece {
  ViewTopic topic;
  std::uint32_t revision, total, offset;
  std::string bytes;
};

Piece read(const std::string& piece) {
  return {static_cast<ViewTopic>(piece[0]), number_at<std::uint32_t>(piece, 4),
          number_at<std::uint32_t>(piece, 8), number_at<std::uint32_t>(piece, 12),
          piece.substr(kPieceHeader)};
}

std::vector<Piece> all(ViewFeed& feed) {
  std::vector<Piece> pieces;
  while (const auto piece = feed.next_piece()) pieces.push_back(read(*piece));
  return pieces;
}

TEST(ViewFeed, OnlyTheLatestOfATopicIsSent) {
  ViewBoard board;
  ViewFeed feed(board);
  feed.want(kWantImage);
  for (int i = 0; i < 100; ++i) board.post(ViewTopic::image, std::to_string(i));
  const std::vector<Piece> pieces = all(feed);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].bytes, "99");
  EXPECT_EQ(pieces[0].revision, 100U);
  EXPECT_TRUE(feed.up_to_date());
  EXPECT_FALSE(feed.next_piece());
}

TEST(ViewFeed, WhatIsNotWantedIsNotSent) {
  ViewBoard board;
  ViewFeed feed(board);
  board.post(ViewTopic::image, "image");
  board.post(ViewTopic::map, "map");
  board.post(ViewTopic::mesh, "mesh");
  board.post(ViewTopic::state, "state");
  std::vector<Piece> pieces = all(feed);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].topic, ViewTopic::state);
  feed.want(kWantMap);
  pieces = all(feed);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].topic, ViewTopic::map);
}

TEST(ViewFeed, ALargeMessageGoesInPiecesAndDoesNotHoldUpWhatIsUrgent) {
  ViewBoard board;
  ViewFeed feed(board);
  feed.want(kWantMesh);
  const std::string mesh(3 * kMaxPiece + 7, 'm');
  board.post(ViewTopic::mesh, mesh);
  std::string arrived = read(*feed.next_piece()).bytes;
  board.post(ViewTopic::state, "state");
  board.post(ViewTopic::mesh, "newer");
  EXPECT_EQ(read(*feed.next_piece()).topic, ViewTopic::state);
  for (int i = 0; i < 3; ++i) {  // to its end, though there is a newer one
    const Piece piece = read(*feed.next_piece());
    EXPECT_EQ(piece.revision, 1U);
    EXPECT_EQ(piece.offset, arrived.size());
    EXPECT_EQ(piece.total, mesh.size());
    arrived += piece.bytes;
  }
  EXPECT_EQ(arrived, mesh);
  EXPECT_EQ(read(*feed.next_piece()).bytes, "newer");
  EXPECT_TRUE(feed.up_to_date());
}

TEST(ViewFeed, AllFramesAreSentOnceInBatches) {
  ViewBoard board;
  ViewFeed feed(board);
  constexpr std::uint32_t kCount = 10000;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    FrameRecord record;
    record.frame = i;
    board.add(record);
  }
  std::uint32_t next = 0;
  for (const Piece& piece : all(feed)) {
    EXPECT_LE(piece.bytes.size(), kMaxPiece);
    EXPECT_EQ(number_at<std::uint32_t>(piece.bytes, 0), next);
    const auto count = number_at<std::uint32_t>(piece.bytes, 4);
    EXPECT_EQ(piece.bytes.size(), 8 + count * kFrameRecordSize);
    EXPECT_EQ(number_at<std::uint32_t>(piece.bytes, 8 + 8), next);  // the frame's number
    next += count;
  }
  EXPECT_EQ(next, kCount);
}

TEST(ViewFeed, AKeyframesImageIsForThePageThatAsked) {
  ViewBoard board;
  ViewFeed asks(board), other(board);
  asks.give_keyframe(std::make_shared<const std::string>("first"));
  asks.give_keyframe(std::make_shared<const std::string>("second"));
  const std::vector<Piece> pieces = all(asks);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].bytes, "second");
  EXPECT_TRUE(all(other).empty());
}

}  // namespace
}  // namespace stdc
