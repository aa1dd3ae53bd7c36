#include "core/io/import/imported_recording.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/io/bag/bag.h"
#include "core/io/import/format.h"
#include "core/io/import/text_rows.h"
#include "core/io/number_text.h"
#include "core/io/recording_csv.h"
#include "core/io/unread_columns.h"
#include "core/io/whole_file.h"
#include "core/recording/value_range.h"

namespace odolab {

const std::vector<ForeignFormat>& foreign_formats() {
  // mapped text is what is left: it stands last
  static const std::vector<ForeignFormat> formats = {
      optiodom_synchronised_format(),
      optiodom_raw_format(),
      mrclam_format(),
      ros2_bag_format(),
      tum_format(),
      kitti_format(),
      mapped_text_format(),
  };
  return formats;
}

namespace {

namespace fs = std::filesystem;

const ForeignFormat* format_of(const std::string& path) {
  const std::string start = read_file_start(path);
  for (const ForeignFormat& format : foreign_formats())
    if (format.recognises(path, start)) return &format;
  return nullptr;
}

// Whether the first line that is no comment names a column time_s and what a vehicle did, as no track does.
bool has_recording_header(const std::string& path) {
  const std::string start = read_file_start(path);
  std::string_view rest = start;
  while (rest.substr(0, 1) == "#" && rest.find('\n') != std::string_view::npos) rest.remove_prefix(rest.find('\n') + 1);
  const std::string_view header = rest.substr(0, rest.find('\n'));
  const auto names = [&](const char* column) { return header.find(column) != std::string_view::npos; };
  return names("time_s") && (names("wheel_rad") || names("_ticks") || names("command_"));
}

Error folder_given(const std::string& path) {
  std::vector<std::string> usable;
  std::error_code failure;
  for (fs::recursive_directory_iterator at(path, failure), end; at != end && usable.size() < 1000;
       at.increment(failure)) {
    const std::string file = at->path().string();
    if (at->is_regular_file(failure) && (has_recording_header(file) || format_of(file))) usable.push_back(file);
  }
  std::sort(usable.begin(), usable.end());
  if (usable.empty()) return {path, "a folder without recordings", "the file of a run"};
  return {
      path,
      "a folder with " + std::to_string(usable.size()) + (usable.size() == 1 ? " file" : " files") + " of recordings",
      "one run, such as " + in_quotes(fs::path(usable.front()).lexically_relative(path).string())};
}

std::string known_formats() {
  std::string text = "a recording CSV";
  for (const ForeignFormat& format : foreign_formats())
    text += std::string(&format == &foreign_formats().back() ? " or " : ", ") + format.sources;
  return text;
}

// Text of columns wants a mapping; what else it may be nobody needs to read.
Error of_no_known_format(const std::string& path) {
  const std::string start = read_file_start(path);
  if (start.empty()) return {path, "an empty file", known_formats()};
  Result<TextRows> rows = TextRows::open(path, {});
  if (!rows) return rows.error();
  std::vector<std::string_view> cells;
  if (start.find('\0') != std::string::npos || !rows->next(cells) || cells.size() < 2 || cells.back().empty())
    return {path, "a file of no known format", known_formats()};
  std::string names;
  for (std::size_t i = 0; i < cells.size() && i < 8; ++i) names += (i ? ", " : "") + in_quotes(cells[i]);
  return {path, "columns of one's own (" + names + (cells.size() > 8 ? ", ..." : "") + ")",
          "--map CHANNEL=COLUMN[,UNIT] for each, such as time_s=1,ms left_wheel_rad=2,deg (a name or a number)"};
}

}  // namespace

bool is_foreign_recording(const std::string& path) { return format_of(path) != nullptr; }

namespace {

bool is_own_recording(const std::vector<std::string>& sources, const ImportWishes& wishes) {
  return sources.size() == 1 && wishes.mapping.empty() && !format_of(sources.front()) &&
         has_recording_header(sources.front());
}

// A mapping is for what says nothing by itself: neither for bags nor for a trajectory that is given beside it.
const ForeignFormat* format_of(const std::string& path, const ImportWishes& wishes, bool alone) {
  const ForeignFormat* known = format_of(path);
  if (wishes.mapping.empty()) return known;
  std::error_code failure;
  if (known && (fs::is_directory(path, failure) || is_bag(path) || (known->stream && !alone))) return known;
  return &foreign_formats().back();
}

// The format of each source, or what is wrong with one.
Result<std::vector<const ForeignFormat*>> formats_of(const std::vector<std::string>& sources,
                                                     const ImportWishes& wishes) {
  if (sources.empty()) return Error{"import", "no source", known_formats()};
  std::vector<const ForeignFormat*> formats;
  for (const std::string& source : sources) {
    std::error_code failure;
    if (!fs::exists(source, failure)) return Error{source, "no such file", "a file that can be read"};
    const ForeignFormat* of_this = format_of(source, wishes, sources.size() == 1);
    if (!of_this && fs::is_directory(source, failure)) return folder_given(source);
    if (!of_this) return of_no_known_format(source);
    const ForeignFormat* first = formats.empty() ? of_this : formats.front();
    if (of_this != first && !(of_this->stream && first->stream))
      return Error{source, std::string("a file of ") + of_this->name,
                   std::string("one of ") + first->name + " as the first source"};
    formats.push_back(of_this);
  }
  return formats;
}

Result<SampleStreams> streams_of(const std::vector<std::string>& sources,
                                 const std::vector<const ForeignFormat*>& formats, const ImportWishes& wishes,
                                 const std::string& spill_folder, const Progress& progress) {
  SampleStreams streams;
  bool stop = false;
  streams.progress = [&progress, &stop](double share) { return !(stop = stop || !goes_on(progress, share)); };
  streams.spill_folder = spill_folder;
  streams.several_sources = sources.size() > 1;
  fs::path first = fs::path(sources.front()).lexically_normal();
  if (first.filename().empty()) first = first.parent_path();
  streams.name = first.filename().string();
  for (std::size_t i = 0; i < sources.size(); ++i) {
    streams.source = fs::path(sources[i]).filename().string();
    if (Result<Done> done = formats[i]->stream(sources[i], wishes, streams); !done || stop)
      return stop ? stopped(sources[i]) : done.error();
  }
  streams.progress = progress;
  std::vector<std::string> channels;
  for (const SampleSpool& stream : streams.streams)
    channels.insert(channels.end(), stream.channels().begin(), stream.channels().end());
  // with several sources each column of a mapping may be in any, and must be in one
  for (const MappedColumn& column : wishes.mapping.columns) {
    const std::string channel = column.becomes.substr(0, 7) == "truth_q" ? "truth_heading_rad" : column.becomes;
    const bool there = channel == "time_s" || std::find(channels.begin(), channels.end(), channel) != channels.end();
    if (!there)
      return Error{"--map", "no column " + in_quotes(column.column) + " in any source", "one for " + column.becomes};
  }
  if (const auto lonely = without_partner(channels))
    return Error{sources.front(), lonely->first + " alone", lonely->second + " with it"};
  return streams;
}

}  // namespace

Result<ImportedRecording> import_recording(const std::vector<std::string>& sources, const ImportWishes& wishes,
                                           const Progress& progress) {
  if (is_own_recording(sources, wishes)) return load_recording(sources.front(), progress);
  const auto formats = formats_of(sources, wishes);
  if (!formats) return formats.error();
  if (!formats->front()->stream) {
    Result<ImportedRecording> read = formats->front()->read(sources);
    if (read)
      if (const std::vector<std::string> problems = problems_in(read->recording); !problems.empty())
        return Error{sources.front() + ": " + problems.front(), "", ""};
    if (read)
      if (const std::optional<Error> beyond = value_beyond_range(read->recording))
        return Error{sources.front() + ": " + beyond->where, beyond->found, beyond->expected};
    return read;
  }
  Result<SampleStreams> streams = streams_of(sources, *formats, wishes, "", progress);
  if (!streams) return streams.error();
  Result<Recording> recording = recording_of(*streams);
  if (!recording) return Error{sources.front(), recording.error().found, recording.error().expected};
  return ImportedRecording{std::move(*recording), std::move(streams->warnings)};
}

Result<ImportedFile> import_into_csv(const std::vector<std::string>& sources, const ImportWishes& wishes,
                                     const std::string& out, const Progress& progress) {
  if (!is_own_recording(sources, wishes)) {
    const auto formats = formats_of(sources, wishes);
    if (!formats) return formats.error();
    if (formats->front()->stream) {
      std::error_code failure;
      const std::string folder = spill_folder_of(out);
      fs::create_directories(folder, failure);
      Result<SampleStreams> streams = streams_of(sources, *formats, wishes, folder, progress);
      if (!streams) return streams.error();
      Result<WrittenRecording> written = write_streams_csv(out, *streams);
      if (!written) return written.error();
      return ImportedFile{written->rows, written->duration_s, std::move(written->channels),
                          std::move(streams->warnings)};
    }
  }
  Result<ImportedRecording> imported = import_recording(sources, wishes, progress);
  if (!goes_on(progress, 1.0)) return stopped(out);
  if (!imported) return imported.error();
  const Recording& recording = imported->recording;
  if (Result<Done> written = write_recording_csv(out, recording); !written) return written.error();
  ImportedFile file{recording.time_s.size(), recording.duration_s(), {}, std::move(imported->warnings)};
  for (const Channel& channel : recording.channels) file.channels.push_back(channel.name);
  return file;
}

Result<ImportedRecording> load_recording(const std::string& path, const Progress& progress) {
  if (is_foreign_recording(path)) return import_recording({path}, {}, progress);
  std::error_code failure;
  if (fs::is_directory(path, failure)) return folder_given(path);
  Result<Recording> recording = read_recording_csv(path, progress, AllowedValues::of_a_robot);
  if (!recording) return recording.error();
  std::vector<std::string> warnings = unread_columns(*recording);
  std::erase_if(recording->channels, [&](const Channel& c) {
    const bool is_empty = !is_recording_column(c.name) &&
                          std::none_of(c.values.begin(), c.values.end(), [](double v) { return !std::isnan(v); });
    if (is_empty) warnings.push_back("the column " + in_quotes(c.name) + " holds no number and is left out");
    return is_empty;
  });
  return ImportedRecording{std::move(*recording), std::move(warnings)};
}

}  // namespace odolab
