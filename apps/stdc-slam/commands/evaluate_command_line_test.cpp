#include <nlohmann/json.hpp>

#include "commands/test_command_line.hpp"
#include "input/trajectory.hpp"

namespace stdc::app {
namespace {

class EvaluateCommandLine : public CommandLine {
 protected:
  /// A path of 60 poses, and an estimate of it that is off by a millimetre here and there.
  EvaluateCommandLine() {
    std::string evo, kitti, estimated_kitti,
        euroc = "#timestamp [ns], p_x, p_y, p_z, q_w, q_x, q_y, q_z, v_x\n";
    Trajectory truth, estimate;
    for (int i = 0; i < 60; ++i) {
      const double x = 0.02 * i, y = 0.3 * std::sin(0.1 * i), off = i % 3 == 0 ? 0.001 : 0;
      truth.push_back({100 + 0.1 * i, Pose(Eigen::Quaterniond::Identity(), {x, y, 0})});
      estimate.push_back({100 + 0.1 * i, Pose(Eigen::Quaterniond::Identity(), {x, y, off})});
      // As NumPy's savetxt, which evo saves with, writes them.
      evo += fmt::format("{:.18e} {:.18e} {:.18e} {:.18e} {:.18e} {:.18e} {:.18e} {:.18e}\n", 100 + 0.1 * i,
                         x, y, off, 0.0, 0.0, 0.0, 1.0);
      kitti += fmt::format("1 0 0 {:.18e} 0 1 0 {:.18e} 0 0 1 0\n", x, y);
      estimated_kitti += fmt::format("1 0 0 {:.18e} 0 1 0 {:.18e} 0 0 1 {:.18e}\n", x, y, off);
      euroc += fmt::format("{},{},{},0,1,0,0,0,9\n", 100'000'000'000 + 100'000'000LL * i, x, y);
    }
    folder_.write("truth.txt", format_trajectory(truth));
    folder_.write("estimate.txt", format_trajectory(estimate));
    folder_.write("evo.tum", evo);
    folder_.write("truth.kitti", kitti);
    folder_.write("estimate.kitti", estimated_kitti);
    folder_.write("data.csv", euroc);
  }
};

TEST_F(EvaluateCommandLine, ReadsWhatEvoWrites) {
  const Outcome plain = call("evaluate truth.txt estimate.txt --json");
  ASSERT_EQ(plain.code, 0) << plain.err;
  const double rmse = nlohmann::json::parse(plain.out)["ate_m"]["rmse"];
  EXPECT_GT(rmse, 1e-4);
  for (const char* const files : {"truth.txt evo.tum", "truth.kitti estimate.kitti", "data.csv evo.tum"}) {
    const Outcome outcome = call(fmt::format("evaluate {} --json", files));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto scores = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(scores["pairs"], 60) << files;
    EXPECT_NEAR(scores["ate_m"]["rmse"], rmse, 1e-9) << files;
    EXPECT_NEAR(scores["rpe_second_translation_m"]["rmse"],
                nlohmann::json::parse(plain.out)["rpe_second_translation_m"]["rmse"], 1e-9)
        << files;
  }
}

TEST_F(EvaluateCommandLine, WritesDrawingPageAndResults) {
  const std::string options = " --plot p.svg --report r.html --save-results r.zip";
  ASSERT_EQ(call("evaluate truth.txt estimate.txt" + options).code, 0);
  const std::string svg = content(folder_ / "p.svg");
  EXPECT_TRUE(svg.starts_with("<svg xmlns"));
  EXPECT_TRUE(contains(svg, "estimate.txt: ATE"));
  const std::string zip = content(folder_ / "r.zip");
  EXPECT_TRUE(zip.starts_with("PK"));
  EXPECT_LT(fs::file_size(folder_ / "r.html"), 3'000'000U);
  ASSERT_EQ(call("evaluate truth.txt estimate.txt" + options).code, 0);
  EXPECT_EQ(content(folder_ / "p.svg"), svg) << "the same bytes";
  EXPECT_EQ(content(folder_ / "r.zip"), zip);
}

TEST_F(EvaluateCommandLine, RefusesWhatDoesNotBelongTogether) {
  expect_refusal("evaluate truth.txt estimate.kitti", "has no times");
  expect_refusal("evaluate truth.kitti estimate.txt", "has no times");
  folder_.write("short.kitti", std::string("1 0 0 0 0 1 0 0 0 0 1 0\n"));
  expect_refusal("evaluate truth.kitti short.kitti", "has 1 poses and truth.kitti has 60");
  folder_.write("odd.kitti", std::string("1 0 0 0 0 1 0 0 0 0 2 0\n"));
  expect_refusal("evaluate truth.kitti odd.kitti", "odd.kitti:1: its matrix is no rotation");
  folder_.write("cut.kitti", std::string("1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0\n"));
  expect_refusal("evaluate truth.kitti cut.kitti", "cut.kitti:2: has 3 values");
  expect_refusal("evaluate truth.txt estimate.txt --plot nowhere/p.svg", "nowhere/p.svg");
}

TEST_F(EvaluateCommandLine, WritesAllOrNothing) {
  expect_refusal("evaluate truth.txt estimate.txt --plot p.svg --report /dev/full/r.html", "r.html");
  EXPECT_FALSE(fs::exists(folder_ / "p.svg"));
}

}  // namespace
}  // namespace stdc::app
