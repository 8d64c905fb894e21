#include "input/recordings/containers/db3_recording.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "input/recordings/containers/decompression.hpp"
#include "input/recordings/topic_table.hpp"

namespace stdc {
namespace {

constexpr const char* kDatabaseHint = "give a recording made by 'ros2 bag record'";

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
};
struct FinalizeStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, CloseDatabase>;
using Statement = std::unique_ptr<sqlite3_stmt, FinalizeStatement>;

/// A name of a file for SQLite that asks for no locks and writes nothing.
std::string read_only_uri(const std::filesystem::path& path, bool immutable) {
  std::string uri = "file:";
  for (const char c : std::filesystem::absolute(path).string()) {
    if (c == '?' || c == '#' || c == '%') {
      uri += fmt::format("%{:02x}", static_cast<unsigned>(c));
    } else {
      uri += c;
    }
  }
  return uri + (immutable ? "?mode=ro&immutable=1" : "?mode=ro");
}

std::string text_of(sqlite3_stmt* statement, int column) {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement, column));
  return text == nullptr ? "" : text;
}

class Db3Recording : public Recording {
 public:
  Db3Recording(const std::filesystem::path& path, std::string where) : where_(std::move(where)) {
    open(path);
    read_topics();
    first_ = single_number("SELECT MIN(timestamp) FROM messages");
    last_ = single_number("SELECT MAX(timestamp) FROM messages");
    has_time_index_ =
        !cut_off_ && single_number(
                         "SELECT COUNT(*) FROM sqlite_master WHERE type='index' AND tbl_name='messages' "
                         "AND sql LIKE '%(timestamp%'")
                             .value_or(0) > 0;
  }

  std::string where() const override { return where_; }
  std::string format() const override { return "db3"; }
  const std::vector<RecordedTopic>& topics() const override { return table_.topics(); }
  std::optional<LogTime> first_time() const override { return first_; }
  std::optional<LogTime> last_time() const override { return last_; }
  std::vector<std::string> faults() const override { return faults_; }

  void start(std::span<const int> topics, LogTime from, LogTime until) override {
    statement_.reset();
    if (topics.empty()) return;
    chosen_.assign(table_.topics().size(), false);
    for (const int topic : topics) chosen_.at(static_cast<std::size_t>(topic)) = true;
    // Topics are passed over here, not by SQL: it would then sort rather than follow the index of times.
    statement_ =
        prepare(fmt::format("SELECT topic_id, timestamp, data FROM messages {} WHERE timestamp >= ?1 AND "
                            "timestamp <= ?2 ORDER BY {}",
                            has_time_index_ ? "" : "NOT INDEXED", has_time_index_ ? "timestamp" : "id"));
    if (!statement_) return;
    sqlite3_bind_int64(statement_.get(), 1, from);
    sqlite3_bind_int64(statement_.get(), 2, until);
  }

  std::optional<RecordedMessage> next() override {
    while (statement_) {
      const int result = sqlite3_step(statement_.get());
      if (result != SQLITE_ROW) {
        if (result != SQLITE_DONE && !cut_off_) {
          add_fault(fmt::format("is damaged ({}); it is read up to there", sqlite3_errmsg(database_.get())));
        }
        statement_.reset();
        break;
      }
      const int topic =
          table_.topic_of(static_cast<std::uint64_t>(sqlite3_column_int64(statement_.get(), 0)));
      if (topic < 0 || !chosen_[static_cast<std::size_t>(topic)]) continue;
      const LogTime time = sqlite3_column_int64(statement_.get(), 1);
      const auto* data = static_cast<const std::uint8_t*>(sqlite3_column_blob(statement_.get(), 2));
      const Bytes bytes(data, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), 2)));
      return RecordedMessage{topic, time, bytes};
    }
    return std::nullopt;
  }

 private:
  void add_fault(const std::string& text) {
    const std::string line = where_ + ": " + text;
    if (std::find(faults_.begin(), faults_.end(), line) == faults_.end()) faults_.push_back(line);
  }

  /// Opens the file as it is; then as if nobody else could change it, which a folder that cannot be written
  /// to or the log of a recorder that was killed may need; then as one that was cut off, which SQLite refuses
  /// at first.
  void open(const std::filesystem::path& path) {
    for (const bool cut_off : {false, true}) {
      for (const bool immutable : {false, true}) {
        if (!try_to_open(path, immutable, cut_off)) continue;
        cut_off_ = cut_off;
        if (cut_off) {
          add_fault("is cut off; it is read as far as it goes");
        } else if (immutable) {
          add_fault("has a log that cannot be played back here; what the log holds is left out");
        }
        return;
      }
    }
    throw Error(where_,
                fmt::format("is no recording of rosbag2 ({})",
                            database_ ? sqlite3_errmsg(database_.get()) : "no memory"),
                kDatabaseHint);
  }

  bool try_to_open(const std::filesystem::path& path, bool immutable, bool cut_off) {
    sqlite3* opened = nullptr;
    const int result = sqlite3_open_v2(read_only_uri(path, immutable).c_str(), &opened,
                                       SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX, nullptr);
    database_.reset(opened);
    if (result != SQLITE_OK) return false;
    sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, static_cast<int>(kMaxPiece));
    if (cut_off) sqlite3_exec(opened, "PRAGMA writable_schema=ON", nullptr, nullptr, nullptr);
    if (!prepare("SELECT id, name, type, serialization_format FROM topics LIMIT 1")) return false;
    const Statement messages = prepare("SELECT id, topic_id, timestamp, data FROM messages LIMIT 1");
    if (!messages) return false;
    const int step = sqlite3_step(messages.get());
    return step == SQLITE_ROW || step == SQLITE_DONE;
  }

  Statement prepare(const std::string& sql) {
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &statement, nullptr);
    return Statement(statement);
  }

  std::optional<std::int64_t> single_number(const std::string& sql) {
    const Statement statement = prepare(sql);
    if (!statement || sqlite3_step(statement.get()) != SQLITE_ROW) return std::nullopt;
    if (sqlite3_column_type(statement.get(), 0) == SQLITE_NULL) return std::nullopt;
    return sqlite3_column_int64(statement.get(), 0);
  }

  void read_topics() {
    const Statement statement = prepare("SELECT id, name, type, serialization_format FROM topics");
    while (statement && sqlite3_step(statement.get()) == SQLITE_ROW) {
      RecordedTopic topic;
      topic.name = text_of(statement.get(), 1);
      topic.type = plain_type_name(text_of(statement.get(), 2));
      if (text_of(statement.get(), 3) == "cdr") topic.serialisation = Serialisation::cdr;
      table_.add(static_cast<std::uint64_t>(sqlite3_column_int64(statement.get(), 0)), std::move(topic));
    }
    table_.settle();
  }

  std::string where_;
  Database database_;
  TopicTable table_;
  std::optional<LogTime> first_, last_;
  bool has_time_index_ = false, cut_off_ = false;
  std::vector<std::string> faults_;
  std::vector<bool> chosen_;
  Statement statement_;  ///< null: at the end
};

}  // namespace

bool is_sqlite(Bytes beginning) {
  constexpr std::string_view kMagic = "SQLite format 3";
  return beginning.size() >= kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), beginning.begin());
}

std::unique_ptr<Recording> open_db3_recording(const std::filesystem::path& path, const std::string& where) {
  return std::make_unique<Db3Recording>(path, where);
}

}  // namespace stdc
