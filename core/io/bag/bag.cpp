#include "core/io/bag/bag.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/io/bag/decompress.h"
#include "core/io/bag/mcap.h"
#include "core/io/bag/sqlite_bag.h"
#include "core/io/bag/unpacked_file.h"
#include "core/io/whole_file.h"

namespace odolab {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestMessage = 1ull << 28;
constexpr std::uint64_t kMessagesToNameJoints = 200;  // joint states of one topic that are looked at for names
constexpr std::size_t kMostNames = 1000;

bool is_bag_file(const std::string& path) {
  std::error_code failure;
  if (!fs::is_regular_file(path, failure)) return false;
  const std::string start = read_file_start(path, 16);
  return starts_like_mcap(start) || starts_like_sqlite(start) || path.ends_with(".mcap") || path.ends_with(".db3");
}

bool is_compressed_bag_file(const std::string& path) {
  return path.ends_with(".mcap.zstd") || path.ends_with(".db3.zstd") || path.ends_with(".mcap.zst") ||
         path.ends_with(".db3.zst");
}

// "run_2" before "run_10".
bool earlier(const std::string& a, const std::string& b) {
  std::size_t i = 0, k = 0;
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  while (i < a.size() && k < b.size()) {
    if (!digit(a[i]) || !digit(b[k])) {
      if (a[i] != b[k]) return a[i] < b[k];
      ++i, ++k;
      continue;
    }
    while (i < a.size() && a[i] == '0') ++i;
    while (k < b.size() && b[k] == '0') ++k;
    std::size_t m = 0, n = 0;
    while (i + m < a.size() && digit(a[i + m])) ++m;
    while (k + n < b.size() && digit(b[k + n])) ++n;
    if (m != n) return m < n;
    if (const int order = a.compare(i, m, b, k, n); order != 0) return order < 0;
    i += m, k += n;
  }
  return a.size() - i < b.size() - k;
}

std::vector<std::string> files_in(const std::string& folder, bool (*wanted)(const std::string&)) {
  std::vector<std::string> files;
  std::error_code failure;
  for (fs::directory_iterator at(folder, failure), end; !failure && at != end; at.increment(failure))
    if (wanted(at->path().string())) files.push_back(at->path().string());
  std::sort(files.begin(), files.end(), earlier);
  return files;
}

void add_transform(std::vector<BagTransform>& list, const RosPose& pose) {
  auto known = std::find_if(list.begin(), list.end(), [&](const BagTransform& t) {
    return t.parent == pose.frame && t.child == pose.child_frame;
  });
  if (known == list.end()) {
    if (list.size() >= kMostNames) return;
    known = list.insert(list.end(), {pose.frame, pose.child_frame, 0, {}});
  }
  ++known->messages;
  known->last = pose;
}

Result<BagFileReading> read_bag_file(const std::string& file, const BagSink& sink, const Progress& progress) {
  const std::string start = read_file_start(file, 16);
  if (starts_like_mcap(start)) return read_mcap(file, sink, progress);
  if (starts_like_sqlite(start)) return read_sqlite_bag(file, sink, progress);
  if (!is_compressed_bag_file(file))
    return file.ends_with(".db3") ? read_sqlite_bag(file, sink, progress) : read_mcap(file, sink, progress);
  const Result<UnpackedFile> unpacked = UnpackedFile::of(file, progress);
  if (!unpacked) return unpacked.error();
  const bool sqlite = starts_like_sqlite(read_file_start(unpacked->path(), 16));
  Result<BagFileReading> reading =
      sqlite ? read_sqlite_bag(unpacked->path(), sink, progress) : read_mcap(unpacked->path(), sink, progress);
  if (!reading) return Error{file, "unpacked, " + reading.error().found, reading.error().expected};
  if (!unpacked->damage().empty()) reading->damage.insert(reading->damage.begin(), unpacked->damage());
  return reading;
}

template <typename T>
void add_new(std::vector<T>& list, const T& item) {
  if (list.size() < kMostNames && std::find(list.begin(), list.end(), item) == list.end()) list.push_back(item);
}

}  // namespace

bool is_bag(const std::string& path) {
  std::error_code failure;
  if (fs::is_directory(path, failure))
    return !files_in(path, is_bag_file).empty() || !files_in(path, is_compressed_bag_file).empty();
  return is_bag_file(path) || is_compressed_bag_file(path);
}

Result<std::vector<std::string>> bag_files(const std::string& path) {
  std::error_code failure;
  std::vector<std::string> files;
  if (fs::is_directory(path, failure)) {
    files = files_in(path, is_bag_file);
    const std::vector<std::string> unpacked = files;
    for (const std::string& packed : files_in(path, is_compressed_bag_file))
      if (std::find(unpacked.begin(), unpacked.end(), packed.substr(0, packed.rfind('.'))) == unpacked.end())
        files.push_back(packed);
    std::sort(files.begin(), files.end(), earlier);
  } else {
    files.push_back(path);
  }
  if (files.empty()) return Error{path, "a folder without .mcap and .db3 files", "a bag"};
  return files;
}

Result<BagFileReading> read_bag(const std::string& path, const BagSink& sink, const Progress& progress) {
  const Result<std::vector<std::string>> files = bag_files(path);
  if (!files) return files.error();
  std::string unpacked;
  std::uint64_t broken = 0;
  const BagSink unpacking = [&](const BagTopic& topic, std::int64_t log_time_ns, std::string_view bytes) {
    if (!starts_like_zstd(bytes)) return sink(topic, log_time_ns, bytes);
    unpacked.clear();
    if (decompress(Compression::zstd, bytes, kLargestMessage, unpacked).whole)
      sink(topic, log_time_ns, unpacked);
    else
      ++broken;
  };
  BagFileReading all;
  std::optional<Error> failure;
  bool any = false;
  for (const std::string& file : *files) {
    const Result<BagFileReading> one = read_bag_file(file, unpacking, progress);
    const std::string name = fs::path(file).filename().string();
    if (!one) {
      if (!failure) failure = one.error();
      all.damage.push_back(name + " could not be read: found " + one.error().found);
      continue;
    }
    any = true;
    for (const BagTopic& topic : one->topics) {
      const bool known = std::any_of(all.topics.begin(), all.topics.end(), [&](const BagTopic& t) {
        return t.name == topic.name && t.type == topic.type && t.encoding == topic.encoding;
      });
      if (!known) all.topics.push_back(topic);
    }
    for (const std::string& sentence : one->damage) all.damage.push_back(name + ": " + sentence);
  }
  if (!any) return *failure;
  if (broken > 0)
    all.damage.push_back(std::to_string(broken) + (broken == 1 ? " message" : " messages") +
                         " left out: compressed, and damaged");
  return all;
}

Result<BagContents> contents_of_bag(const std::string& path, const Progress& progress) {
  BagContents contents;
  RosJointState joints;
  std::vector<RosPose> poses;
  const auto entry_of = [&](const BagTopic& topic) -> BagTopicContents& {
    for (BagTopicContents& known : contents.topics)
      if (known.topic.name == topic.name && known.topic.type == topic.type && known.topic.encoding == topic.encoding)
        return known;
    contents.topics.emplace_back();
    contents.topics.back().topic = topic;
    contents.topics.back().kind = topic.encoding == "cdr" ? ros_kind(topic.type) : RosKind::other;
    return contents.topics.back();
  };
  const BagTopic* last_topic = nullptr;
  std::size_t last_index = 0;
  Result<BagFileReading> reading = read_bag(
      path,
      [&](const BagTopic& topic, std::int64_t log_time_ns, std::string_view bytes) {
        if (&topic != last_topic || last_index >= contents.topics.size() ||
            contents.topics[last_index].topic.name != topic.name) {
          last_index = static_cast<std::size_t>(&entry_of(topic) - contents.topics.data());
          last_topic = &topic;
        }
        BagTopicContents& entry = contents.topics[last_index];
        entry.first_ns = entry.messages == 0 ? log_time_ns : std::min(entry.first_ns, log_time_ns);
        entry.last_ns = entry.messages == 0 ? log_time_ns : std::max(entry.last_ns, log_time_ns);
        ++entry.messages;
        if (entry.kind == RosKind::joint_state && entry.messages <= kMessagesToNameJoints &&
            read_joint_state(bytes, joints))
          for (const std::string& name : joints.names) add_new(entry.joints, name);
        if (entry.kind == RosKind::transforms && read_poses(topic.type, bytes, poses))
          for (const RosPose& pose : poses) add_transform(entry.transforms, pose);
      },
      progress);
  if (!reading) return reading.error();
  for (const BagTopic& topic : reading->topics) entry_of(topic);  // those without messages too
  std::sort(contents.topics.begin(), contents.topics.end(),
            [](const auto& a, const auto& b) { return a.topic.name < b.topic.name; });
  contents.damage = std::move(reading->damage);
  return contents;
}

}  // namespace odolab
