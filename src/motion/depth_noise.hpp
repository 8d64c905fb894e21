#pragma once

#include <array>
#include <deque>

namespace stdc {

/// How far surfaces at rest are from where earlier views saw them in this recording, as a share of the
/// tolerance that the worst sensor and map need: what moves slowly is found the sooner the better both are.
class DepthNoise {
 public:
  /// The comparisons of one frame.
  class Frame {
   public:
    /// A surface stands before the known one by this share of the tolerance; below 0 it does not.
    void add(float gap);
    /// The share that all but one in a thousand are below, of those within the tolerance.
    float level() const;

   private:
    static constexpr int kSteps = 16;
    int all_ = 0;
    std::array<int, kSteps + 1> counts_{};  ///< by gap, and last those beyond the tolerance
  };

  void add(double timestamp, const Frame& frame);
  /// To multiply the tolerance by, from 0.4 to 1; 1 until three seconds are known.
  float factor() const { return factor_; }

 private:
  struct Entry {
    double timestamp = 0;
    float level = 1;
  };
  std::deque<Entry> entries_;
  float factor_ = 1;
};

}  // namespace stdc
