#include "report/evo/evo_result.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "report/evo/zip_archive.hpp"

namespace stdc::app {
namespace {

TrajectoryScores some_scores() {
  TrajectoryScores scores;
  scores.pairs = 3;
  scores.ate = {0.02, 0.018, 0.015, 0.03};
  return scores;
}

TEST(ZipArchive, GivesBackWhatWasPutIn) {
  const std::vector<std::pair<std::string, std::string>> files{
      {"a.txt", "hello"}, {"empty", ""}, {"b/c", std::string(1000, '\0')}};
  const std::string archive = make_zip(files);
  EXPECT_EQ(archive, make_zip(files));
  const auto back = read_zip(archive, "a.zip");
  ASSERT_EQ(back.size(), 3U);
  for (const auto& [name, content] : files) EXPECT_EQ(back.at(name), content);
}

TEST(ZipArchive, ReadsWhatZipDeflates) {
  // As Python's zipfile writes it.
  constexpr unsigned char kArchive[] = {
      0x50, 0x4b, 0x03, 0x04, 0x14, 0x00, 0x00, 0x00, 0x08, 0x00, 0x00, 0x00, 0x21, 0x00, 0x25, 0x8a,
      0x5b, 0xc9, 0x06, 0x00, 0x00, 0x00, 0x28, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x61, 0x4b,
      0x4c, 0x24, 0x0e, 0x00, 0x00, 0x50, 0x4b, 0x01, 0x02, 0x14, 0x03, 0x14, 0x00, 0x00, 0x00, 0x08,
      0x00, 0x00, 0x00, 0x21, 0x00, 0x25, 0x8a, 0x5b, 0xc9, 0x06, 0x00, 0x00, 0x00, 0x28, 0x00, 0x00,
      0x00, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x80, 0x01, 0x00,
      0x00, 0x00, 0x00, 0x61, 0x50, 0x4b, 0x05, 0x06, 0x00, 0x00, 0x00, 0x00, 0x01, 0x00, 0x01, 0x00,
      0x2f, 0x00, 0x00, 0x00, 0x25, 0x00, 0x00, 0x00, 0x00, 0x00};
  const std::string archive(reinterpret_cast<const char*>(kArchive), sizeof kArchive);
  EXPECT_EQ(read_zip(archive, "a.zip").at("a"), std::string(40, 'a'));
}

TEST(ZipArchive, RefusesWhatIsDamaged) {
  const std::string archive = make_zip({{"a.txt", std::string(300, 'x')}, {"b.txt", "hello"}});
  EXPECT_THROW(read_zip("", "a.zip"), Error);
  EXPECT_THROW(read_zip("PK", "a.zip"), Error);
  EXPECT_THROW(read_zip(archive, "a.zip", 100), Error) << "too large";
  for (std::size_t length = 0; length < archive.size(); ++length) {
    EXPECT_THROW(read_zip(archive.substr(0, length), "a.zip"), Error) << length;
  }
  // Whatever a byte is changed to, nothing worse happens than an Error.
  for (std::size_t i = 0; i < archive.size(); ++i) {
    for (const char c : {'\0', '\xff', '\x7f'}) {
      std::string odd = archive;
      odd[i] = c;
      try {
        read_zip(odd, "a.zip");
      } catch (const Error&) {
      }
    }
  }
}

TEST(EvoResult, IsReadBack) {
  const std::string archive =
      evo_result(some_scores(), {{1, 0.01}, {1.5, 0.02}, {2.5, 0.06}}, "truth.txt", "estimate.txt");
  const auto files = read_zip(archive, "r.zip");
  for (const char* const name :
       {"info.json", "stats.json", "error_array.npy", "timestamps.npy", "seconds_from_start.npy"}) {
    EXPECT_TRUE(files.contains(name)) << name;
  }
  EXPECT_EQ(files.at("error_array.npy").size(), 128U + 24U) << "numbers start at a multiple of 64";
  const nlohmann::ordered_json run = evo_run(archive, "r.zip");
  EXPECT_EQ(run["label"], "estimate.txt");
  EXPECT_EQ(run["summary"]["scores"]["ate_m"]["rmse"], 0.02);
  EXPECT_EQ(run["summary"]["scores"]["pairs"], 3);
  EXPECT_EQ(run["summary"]["scores"]["off_by_5_cm"], 1);
  EXPECT_EQ(run["frames"]["time"], nlohmann::ordered_json({0, 0.5, 1.5}));
  EXPECT_EQ(run["frames"]["error_mm"], nlohmann::ordered_json({10, 20, 60}));
}

TEST(EvoResult, RefusesWhatIsNone) {
  EXPECT_THROW(evo_run(make_zip({{"a", "b"}}), "r.zip"), Error);
  EXPECT_THROW(evo_run(make_zip({{"info.json", R"x({"label": "RPE (m)"})x"}, {"stats.json", "{}"}}), "r.zip"),
               Error);
  EXPECT_THROW(evo_run(make_zip({{"info.json", R"x({"label": "APE (m)"})x"},
                                 {"stats.json", "{}"},
                                 {"error_array.npy", "text"}}),
                       "r.zip"),
               Error);
}

}  // namespace
}  // namespace stdc::app
