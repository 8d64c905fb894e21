#include "dense/mesh/face_lists.hpp"

#include <gtest/gtest.h>

namespace stdc {
namespace {

std::vector<std::uint32_t> faces_of(const FaceLists& lists, std::uint32_t vertex) {
  const FaceLists::List list = lists.of(vertex);
  return {list.begin(), list.end()};
}

using Faces = std::vector<std::uint32_t>;

TEST(FaceLists, AreInTheOrderOfTheFacesAndJoinedBehindEachOther) {
  FaceLists lists({{0, 1, 2}, {2, 1, 3}, {0, 2, 4}}, 6);
  EXPECT_EQ(faces_of(lists, 2), (Faces{0, 1, 2}));
  EXPECT_EQ(faces_of(lists, 1), (Faces{0, 1}));
  EXPECT_TRUE(lists.of(5).empty());
  lists.remove(2, 1);
  lists.remove(2, 1);
  EXPECT_EQ(faces_of(lists, 2), (Faces{0, 2}));
  lists.append(4, 1);
  EXPECT_EQ(faces_of(lists, 4), (Faces{2, 0, 1}));
  EXPECT_TRUE(lists.of(1).empty());
  lists.append(5, 4);
  EXPECT_EQ(faces_of(lists, 5), (Faces{2, 0, 1}));
  lists.remove(5, 2);
  EXPECT_EQ(faces_of(lists, 5), (Faces{0, 1}));
}

}  // namespace
}  // namespace stdc
