#include "input/live/frame_queue.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace stdc {
namespace {

SourceFrame at(double time) {
  SourceFrame frame;
  frame.timestamp = time;
  return frame;
}

TEST(FrameQueue, DropsTheOldestAndCountsIt) {
  FrameQueue queue(2);
  for (int i = 0; i < 5; ++i) queue.push(at(i));
  EXPECT_EQ(queue.dropped(), 3);
  EXPECT_TRUE(queue.is_full());
  EXPECT_EQ(queue.pop()->timestamp, 3);
  EXPECT_EQ(queue.pop()->timestamp, 4);
}

TEST(FrameQueue, KeepsMoreUntilSomebodyIsReady) {
  FrameQueue queue(2, 5);
  for (int i = 0; i < 6; ++i) queue.push(at(i));
  EXPECT_EQ(queue.dropped(), 1);
  for (int i = 1; i < 6; ++i) EXPECT_EQ(queue.pop()->timestamp, i);
  for (int i = 0; i < 6; ++i) queue.push(at(i));
  EXPECT_EQ(queue.dropped(), 5);
}

TEST(FrameQueue, GivesWhatItHasAfterTheEnd) {
  FrameQueue queue(3);
  queue.push(at(1));
  queue.close();
  queue.push(at(2));
  EXPECT_EQ(queue.pop()->timestamp, 1);
  EXPECT_FALSE(queue.pop());
  EXPECT_EQ(queue.dropped(), 0);
}

TEST(FrameQueue, WakesWhoWaitsWhenItIsClosed) {
  FrameQueue queue(1);
  bool ended = false;
  std::thread waiting([&] { ended = !queue.pop(); });
  queue.close();
  waiting.join();
  EXPECT_TRUE(ended);
}

TEST(FrameQueue, HandsAllOverFromThreadToThread) {
  FrameQueue queue(1000);
  std::thread giving([&] {
    for (int i = 0; i < 500; ++i) queue.push(at(i));
    queue.close();
  });
  int next = 0;
  while (const auto frame = queue.pop()) EXPECT_EQ(frame->timestamp, next++);
  giving.join();
  EXPECT_EQ(next, 500);
}

}  // namespace
}  // namespace stdc
