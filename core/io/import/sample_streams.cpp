#include "core/io/import/sample_streams.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/io/number_text.h"
#include "core/io/whole_file.h"
#include "core/recording/clock_jump.h"
#include "core/recording/value_range.h"

namespace odolab {

namespace {

// When a source's samples begin and end.
struct Span {
  std::string source;
  std::int64_t first_ns, last_ns;

  std::string text() const {
    return "from " + number_text("%.3f", 1e-9 * static_cast<double>(first_ns)) + " to " +
           number_text("%.3f", 1e-9 * static_cast<double>(last_ns)) + " s in " + source;
  }
};

std::vector<Span> spans_of(const SampleStreams& from) {
  std::vector<Span> spans;
  for (std::size_t i = 0; i < from.streams.size(); ++i) {
    const SampleSpool& stream = from.streams[i];
    if (stream.size() == 0) continue;
    const auto known =
        std::find_if(spans.begin(), spans.end(), [&](const Span& span) { return span.source == from.sources[i]; });
    if (known == spans.end()) {
      spans.push_back({from.sources[i], stream.first_ns(), stream.last_ns()});
    } else {
      known->first_ns = std::min(known->first_ns, stream.first_ns());
      known->last_ns = std::max(known->last_ns, stream.last_ns());
    }
  }
  return spans;
}

// Sources that never measured at the same time: of two clocks where a day and more lies between, to be doubted else.
std::optional<Error> two_clocks(SampleStreams& from) {
  std::vector<Span> spans = spans_of(from);
  std::stable_sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.first_ns < b.first_ns; });
  for (std::size_t i = 1, latest = 0; i < spans.size(); ++i) {
    const Span &before = spans[latest], &span = spans[i];
    if (span.last_ns > before.last_ns) latest = i;
    if (span.first_ns <= before.last_ns) continue;
    const std::string times = "times " + before.text() + " and " + span.text();
    if (1e-9 * static_cast<double>(span.first_ns - before.last_ns) > kLongestPause_s)
      return Error{from.name, times,
                   "times of one clock that overlap: map each file's in its unit (s, ms, us, ns), and where clocks "
                   "differ add to one file's times what it is behind"};
    from.warnings.push_back(times + " do not overlap: the files may be by two clocks");
  }
  return std::nullopt;
}

// Rows out of several streams, each in order of time.
class Rows {
 public:
  static Result<Rows> of(SampleStreams& from) {
    Rows rows;
    for (SampleSpool& stream : from.streams) {
      if (Result<Done> done = stream.finish(); !done) return done.error();
      if (stream.late() > 0)
        from.warnings.push_back(std::to_string(stream.late()) + (stream.late() == 1 ? " sample of " : " samples of ") +
                                stream.channels().front() + " left out: time goes back there");
      if (stream.beyond() > 0)
        from.warnings.push_back(std::to_string(stream.beyond()) +
                                (stream.beyond() == 1 ? " sample of " : " samples of ") + stream.channels().front() +
                                " left out: a time that cannot be");
      if (stream.size() == 0) continue;
      for (std::size_t c = 0; c < stream.channels().size(); ++c) {
        const std::string& name = stream.channels()[c];
        if (std::find(rows.names.begin(), rows.names.end(), name) != rows.names.end())
          return Error{from.name, "two sources for " + name, "one"};
        rows.names.push_back(name);
        if (stream.wraps(c))
          from.warnings.push_back(name + " was written wrapped into one turn; it was made continuous");
      }
      rows.heads_.push_back({&stream, 0, std::vector<double>(stream.channels().size()), true});
    }
    if (rows.heads_.empty()) return Error{from.name, "no sample", "wheels, commands or a truth"};
    if (const std::optional<Error> error = two_clocks(from)) return *error;
    std::int64_t zero = std::numeric_limits<std::int64_t>::max();
    for (Head& head : rows.heads_) {
      zero = std::min(zero, head.stream->first_ns());
      rows.advance(head);
    }
    rows.zero_ns_ = zero;
    rows.name_ = from.name;
    for (const std::string& name : rows.names) rows.largest_.push_back(largest_value(name));
    return rows;
  }

  std::vector<std::string> names;

  // False after the last row.
  bool next(double& time_s, std::vector<double>& row) {
    std::int64_t time_ns = std::numeric_limits<std::int64_t>::max();
    bool any = false;
    for (const Head& head : heads_)
      if (head.there) {
        time_ns = std::min(time_ns, head.time_ns);
        any = true;
      }
    if (!any) return false;
    row.assign(names.size(), kEmpty);
    std::size_t column = 0;
    for (Head& head : heads_) {
      if (head.there && head.time_ns == time_ns) {
        std::copy(head.values.begin(), head.values.end(), row.begin() + static_cast<std::ptrdiff_t>(column));
        advance(head);
      }
      column += head.values.size();
    }
    // no time lies before zero, and unsigned numbers hold every difference
    time_s = static_cast<double>(static_cast<std::uint64_t>(time_ns) - static_cast<std::uint64_t>(zero_ns_)) / 1e9;
    for (std::size_t c = 0; c < row.size() && !beyond_; ++c)
      if (std::abs(row[c]) > largest_[c])
        beyond_ = Error{name_ + ": " + names[c],
                        number_text(row[c]) + " at " + number_text("%.10g", time_s) + " s", range_text(names[c])};
    if (watch_.add(time_s))
      jump_ = Error{name_ + ": time_s",
                    "a row " + number_text("%.10g", time_s - before_s_) + " s after the one before, which is at " +
                        number_text(before_s_) + " s",
                    kRowsOfOneClock};
    before_s_ = time_s;
    return true;
  }

  // What is wrong with all that `next` gave.
  std::optional<Error> fault() const { return watch_.is_one_clock() ? beyond_ : jump_; }

 private:
  struct Head {
    SampleSpool* stream;
    std::int64_t time_ns;
    std::vector<double> values;
    bool there;
  };
  static void advance(Head& head) { head.there = head.stream->next(head.time_ns, head.values.data()); }

  std::vector<Head> heads_;
  std::int64_t zero_ns_ = 0;
  std::string name_;
  JumpWatch watch_;
  std::optional<Error> jump_, beyond_;
  std::vector<double> largest_;  // of each name
  double before_s_ = 0.0;
};

}  // namespace

Error stopped(const std::string& path) { return {path, "a wish to stop", "time to finish; nothing was written"}; }

SampleSpool& SampleStreams::add_stream(std::vector<std::string> channels) {
  sources.push_back(source);
  streams.emplace_back(std::move(channels), spill_folder);
  return streams.back();
}

Result<Recording> recording_of(SampleStreams& streams) {
  Result<Rows> rows = Rows::of(streams);
  if (!rows) return rows.error();
  Recording recording;
  recording.name = streams.name;
  recording.provenance = streams.provenance;
  for (const std::string& name : rows->names) recording.channels.push_back({name, {}});
  double time_s = 0.0;
  std::vector<double> row;
  while (rows->next(time_s, row)) {
    recording.time_s.push_back(time_s);
    for (std::size_t c = 0; c < row.size(); ++c) recording.channels[c].values.push_back(row[c]);
  }
  if (const std::optional<Error> fault = rows->fault()) return *fault;
  return recording;
}

Result<WrittenRecording> write_streams_csv(const std::string& path, SampleStreams& streams) {
  Result<Rows> rows = Rows::of(streams);
  if (!rows) return rows.error();
  WrittenRecording written;
  written.channels = rows->names;
  Result<GrowingFile> file = GrowingFile::create(path);
  if (!file) return file.error();
  std::string text = "time_s";
  for (const std::string& name : rows->names) text += ',' + name;
  text += '\n';
  double time_s = 0.0, first_s = 0.0;
  std::vector<double> row;
  while (rows->next(time_s, row)) {
    if (written.rows++ == 0) first_s = time_s;
    append_number(text, time_s);
    for (double value : row) {
      text += ',';
      if (!std::isnan(value)) append_number(text, value);
    }
    text += '\n';
    if (text.size() < 1 << 16) continue;
    if (!goes_on(streams.progress, 0.5)) return stopped(path);
    file->write(text);
    text.clear();
  }
  if (const std::optional<Error> fault = rows->fault()) return *fault;
  file->write(text);
  if (Result<Done> done = file->finish(); !done) return done.error();
  written.duration_s = time_s - first_s;
  return written;
}

}  // namespace odolab
