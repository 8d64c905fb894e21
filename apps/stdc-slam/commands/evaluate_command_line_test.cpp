#include <cstdlib>
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

/// Runs a script in the test's folder with Python and NumPy, which evo reads and writes its files with.
bool run_python(const TestFolder& folder, const std::string& script) {
  folder.write("script.py", script);
  const std::string command = "cd '" + folder.path().string() +
                              "' && { python3 -c 'import numpy' 2>/dev/null && python3 script.py || " +
                              "/usr/bin/python3 script.py; }";  // Debian's, where another one comes first
  return std::system(command.c_str()) == 0;                     // NOLINT(cert-env33-c)
}

bool has_numpy(const TestFolder& folder) { return run_python(folder, "import numpy"); }

TEST_F(EvaluateCommandLine, NumPyReadsTheResultsAsEvoDoes) {
  if (!has_numpy(folder_)) GTEST_SKIP() << "python3-numpy is not installed";
  ASSERT_EQ(call("evaluate truth.txt estimate.txt --save-results r.zip").code, 0);
  EXPECT_TRUE(run_python(folder_, R"(
import io, json, zipfile
import numpy as np
archive = zipfile.ZipFile('r.zip')
assert archive.testzip() is None
info, stats = (json.loads(archive.read(name)) for name in ('info.json', 'stats.json'))
arrays = {name[:-4]: np.load(io.BytesIO(archive.read(name))) for name in archive.namelist() if name.endswith('.npy')}
assert info['label'] == 'APE (m)' and info['ref_name'] == 'truth.txt' and info['est_name'] == 'estimate.txt'
error = arrays['error_array']
assert error.dtype == np.float64 and error.shape == (60,)
expected = {'rmse': np.sqrt(np.mean(error ** 2)), 'mean': error.mean(), 'median': np.median(error), 'std': error.std(),
            'min': error.min(), 'max': error.max(), 'sse': np.sum(error ** 2)}
assert set(stats) == set(expected), stats
for name, value in expected.items():
    assert abs(stats[name] - value) < 1e-9, (name, stats[name], value)
assert np.allclose(arrays['timestamps'], 100 + 0.1 * np.arange(60))
assert np.allclose(arrays['seconds_from_start'], 0.1 * np.arange(60))
align = arrays['alignment_transformation_sim3']
assert align.shape == (4, 4) and np.allclose(align, np.eye(4), atol=1e-2)
)"));
}

TEST_F(EvaluateCommandLine, ReportReadsResultsThatNumPyWrote) {
  if (!has_numpy(folder_)) GTEST_SKIP() << "python3-numpy is not installed";
  // The files of an archive of evo_ape --save_results, as the documentation of evo lists them.
  ASSERT_TRUE(run_python(folder_, R"(
import io, json, zipfile
import numpy as np
error = np.array([0.01, 0.02, 0.06])
stats = {'rmse': float(np.sqrt(np.mean(error ** 2))), 'mean': 0.03, 'median': 0.02, 'std': 0.0216, 'min': 0.01,
         'max': 0.06, 'sse': float(np.sum(error ** 2))}
info = {'title': 'APE', 'ref_name': 'gt.tum', 'est_name': 'theirs.tum', 'label': 'APE (m)'}
for name, compression, ending in (('now.zip', zipfile.ZIP_STORED, 'npy'), ('packed.zip', zipfile.ZIP_DEFLATED, 'npy'),
                                  ('earlier.zip', zipfile.ZIP_STORED, 'npz')):
    with zipfile.ZipFile(name, 'w', compression) as archive:
        archive.writestr('info.json', json.dumps(info))
        archive.writestr('stats.json', json.dumps(stats))
        for key, array in (('error_array', error), ('timestamps', np.array([1.0, 1.5, 2.5])),
                           ('alignment_transformation_sim3', np.eye(4))):
            buffer = io.BytesIO()
            np.save(buffer, array)
            archive.writestr(f'{key}.{ending}', buffer.getvalue())
        archive.writestr('gt.tum', '1.0 0 0 0 0 0 0 1\n')
)"));
  const Outcome outcome = call("report now.zip packed.zip earlier.zip --output r.html");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string page = content(folder_ / "r.html");
  EXPECT_TRUE(contains(page, "3 runs side by side"));
  EXPECT_TRUE(contains(page, "earlier"));
  EXPECT_TRUE(contains(page, "0.03696845")) << "the error of all three";
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
