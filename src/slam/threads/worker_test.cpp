#include "slam/threads/worker.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace stdc {
namespace {

TEST(Worker, DoesOneJobAfterAnother) {
  Worker worker;
  int sum = 0;
  for (int i = 1; i <= 100; ++i) {
    worker.start([&sum, i] { sum += i; });
    worker.wait();
  }
  EXPECT_EQ(sum, 5050);
}

TEST(Worker, WaitsForNothingAtOnce) {
  Worker worker;
  worker.wait();
}

TEST(Worker, HandsOnWhatTheJobThrew) {
  Worker worker;
  worker.start([] { throw std::runtime_error("no"); });
  EXPECT_THROW(worker.wait(), std::runtime_error);
  worker.wait();
}

TEST(Worker, FinishesItsJobBeforeItEnds) {
  bool done = false;
  {
    Worker worker;
    worker.start([&done] { done = true; });
  }
  EXPECT_TRUE(done);
}

}  // namespace
}  // namespace stdc
