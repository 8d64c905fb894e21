#include "report/report_page.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "report/merge_reports.hpp"

namespace stdc::app {
namespace {

using Json = nlohmann::ordered_json;

Json document_of(const std::string& name, int images = 0) {
  Json run = {{"name", name}, {"label", name}, {"every", 1}};
  run["frames"] = {{"time", Json::array()}, {"error_mm", Json::array()}, {"inliers", Json::array()}};
  for (int i = 0; i < 400; ++i) {
    run["frames"]["time"].push_back(i);
    run["frames"]["error_mm"].push_back(i % 10);
    run["frames"]["inliers"].push_back(100 + i % 10);
  }
  run["images"] = Json::array();
  for (int i = 0; i < images; ++i)
    run["images"].push_back({{"frame", 10 * i}, {"uri", std::string(50000, 'x')}});
  Json group = {{"title", name}, {"runs", Json::array({run})}};
  return {{"title", name}, {"groups", Json::array({group})}, {"commands", {"stdc-slam run " + name}}};
}

TEST(ReportPage, HoldsItsDocumentWhateverIsInIt) {
  const std::string nasty = "</script><script>alert(1)</script><!-- \" ' & {{data}} \\u003c";
  const Json document = document_of(nasty);
  const std::string page = report_page(document);
  EXPECT_EQ(page, report_page(document)) << "the same bytes each time";
  const Json back = report_document(page, "r.html");
  EXPECT_EQ(back["title"], nasty);
  EXPECT_EQ(back["groups"], document["groups"]);
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_EQ(page.find("alert(1)</script>"), std::string::npos);
  EXPECT_NE(page.find("<title>&lt;/script&gt;"), std::string::npos);
  EXPECT_EQ(page.find("{{"), page.find("{{data}}")) << "every place in the template is filled";
}

TEST(ReportPage, LoadsNothing) {
  const std::string page = report_page(document_of("a"));
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(page.find("<link"), std::string::npos);
  EXPECT_EQ(page.find("<script src"), std::string::npos);
  EXPECT_LT(page.size(), 1'400'000U);
}

TEST(ReportPage, BytesThatAreNoTextDoNotSpoilIt) {
  const std::string page = report_page(document_of("caf\xe9"));
  EXPECT_EQ(report_document(page, "r.html")["title"], "caf\xef\xbf\xbd");
}

TEST(ReportPage, RefusesWhatIsNone) {
  EXPECT_THROW(report_document("<html></html>", "r.html"), Error);
  std::string page = report_page(document_of("a"));
  EXPECT_THROW(report_document(page.substr(0, page.find("\"groups\"")), "r.html"), Error);
  page.replace(page.find("\"format\":1"), 10, "\"format\":7");
  EXPECT_THROW(report_document(page, "r.html"), Error);
}

TEST(MergeReports, NamesRunsApartAndKeepsWhatBelongsTogether) {
  Json other = document_of("s", 3);
  other["groups"][0]["runs"][0]["images"].erase(0);
  const Json groups = merge_reports({"a", "a", "b"}, {document_of("s", 3), other, document_of("s")});
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_EQ(groups[0]["title"], "s");
  const Json& runs = groups[0]["runs"];
  ASSERT_EQ(runs.size(), 3U);
  EXPECT_EQ(runs[0]["label"], "a");
  EXPECT_EQ(runs[1]["label"], "a (2)");
  EXPECT_EQ(runs[0]["images"].size(), 2U) << "nothing lies beside frame 0";
  EXPECT_EQ(runs[0]["command"], "stdc-slam run s");
}

TEST(MergeReports, APageIsBounded) {
  std::vector<std::string> names;
  for (int i = 0; i < 10; ++i) names.push_back(std::to_string(i));
  Json document = document_of("s");
  document["groups"] = merge_reports(names, std::vector<Json>(10, document_of("s", 10)));
  const std::string page = bounded_report_page(document);
  EXPECT_LT(page.size(), 3'000'000U);
  const Json runs = report_document(page, "r.html")["groups"][0]["runs"];
  EXPECT_GE(runs[0]["images"].size(), 1U);
  for (const Json& run : runs) EXPECT_EQ(run["images"].size(), runs[0]["images"].size());
  EXPECT_EQ(runs[0]["frames"]["time"].size(), 400U) << "pictures go first";
  const Json thin =
      report_document(bounded_report_page(document, report_page({{"title", "s"}}).size() + 20'000),
                      "r.html")["groups"][0]["runs"][0];
  EXPECT_LT(thin["frames"]["time"].size(), 400U);
  EXPECT_GT(thin["every"], 1);
  EXPECT_EQ(thin["frames"]["inliers"][0], 100) << "the fewest";
  EXPECT_GT(thin["frames"]["error_mm"][0], 0) << "the largest";
}

}  // namespace
}  // namespace stdc::app
