#include "input/recordings/containers/db3_recording.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <array>
#include <filesystem>

#include "core/files/test_folder.hpp"

namespace stdc {
namespace {

using test::message_of;
using test::TestFolder;

/// A database as rosbag2 writes it.
class Database {
 public:
  explicit Database(const std::filesystem::path& path) { sqlite3_open(path.c_str(), &database_); }
  ~Database() { sqlite3_close(database_); }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void run(const std::string& sql) {
    ASSERT_EQ(sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(database_);
  }
  void make_tables(bool index = true) {
    run("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT,"
        " offered_qos_profiles TEXT)");
    run("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB)");
    if (index) run("CREATE INDEX timestamp_idx ON messages (timestamp ASC)");
    run("INSERT INTO topics VALUES(4, '/x', 'std_msgs/msg/String', 'cdr', '')");
  }
  void add(int time, int bytes = 100) {
    run("INSERT INTO messages(topic_id, timestamp, data) VALUES(4, " + std::to_string(time) + ", zeroblob(" +
        std::to_string(bytes) + "))");
  }

 private:
  sqlite3* database_ = nullptr;
};

struct ReadBack {
  std::vector<LogTime> times;
  std::vector<std::string> faults;
};

ReadBack read_back(const std::filesystem::path& path) {
  const auto recording = open_db3_recording(path, "x.db3");
  recording->start(std::array{0});
  ReadBack result;
  while (const auto message = recording->next()) result.times.push_back(message->log_time);
  result.faults = recording->faults();
  return result;
}

using Times = std::vector<LogTime>;

TEST(Db3Recording, MessagesComeInTheOrderOfTheirTimes) {
  const TestFolder folder;
  for (const bool index : {true, false}) {
    const auto path = folder / (index ? "a b#?%.db3" : "plain.db3");  // a name that means something in an URI
    {
      Database database(path);
      database.make_tables(index);
      database.run("BEGIN");
      for (const int time : {30, 10, 20}) database.add(time);
      database.run("COMMIT");
    }
    EXPECT_EQ(read_back(path).times, index ? (Times{10, 20, 30}) : (Times{30, 10, 20}));
  }
}

TEST(Db3Recording, TheLogOfARecorderThatWasKilledIsReadToo) {
  const TestFolder folder;
  Database database(folder / "run.db3");
  database.run("PRAGMA journal_mode=WAL");
  database.make_tables();
  database.run("BEGIN");
  for (int time = 0; time < 20; ++time) database.add(time);
  database.run("COMMIT");
  // As they lie on the disk while it is recording.
  std::filesystem::create_directory(folder / "killed");
  for (const char* name : {"run.db3", "run.db3-wal"}) {
    std::filesystem::copy(folder / name, folder / (std::string("killed/") + name));
  }
  EXPECT_EQ(read_back(folder / "killed/run.db3").times.size(), 20U);
}

TEST(Db3Recording, ADamagedFileIsReadAsFarAsItIsSound) {
  const TestFolder folder;
  {
    Database database(folder / "x.db3");
    database.make_tables();
    database.run("BEGIN");
    for (int time = 0; time < 100; ++time) database.add(time, 3000);
    database.run("COMMIT");
  }
  std::filesystem::resize_file(folder / "x.db3", std::filesystem::file_size(folder / "x.db3") / 2);
  const ReadBack read = read_back(folder / "x.db3");
  EXPECT_GT(read.times.size(), 30U);
  EXPECT_LT(read.times.size(), 100U);
  ASSERT_EQ(read.faults.size(), 1U);
  EXPECT_NE(read.faults[0].find("x.db3: is cut off; it is read"), std::string::npos) << read.faults[0];
}

TEST(Db3Recording, RefusesOtherDatabases) {
  const TestFolder folder;
  Database(folder / "x.db3").run("CREATE TABLE other(id INTEGER)");
  const std::string message = message_of([&] { open_db3_recording(folder / "x.db3", "x.db3"); });
  EXPECT_NE(message.find("x.db3: is no recording of rosbag2 (no such table: topics)"), std::string::npos)
      << message;
}

}  // namespace
}  // namespace stdc
