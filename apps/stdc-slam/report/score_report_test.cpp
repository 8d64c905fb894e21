#include "report/score_report.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace stdc::app {
namespace {

/// An ATE of 10 mm, and what is left of it with the best scale.
TrajectoryScores scores(double factor, double rest) {
  TrajectoryScores result;
  result.ate.rmse = 0.010;
  result.scale = {factor, rest};
  return result;
}

TEST(ScoreReport, TellsTheScaleInWords) {
  EXPECT_EQ(scale_text(scores(1 / 0.998, 0.0097)),
            "best scale: the estimate is 0.20 % too small; without that the ATE is 9.700 mm");
  EXPECT_EQ(scale_text(scores(1 / 1.03, 0.002)),
            "best scale: the estimate is 3.00 % too large; without that the ATE is 2.000 mm");
  const nlohmann::ordered_json json = scores_to_json(scores(0.97, 0.002));
  EXPECT_EQ(json["scale"]["factor"], 0.97);
  EXPECT_EQ(json["scale"]["ate_rmse_m"], 0.002);
}

TEST(ScoreReport, WarnsOfAScaleThatExplainsTheError) {
  EXPECT_EQ(scale_warning(scores(1 / 1.03, 0.002)),
            "The trajectory is 3.0 % too large, which makes the ATE 10.0 mm in place of 2.0: is "
            "depth_units_per_metre right? stdc-slam calibrate finds it.");
  EXPECT_EQ(scale_warning(scores(1 / 1.03, 0.009)), "");
  EXPECT_EQ(scale_warning(scores(1.002, 0.001)), "");
}

}  // namespace
}  // namespace stdc::app
