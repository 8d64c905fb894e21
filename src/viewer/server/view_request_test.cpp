#include "viewer/server/view_request.hpp"

#include <gtest/gtest.h>

namespace stdc {
namespace {

using Kind = ViewRequest::Kind;

TEST(ViewRequest, TakesWhatAPageSends) {
  EXPECT_EQ(parse_view_request("pause"), (ViewRequest{Kind::pause}));
  EXPECT_EQ(parse_view_request("resume"), (ViewRequest{Kind::resume}));
  EXPECT_EQ(parse_view_request("step"), (ViewRequest{Kind::step}));
  EXPECT_EQ(parse_view_request("want 0"), (ViewRequest{Kind::want, 0}));
  EXPECT_EQ(parse_view_request("want 31"), (ViewRequest{Kind::want, 31}));
  EXPECT_EQ(parse_view_request("keyframe 4294967295"), (ViewRequest{Kind::keyframe, 4294967295}));
}

TEST(ViewRequest, RefusesAllElse) {
  for (const char* text : {"", " ", "want", "want ", "want 32", "want -1", "want 1 ", "want 1x", "want  1",
                           "Pause", "pause ", "pause 1", "keyframe", "keyframe 4294967296", "keyframe 0x1",
                           "stop", "keyframe 00000000000000000000000000000000000000000000001"}) {
    EXPECT_FALSE(parse_view_request(text)) << text;
  }
  EXPECT_FALSE(parse_view_request(std::string_view("pause\0", 6)));
}

}  // namespace
}  // namespace stdc
