#include "core/io/bag/sqlite_bag.h"

#include <sqlite3.h>

#include <filesystem>
#include <map>
#include <memory>

#include "core/base/formatted.h"
#include "core/io/number_text.h"
#include "core/io/whole_file.h"

namespace odolab {

namespace {

constexpr std::string_view kSqliteMagic("SQLite format 3\0", 16);

struct Close {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, Close>;
using Statement = std::unique_ptr<sqlite3_stmt, Close>;

// The file's name as the URI by which SQLite opens it without writing anything beside it.
std::string uri_of(const std::string& path, bool with_log) {
  std::string uri = "file:";
  for (char c : std::filesystem::absolute(path).string()) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '/' ||
                       c == '.' || c == '_' || c == '-';
    uri += plain ? std::string(1, c) : formatted("%%%02X", static_cast<unsigned char>(c));
  }
  return uri + (with_log ? "?mode=ro" : "?mode=ro&immutable=1");
}

Database open_database(const std::string& path, bool with_log) {
  sqlite3* raw = nullptr;
  sqlite3_open_v2(uri_of(path, with_log).c_str(), &raw, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  Database database(raw);
  if (!raw) return database;
  // nothing that the file itself brings along may be carried out
  sqlite3_db_config(raw, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(raw, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_limit(raw, SQLITE_LIMIT_LENGTH, 1 << 30);
  sqlite3_busy_timeout(raw, 1000);
  return database;
}

Statement prepared(const Database& database, const char* sql) {
  sqlite3_stmt* raw = nullptr;
  sqlite3_prepare_v2(database.get(), sql, -1, &raw, nullptr);
  return Statement(raw);
}

std::string text_at(const Statement& row, int column) {
  const unsigned char* text = sqlite3_column_text(row.get(), column);
  return text ? std::string(reinterpret_cast<const char*>(text), sqlite3_column_bytes(row.get(), column)) : "";
}

// A view or a virtual table of that name would be a program; a bag has ordinary tables.
bool has_ordinary_tables(const Database& database) {
  const Statement query = prepared(database,
                                   "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND rootpage > 0 AND "
                                   "name IN ('topics', 'messages')");
  return query && sqlite3_step(query.get()) == SQLITE_ROW && sqlite3_column_int(query.get(), 0) == 2;
}

}  // namespace

bool starts_like_sqlite(std::string_view start) { return start.substr(0, kSqliteMagic.size()) == kSqliteMagic; }

Result<BagFileReading> read_sqlite_bag(const std::string& path, const BagSink& sink, const Progress& progress) {
  if (!starts_like_sqlite(read_file_start(path, kSqliteMagic.size())))
    return Error{path, "other first bytes", "an SQLite database, as rosbag2 writes it"};
  BagFileReading reading;
  // A recording that was interrupted left its last messages in a log beside the file. Without one, the file is opened
  // as one that nobody changes: that needs no lock and no folder that can be written.
  std::error_code failure;
  const bool log_beside =
      std::filesystem::exists(path + "-wal", failure) && std::filesystem::file_size(path + "-wal", failure) > 0;
  Database database = open_database(path, log_beside);
  if (log_beside && !has_ordinary_tables(database)) {
    database = open_database(path, false);
    reading.damage.push_back("what the log beside the file (-wal) holds could not be read");
  }
  if (!has_ordinary_tables(database)) {
    const std::string why = database ? sqlite3_errmsg(database.get()) : "out of memory";
    return Error{path,
                 why == "not an error" ? "a database without tables 'topics' and 'messages'"
                                       : "a database that cannot be read (" + why + ")",
                 "a bag as rosbag2 writes it"};
  }

  std::map<std::int64_t, std::size_t> index_of;
  {
    const Statement query = prepared(database, "SELECT id, name, type, serialization_format FROM topics");
    int state = SQLITE_ERROR;
    while (query && (state = sqlite3_step(query.get())) == SQLITE_ROW) {
      index_of[sqlite3_column_int64(query.get(), 0)] = reading.topics.size();
      reading.topics.push_back({text_at(query, 1), text_at(query, 2), text_at(query, 3)});
    }
    if (state != SQLITE_DONE)
      return Error{path, std::string("a table of topics that cannot be read (") + sqlite3_errmsg(database.get()) + ")",
                   "a bag as rosbag2 writes it"};
  }

  const Statement query = prepared(database, "SELECT topic_id, timestamp, data FROM messages NOT INDEXED");
  if (!query)
    return Error{path, std::string("a table of messages that cannot be read (") + sqlite3_errmsg(database.get()) + ")",
                 "a bag as rosbag2 writes it"};
  std::uint64_t messages = 0, nameless = 0;
  int state = SQLITE_ROW;
  while ((state = sqlite3_step(query.get())) == SQLITE_ROW) {
    // how many there are only a second pass could tell
    if (++messages % 4096 == 0 && !goes_on(progress, 0.5)) return reading;
    const auto topic = index_of.find(sqlite3_column_int64(query.get(), 0));
    const auto* data = static_cast<const char*>(sqlite3_column_blob(query.get(), 2));
    const int size = sqlite3_column_bytes(query.get(), 2);
    if (topic == index_of.end() || !data || size < 0)
      ++nameless;
    else
      sink(reading.topics[topic->second], sqlite3_column_int64(query.get(), 1),
           std::string_view(data, static_cast<std::size_t>(size)));
  }
  if (state != SQLITE_DONE)
    reading.damage.push_back("the file is cut or damaged: after " + std::to_string(messages) +
                             (messages == 1 ? " message" : " messages") + " SQLite says '" +
                             sqlite3_errmsg(database.get()) + "'; what it gave before was read");
  if (nameless > 0)
    reading.damage.push_back(std::to_string(nameless) + (nameless == 1 ? " message" : " messages") +
                             " left out, empty or of topics that the file does not describe");
  return reading;
}

}  // namespace odolab
