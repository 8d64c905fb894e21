#include "viewer/pause_gate.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace stdc {
namespace {

constexpr std::chrono::milliseconds kMoment(5), kLong(10000);

TEST(PauseGate, HoldsUntilItIsToGoOn) {
  PauseGate gate;
  EXPECT_FALSE(gate.hold_after_frame());
  gate.pause();
  EXPECT_TRUE(gate.hold_after_frame());
  EXPECT_FALSE(gate.wait(kMoment));
  std::thread page([&gate] { gate.resume(); });
  EXPECT_TRUE(gate.wait(kLong));
  page.join();
  EXPECT_FALSE(gate.hold_after_frame());
}

TEST(PauseGate, AStepIsOneFrame) {
  PauseGate gate;
  gate.pause();
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(gate.hold_after_frame());
    gate.step();
    EXPECT_TRUE(gate.wait(kLong));
  }
  EXPECT_TRUE(gate.hold_after_frame());
  EXPECT_FALSE(gate.wait(kMoment));
}

TEST(PauseGate, AStepWhileAFrameIsUnderWayIsOneMore) {
  PauseGate gate;
  gate.pause();
  EXPECT_TRUE(gate.hold_after_frame());
  gate.step();
  EXPECT_TRUE(gate.wait(kLong));
  gate.step();  // while the frame is tracked
  EXPECT_FALSE(gate.hold_after_frame());
  EXPECT_TRUE(gate.hold_after_frame());
}

TEST(PauseGate, AStepOfARunThatGoesOnHoldsIt) {
  PauseGate gate;
  gate.step();
  EXPECT_TRUE(gate.hold_after_frame());
}

}  // namespace
}  // namespace stdc
