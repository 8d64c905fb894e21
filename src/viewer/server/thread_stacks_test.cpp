#include "viewer/server/thread_stacks.hpp"

#include <gtest/gtest.h>
#include <pthread.h>

#include <array>

namespace stdc {
namespace {

/// As much as OpenBLAS has, so that the tests of the server show what it means there.
thread_local std::array<volatile char, 61440> ballast;

TEST(ThreadStacks, AreLargeWhateverIsAskedFor) {
  ballast[0] = 1;
  have_large_thread_stacks();
  pthread_attr_t attributes;
  ASSERT_EQ(pthread_attr_init(&attributes), 0);
  ASSERT_EQ(pthread_attr_setstacksize(&attributes, 102400), 0);
  std::size_t size = 0;
  ASSERT_EQ(pthread_attr_getstacksize(&attributes, &size), 0);
  EXPECT_EQ(size, std::size_t{1} << 20U);
  ASSERT_EQ(pthread_attr_setstacksize(&attributes, std::size_t{1} << 22U), 0);
  ASSERT_EQ(pthread_attr_getstacksize(&attributes, &size), 0);
  EXPECT_EQ(size, std::size_t{1} << 22U);
  pthread_attr_destroy(&attributes);
}

}  // namespace
}  // namespace stdc
