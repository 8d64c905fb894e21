#include <nlohmann/json.hpp>

#include "commands/test_command_line.hpp"
#include "report/report_page.hpp"

namespace stdc::app {
namespace {

using Json = nlohmann::ordered_json;

class ReportCommandLine : public CommandLine {
 protected:
  Json page(const std::string& file) const { return report_document(content(folder_ / file), file); }
};

/// The page without what is measured: times, memory, and the command, which names the output.
Json unmeasured(Json document) {
  document.erase("commands");
  for (Json& group : document["groups"]) {
    for (Json& run : group["runs"]) {
      for (const char* const name :
           {"start_up_seconds", "processing_seconds", "frames_per_second", "cpu_seconds", "peak_memory_mb",
            "stage_milliseconds", "mapping", "loop_closing", "segmentation", "motion"}) {
        run["summary"].erase(name);
      }
      for (const char* const name : {"total_ms", "mask_wait_ms", "lag_ms"}) run["frames"].erase(name);
      run["histograms"].erase("total_ms");
      run["quantiles"].erase("total_ms");
      run.erase("warnings");
    }
  }
  return document;
}

TEST_F(ReportCommandLine, RunWritesAPage) {
  make_sequence();
  const Outcome outcome = call("run s --output o");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "report: o/report.html"));
  EXPECT_LT(fs::file_size(folder_ / "o/report.html"), 3'000'000U);
  const Json document = page("o/report.html");
  EXPECT_EQ(document["title"], "s");
  EXPECT_TRUE(contains(document["commands"][0], "run s --output o"));
  EXPECT_TRUE(contains(document["commands"][1], "evaluate s/groundtruth.txt o/trajectory.txt"));
  const Json& run = document["groups"][0]["runs"][0];
  EXPECT_EQ(run["frames"]["time"].size(), 12U);
  EXPECT_EQ(run["frames"]["error_mm"].size(), 12U);
  EXPECT_EQ(run["frames"]["inliers"].size(), 12U);
  EXPECT_EQ(run["trajectory"]["x"].size(), 12U);
  EXPECT_EQ(run["truth"]["x"].size(), 12U);
  EXPECT_GE(run["keyframes"]["x"].size(), 1U);
  EXPECT_GT(run["landmarks"]["x"].size(), 20U);
  EXPECT_EQ(run["summary"]["frames"]["ok"], 12);
  EXPECT_NEAR(run["period_ms"], 33.33, 0.01);
  EXPECT_GE(run["images"].size(), 4U);
  EXPECT_TRUE(contains(run["images"][0]["uri"], "data:image/jpeg;base64,/9j/"));
}

TEST_F(ReportCommandLine, ThePageIsTheSameButForTimes) {
  make_sequence();
  ASSERT_EQ(call("run s --output o --quiet").code, 0);
  ASSERT_EQ(call("run s --output o2 --quiet").code, 0);
  ASSERT_EQ(call("run s --output o3 --quiet --no-report").code, 0);
  EXPECT_EQ(unmeasured(page("o/report.html")), unmeasured(page("o2/report.html")));
  EXPECT_FALSE(fs::exists(folder_ / "o3/report.html"));
  EXPECT_EQ(content(folder_ / "o/trajectory.txt"), content(folder_ / "o3/trajectory.txt"));
  EXPECT_EQ(content(folder_ / "o/keyframes.txt"), content(folder_ / "o3/keyframes.txt"));
}

TEST_F(ReportCommandLine, TakesNamesThatAreNoText) {
  make_sequence();
  const std::string name = "</script>'\"<b>\xff";
  fs::create_directory(folder_ / "<");  // the slash in the name
  fs::rename(folder_ / "s", folder_ / name);
  const Outcome outcome = call("run \"$(printf '</script>'\\''\"<b>\\377')\" --output \"it's\" --quiet");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string html = content(folder_ / "it's/report.html");
  const Json document = report_document(html, "r");
  EXPECT_EQ(document["title"], "script>'\"<b>\xef\xbf\xbd");
  EXPECT_TRUE(contains(document["commands"][0], R"x($'</script>\'"<b>\xff')x"));
  EXPECT_TRUE(contains(document["commands"][0], R"x('it'\''s')x"));
  EXPECT_FALSE(contains(html, "<b>"));
  EXPECT_EQ(Json::parse(content(folder_ / "it's/summary.json"))["sequence"], document["title"]);
}

TEST_F(ReportCommandLine, WarnsOfTheDepthScaleAsInfoDoes) {
  make_sequence();
  std::string camera = content(folder_ / "s/camera.yaml");
  const std::string key = "depth_units_per_metre: ";
  const std::size_t at = camera.find(key) + key.size();
  camera.replace(at, camera.find('\n', at) - at, "100");
  folder_.write("s/camera.yaml", camera);
  ASSERT_EQ(call("run s --output o --quiet").code % 3, 0);
  const Json run = page("o/report.html")["groups"][0]["runs"][0];
  EXPECT_TRUE(contains(run["warnings"].dump(), "is depth_units_per_metre 100 where the device writes 5000?"));
  EXPECT_TRUE(contains(call("info s").out, "is depth_units_per_metre 100 where the device writes 5000?"));
}

TEST_F(ReportCommandLine, PutsRunsSideBySide) {
  make_sequence();
  ASSERT_EQ(call("run s --output a --quiet").code, 0);
  ASSERT_EQ(call("run s --output b --quiet --set features.keypoints=500").code, 0);
  ASSERT_EQ(
      call("evaluate s/groundtruth.txt a/trajectory.txt --save-results e.zip --report e.html --plot e.svg")
          .code,
      0);
  const Outcome outcome = call("report a b/report.html e.html e.zip --output all.html");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json runs = page("all.html")["groups"][0]["runs"];
  ASSERT_EQ(runs.size(), 4U);
  EXPECT_EQ(runs[0]["label"], "a");
  EXPECT_EQ(runs[1]["label"], "b");
  EXPECT_EQ(runs[2]["label"], "e");
  EXPECT_EQ(runs[3]["label"], "e (2)");
  EXPECT_EQ(runs[0]["frames"]["error_mm"], runs[2]["frames"]["error_mm"]);
  EXPECT_EQ(runs[3]["summary"]["scores"]["ate_m"], runs[2]["summary"]["scores"]["ate_m"]);
  ASSERT_EQ(call("report all.html a -o again.html").code, 0) << "a page of several runs is one too";
  EXPECT_EQ(page("again.html")["groups"][0]["runs"].size(), 5U);
}

TEST_F(ReportCommandLine, RefusesWhatIsNoRun) {
  make_sequence();
  ASSERT_EQ(call("run s --output a --quiet --no-report").code, 0);
  expect_refusal("report a", "a/report.html");
  expect_refusal("report nowhere", "nowhere");
  expect_refusal("report s/rgb.txt", "is no report");
  expect_refusal("report", "RUNS");
  folder_.write("damaged.html",
                std::string("<script type=\"application/json\" id=\"report-data\">{\"groups\":</script>"));
  expect_refusal("report damaged.html", "damaged");
  folder_.write(
      "odd.html",
      std::string("<script type=\"application/json\" "
                  "id=\"report-data\">{\"format\":1,\"groups\":[{\"runs\":[{\"name\":[]}]}]}</script>"));
  expect_refusal("report odd.html odd.html", "holds what this program does not write");
  folder_.write("deep.html",
                "<script type=\"application/json\" id=\"report-data\">{\"format\":1,\"groups\":" +
                    std::string(1'000'000, '[') + std::string(1'000'000, ']') + "}</script>");
  expect_refusal("report deep.html", "damaged");
  folder_.write(
      "image.html",
      std::string("<script type=\"application/json\" id=\"report-data\">{\"format\":1,\"groups\":[{\"runs\":"
                  "[{\"name\":\"a\",\"images\":[{\"frame\":\"x\"}]}]}]}</script>"));
  expect_refusal("report image.html image.html", "holds what this program does not write");
  folder_.write("odd.zip", std::string("PK\x03\x04 and nothing more"));
  expect_refusal("report odd.zip", "is no ZIP archive");
  EXPECT_FALSE(fs::exists(folder_ / "comparison.html"));
}

TEST_F(ReportCommandLine, AblationWritesAPage) {
  make_sequence();
  const Outcome outcome = call(fmt::format("ablation s --output a --quiet --weights {}", STDC_TEST_WEIGHTS));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json document = page("a/report.html");
  EXPECT_EQ(document["tables"].size(), 2U);
  EXPECT_EQ(document["tables"][0]["rows"][0][0], "s");
  EXPECT_EQ(document["groups"][0]["runs"].size(), 5U);
  EXPECT_EQ(document["groups"][0]["runs"][4]["label"], "OS3+Q");
}

}  // namespace
}  // namespace stdc::app
