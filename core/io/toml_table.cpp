#include "core/io/toml_table.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/nearest_word.h"
#include "core/io/number_text.h"
#include "core/io/whole_file.h"

namespace odolab {

// A table that was visited: null where the file does not have it, and every key that was asked for in it.
struct TomlTable::Node {
  const toml::table* table = nullptr;
  std::string path;  // as its header says it, with a dot behind; empty for the top
  std::vector<std::string> asked;
};

struct TomlTable::File {
  std::string path;
  toml::table top;
  std::vector<std::unique_ptr<Node>> nodes;
  std::optional<Error> failure;
  // Keys of one table that had to be given and were not. If it has a key much like the first, that one is misspelt.
  std::optional<Error> missing;
  const Node* missing_in = nullptr;
  std::string missing_key;

  Node* visit(const toml::table* table, const std::string& path) {
    if (table)
      for (const std::unique_ptr<Node>& known : nodes)
        if (known->table == table) return known.get();
    nodes.push_back(std::make_unique<Node>());
    nodes.back()->table = table;
    nodes.back()->path = path;
    return nodes.back().get();
  }
};

namespace {

constexpr std::size_t kWordsToList = 8;  // of more, an error names only the nearest

std::string place(const std::string& path, const toml::source_region& source) {
  return source.begin ? path + ":" + std::to_string(source.begin.line) : path;
}

// What stands in the file, in the file's own words as far as one line allows.
std::string shown(const toml::node& node) {
  if (const auto* text = node.as_string()) return in_quotes(text->get());
  if (const auto* number = node.as_floating_point())
    return std::isfinite(number->get()) ? number_text(number->get())
           : std::isnan(number->get())  ? "nan"
                                        : "an infinity";
  if (const auto* number = node.as_integer()) return std::to_string(number->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  if (node.is_table()) return "a table";
  if (const auto* array = node.as_array())
    return array->is_array_of_tables() ? "an array of tables" : "an array of " + std::to_string(array->size());
  return "a date or time";
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
  return text;
}

std::string expected_instead_of(std::string_view key, const std::vector<std::string>& known) {
  const std::string* nearest = nearest_word(key, known);
  if (nearest) return "a known key; the nearest is '" + *nearest + "'";
  return known.empty() ? "no key here" : known.size() == 1 ? "the key " + known[0] : "a known key: " + joined(known);
}

bool near(std::string_view key, std::string_view known) {
  return edit_distance(key, known) <= std::max<std::size_t>(2, key.size() / 3);
}

// TOML++ explains at length, over several lines; its first clause says what matters.
std::string one_line(std::string_view text) {
  std::string line(text.substr(0, text.find('\n')));
  for (char& c : line)
    if (c < ' ' && c >= 0) c = ' ';
  if (line.size() > 160) line = line.substr(0, 157) + "...";
  return line;
}

}  // namespace

Result<TomlTable> TomlTable::read(const std::string& path) {
  const Result<std::string> text = read_whole_file(path);
  if (!text) return text.error();
  return parse(*text, path);
}

Result<TomlTable> TomlTable::parse(const std::string& text, const std::string& path) {
  auto file = std::make_shared<File>();
  file->path = path;
  if (trimmed(text).empty()) return Error{path, "an empty file", "TOML keys"};
  try {
    file->top = toml::parse(text, path);
  } catch (const toml::parse_error& error) {
    return Error{place(path, error.source()), "broken TOML (" + one_line(error.description()) + ")",
                 "key = value, [table] or [[table]]"};
  }
  Node* top = file->visit(&file->top, "");
  return TomlTable(std::move(file), top);
}

bool TomlTable::present() const { return node_->table != nullptr; }
bool TomlTable::has(const char* key) const { return node_->table && node_->table->contains(key); }
bool TomlTable::has_table(const char* key) const { return has(key) && node_->table->get(key)->is_table(); }

namespace {

const toml::node* asked_for(const toml::table* table, std::vector<std::string>& asked, const char* key) {
  if (std::find(asked.begin(), asked.end(), key) == asked.end()) asked.emplace_back(key);
  return table ? table->get(key) : nullptr;
}

}  // namespace

void TomlTable::fail(Error error) {
  if (!file_->failure) file_->failure = std::move(error);
}

const std::optional<Error>& TomlTable::failure() const { return file_->failure ? file_->failure : file_->missing; }

void TomlTable::require(const char* key) { require(key, "key '" + std::string(key) + "'"); }
void TomlTable::require_table(const char* key) { require(key, "table [" + node_->path + key + "]"); }

void TomlTable::require(const char* key, const std::string& named) {
  asked_for(node_->table, node_->asked, key);
  if (has(key) || file_->failure) return;
  if (file_->missing) {  // all that one table lacks is said at once
    if (file_->missing_in != node_) return;
    file_->missing->found += ", no " + named;
    file_->missing->expected = "them to be given";
    return;
  }
  const bool top = node_->table == &file_->top;
  const std::string where = node_->table && !top ? place(file_->path, node_->table->source()) : file_->path;
  file_->missing = Error{where, "no " + named, "it to be given"};
  file_->missing_in = node_;
  file_->missing_key = key;
}

void TomlTable::field(const char* key, double& value) {
  const toml::node* node = asked_for(node_->table, node_->asked, key);
  if (!node) return;
  const std::optional<double> number = node->is_number() ? node->value<double>() : std::nullopt;
  if (!number || !std::isfinite(*number))
    return fail({place(file_->path, node->source()) + ": " + key, shown(*node), "a number"});
  value = *number;
}

void TomlTable::field(const char* key, std::optional<double>& value) {
  double number = 0.0;
  field(key, number);
  if (has(key)) value = number;
}

void TomlTable::field(const char* key, int& value) {
  const toml::node* node = asked_for(node_->table, node_->asked, key);
  if (!node) return;
  const auto* number = node->as_integer();
  if (!number || number->get() < -2147483647 || number->get() > 2147483647)
    return fail({place(file_->path, node->source()) + ": " + key, shown(*node), "a whole number"});
  value = static_cast<int>(number->get());
}

void TomlTable::field(const char* key, std::uint64_t& value) {
  const toml::node* node = asked_for(node_->table, node_->asked, key);
  if (!node) return;
  const auto* number = node->as_integer();
  if (!number || number->get() < 0)
    return fail({place(file_->path, node->source()) + ": " + key, shown(*node), "a whole number, 0 or more"});
  value = static_cast<std::uint64_t>(number->get());
}

void TomlTable::field(const char* key, bool& value) {
  const toml::node* node = asked_for(node_->table, node_->asked, key);
  if (!node) return;
  const auto* flag = node->as_boolean();
  if (!flag) return fail({place(file_->path, node->source()) + ": " + key, shown(*node), "true or false"});
  value = flag->get();
}

void TomlTable::field(const char* key, std::string& value) {
  const toml::node* node = asked_for(node_->table, node_->asked, key);
  if (!node) return;
  const auto* text = node->as_string();
  if (!text) return fail({place(file_->path, node->source()) + ": " + key, shown(*node), "a text in quotes"});
  value = text->get();
}

void TomlTable::field(const char* key, std::vector<double>& values) {
  const toml::node* node = asked_for(node_->table, node_->asked, key);
  if (!node) return;
  const auto* array = node->as_array();
  if (!array) return fail({place(file_->path, node->source()) + ": " + key, shown(*node), "an array of numbers"});
  values.clear();
  for (const toml::node& element : *array) {
    const std::optional<double> number = element.is_number() ? element.value<double>() : std::nullopt;
    if (!number || !std::isfinite(*number))
      return fail({place(file_->path, element.source()) + ": " + key, shown(element), "a number"});
    values.push_back(*number);
  }
}

void TomlTable::field(const char* key, std::vector<Vec2>& points) {
  const toml::node* node = asked_for(node_->table, node_->asked, key);
  if (!node) return;
  const auto* array = node->as_array();
  if (!array) return fail({place(file_->path, node->source()) + ": " + key, shown(*node), "an array of points [x, y]"});
  points.clear();
  for (const toml::node& element : *array) {
    const auto* pair = element.as_array();
    if (!pair || pair->size() != 2 || !pair->get(0)->is_number() || !pair->get(1)->is_number())
      return fail({place(file_->path, element.source()) + ": " + key, shown(element), "a point [x, y]"});
    const double x = *pair->get(0)->value<double>(), y = *pair->get(1)->value<double>();
    if (!std::isfinite(x) || !std::isfinite(y))
      return fail({place(file_->path, element.source()) + ": " + key, "a point that is not finite", "a point [x, y]"});
    points.push_back({x, y});
  }
}

std::size_t TomlTable::index_of_choice(const char* key, std::size_t otherwise, const std::vector<std::string>& words) {
  const toml::node* node = asked_for(node_->table, node_->asked, key);
  if (!node) return otherwise;
  if (const auto* text = node->as_string()) {
    const auto word = std::find(words.begin(), words.end(), text->get());
    if (word != words.end()) return static_cast<std::size_t>(word - words.begin());
    if (words.size() > kWordsToList)
      if (const std::string* nearest = nearest_word(text->get(), words)) {
        fail({place(file_->path, node->source()) + ": " + key, shown(*node),
              "a known word; the nearest is '" + *nearest + "'"});
        return otherwise;
      }
  }
  fail({place(file_->path, node->source()) + ": " + key, shown(*node), joined(words)});
  return otherwise;
}

TomlTable TomlTable::table(const char* key) {
  const toml::node* node = asked_for(node_->table, node_->asked, key);
  if (node && !node->is_table()) fail({place(file_->path, node->source()) + ": " + key, shown(*node), "a table"});
  return TomlTable(file_, file_->visit(node ? node->as_table() : nullptr, node_->path + key + "."));
}

std::vector<TomlTable> TomlTable::tables(const char* key) {
  const toml::node* node = asked_for(node_->table, node_->asked, key);
  if (!node) return {};
  const auto* array = node->as_array();
  const bool all_tables =
      array && std::all_of(array->begin(), array->end(), [](const toml::node& element) { return element.is_table(); });
  if (!all_tables) {
    fail({place(file_->path, node->source()) + ": " + key, shown(*node), "tables, each under [[...]]"});
    return {};
  }
  std::vector<TomlTable> result;
  for (const toml::node& element : *array)
    result.push_back(TomlTable(file_, file_->visit(element.as_table(), node_->path + key + ".")));
  return result;
}

std::string TomlTable::place_of(const std::string& key_path) const {
  const toml::node* node = &file_->top;
  std::string where = file_->path;
  std::size_t from = 0;
  while (from < key_path.size()) {
    const std::size_t to = std::min(key_path.find_first_of(".[", from), key_path.size());
    const toml::table* table = node->as_table();
    node = table ? table->get(key_path.substr(from, to - from)) : nullptr;
    if (!node) break;
    from = to;
    if (from < key_path.size() && key_path[from] == '[') {
      const toml::array* array = node->as_array();
      const std::size_t index = static_cast<std::size_t>(std::atoi(key_path.c_str() + from + 1));
      node = array && index >= 1 ? array->get(index - 1) : nullptr;
      if (!node) break;
      from = std::min(key_path.find(']', from), key_path.size() - 1) + 1;
    }
    where = place(file_->path, node->source());
    if (from < key_path.size() && key_path[from] == '.') ++from;
  }
  return where;
}

Error TomlTable::error_of(const std::string& problem) const {
  const std::size_t found = problem.find(": found ");
  if (found == std::string::npos) return {file_->path + ": " + problem, "", ""};
  const std::string key = problem.substr(0, found);
  const std::size_t begin = found + 8, expected = problem.find(", expected ", begin);
  Error error{place_of(key) + ": " + key, problem.substr(begin, expected - begin), ""};
  if (expected != std::string::npos) error.expected = problem.substr(expected + 11);
  return error;
}

Result<Done> TomlTable::finish() const {
  if (file_->failure && !file_->missing) return *file_->failure;
  const toml::key* first = nullptr;
  const Node* of = nullptr;
  for (const std::unique_ptr<Node>& node : file_->nodes) {
    if (!node->table) continue;
    for (const auto& entry : *node->table) {
      if (std::find(node->asked.begin(), node->asked.end(), entry.first.str()) != node->asked.end()) continue;
      if (first && !(entry.first.source().begin < first->source().begin)) continue;
      first = &entry.first;
      of = node.get();
    }
  }
  const auto is_misspelt = [&] {
    return near(first->str(), file_->missing_key) ||
           (of == file_->missing_in && nearest_word(first->str(), of->asked) != nullptr);
  };
  if (file_->missing && !(first && is_misspelt())) return *file_->missing;
  if (!first) return Done{};
  return Error{place(file_->path, first->source()), "the key '" + std::string(first->str()) + "'",
               expected_instead_of(first->str(), of->asked)};
}

}  // namespace odolab
