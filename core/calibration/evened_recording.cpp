#include "core/calibration/evened_recording.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "core/base/formatted.h"
#include "core/calibration/even_stamps.h"
#include "core/calibration/repeated_stamps.h"
#include "core/recording/new_times.h"
#include "core/recording/truth_left_out.h"

namespace odolab {

namespace {

bool of_wheels(const std::string& name) {
  return name == "left_wheel_rad" || name == "right_wheel_rad" || name == "left_ticks" || name == "right_ticks";
}

// Every computer's stamps tremble a little.
bool is_worth_a_word(const EvenStamps& even) {
  constexpr double kOfThePeriod = 0.02;
  return even.trembling_s > kOfThePeriod * even.period_s;
}

std::string name_or_words(const std::string& name) { return name.empty() ? "the recording" : name; }

std::string evened_sentence(const std::string& name, const char* what, const EvenStamps& even) {
  const std::string text = formatted(": its %s stamps tremble by %.2g ms about an even %.3g Hz; evened", what,
                                     1e3 * even.trembling_s, 1.0 / even.period_s);
  return name_or_words(name) + text;
}

std::string evened_sentence(const std::string& name, const char* what, const SpreadStamps& spread) {
  const std::string text =
      spread.repeated == 1
          ? formatted(": one of its %s stamps repeats the one before; put between its neighbours", what)
          : formatted(": %d of its %s stamps repeat the one before; put between their neighbours", spread.repeated,
                      what);
  return name_or_words(name) + text;
}

// `new_s`: a time for each row that `taken` says was sampled.
std::vector<double> row_times(const std::vector<char>& taken, const std::vector<double>& new_s) {
  std::vector<double> times(taken.size(), std::numeric_limits<double>::quiet_NaN());
  std::size_t k = 0;
  for (std::size_t i = 0; i < taken.size(); ++i)
    if (taken[i]) times[i] = new_s[k++];
  return times;
}

// Rows in which all of these channels hold a value, or nothing where one is missing in a row that holds another: those
// were read apart from each other.
std::optional<std::vector<char>> rows_of(const Recording& recording, const std::vector<std::string>& channels) {
  std::vector<char> taken(recording.time_s.size());
  bool any = false;
  for (const std::string& name : channels) {
    const Channel* c = recording.channel(name);
    if (!c) return std::nullopt;
    for (std::size_t i = 0; i < taken.size(); ++i) {
      const bool is_read = !std::isnan(c->values[i]);
      if (&name == &channels.front()) taken[i] = is_read;
      if (is_read != (taken[i] != 0)) return std::nullopt;
      any = any || is_read;
    }
  }
  if (!any) return std::nullopt;
  return taken;
}

// What was read of the encoders: rows, and paths at their times.
struct ReadEncoders {
  std::optional<std::vector<char>> rows;
  std::vector<double> time_s;
  std::vector<std::vector<double>> paths;
  std::function<bool(const std::string&)> belongs;
};

// Of readings that were taken evenly, or of which some have the stamp of the one before; and what is to be said of it.
std::optional<std::vector<double>> new_times(const std::string& name, const char* what,
                                             const std::vector<double>& time_s,
                                             const std::vector<std::vector<double>>& paths, bool together,
                                             std::vector<std::string>& said) {
  if (const auto even = even_stamps(time_s, paths, together)) {
    if (is_worth_a_word(*even)) said.push_back(evened_sentence(name, what, *even));
    return even->time_s;
  }
  const auto spread = spread_repeated(time_s);
  if (!spread) return std::nullopt;
  said.push_back(evened_sentence(name, what, *spread));
  return spread->time_s;
}

// A row that says what the one before said of wheels or truth, at the same time: a log that wrote it twice. None where
// others at one time say something else: then stamps are rounded, and of slow wheels two readings are alike.
std::vector<std::size_t> rows_written_twice(const Recording& r) {
  constexpr double kFew = 0.02;  // of those at one time
  std::vector<std::size_t> rows;
  std::size_t say_otherwise = 0;
  const auto is_same = [&](const Channel& c, std::size_t i) {
    return c.values[i] == c.values[i - 1] || (std::isnan(c.values[i]) && std::isnan(c.values[i - 1]));
  };
  const auto is_read = [&](const Channel& c, std::size_t i) {
    return !std::isnan(c.values[i]) && c.name.rfind("command_", 0) != 0;
  };
  for (std::size_t i = 1; i < r.time_s.size(); ++i)
    if (r.time_s[i] == r.time_s[i - 1] &&
        std::all_of(r.channels.begin(), r.channels.end(), [&](const Channel& c) { return is_same(c, i); }) &&
        std::any_of(r.channels.begin(), r.channels.end(), [&](const Channel& c) { return is_read(c, i); }))
      rows.push_back(i);
    else if (r.time_s[i] == r.time_s[i - 1] && std::any_of(r.channels.begin(), r.channels.end(), [&](const Channel& c) {
               return is_read(c, i) && is_read(c, i - 1) && !is_same(c, i);
             }))
      ++say_otherwise;
  if (static_cast<double>(say_otherwise) > kFew * static_cast<double>(rows.size() + say_otherwise)) rows.clear();
  return rows;
}

Recording without_rows(const Recording& r, const std::vector<std::size_t>& rows) {
  const auto kept = [&](const std::vector<double>& all) {
    std::vector<double> some;
    std::size_t next = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (next < rows.size() && rows[next] == i)
        ++next;
      else
        some.push_back(all[i]);
    return some;
  };
  Recording out{r.name, r.provenance, kept(r.time_s), {}};
  for (const Channel& c : r.channels) out.channels.push_back({c.name, kept(c.values)});
  return out;
}

// `even`: of a recording without such rows.
template <typename Even>
std::optional<EvenedRecording> evened_once(const Recording& recording, const Even& even) {
  const std::vector<std::size_t> twice = rows_written_twice(recording);
  if (twice.empty()) return even(recording);
  Recording once = without_rows(recording, twice);
  std::optional<EvenedRecording> out = even(once);
  if (!out) out = EvenedRecording{std::move(once), {}};
  out->said.insert(out->said.begin(),
                   name_or_words(recording.name) + formatted(": %d of its rows are written twice; each is used once",
                                                             static_cast<int>(twice.size())));
  return out;
}

std::optional<EvenedRecording> evened_by(const Recording& recording, const ReadEncoders& read) {
  EvenedRecording out;
  std::vector<NewTimes> parts;
  if (read.rows &&
      static_cast<std::ptrdiff_t>(read.time_s.size()) == std::count(read.rows->begin(), read.rows->end(), 1))
    if (const auto times = new_times(recording.name, "encoder", read.time_s, read.paths, false, out.said))
      parts.push_back({read.belongs, row_times(*read.rows, *times)});
  if (const auto seen = rows_of(recording, {"truth_x_m", "truth_y_m"})) {
    std::vector<double> time_s, x, y;
    for (const TruthSample& t : truth_samples(recording)) {
      time_s.push_back(t.time_s);
      x.push_back(t.position.x_m);
      y.push_back(t.position.y_m);
    }
    if (const auto times = new_times(recording.name, "truth", time_s, {x, y}, true, out.said))
      parts.push_back({is_of_truth, row_times(*seen, *times)});
  }
  if (parts.empty()) return std::nullopt;
  out.recording = with_new_times(recording, parts);
  return out;
}

std::optional<EvenedRecording> evened_of(const Recording& recording, const DifferentialDrive& drive) {
  ReadEncoders read{rows_of(recording, {"left_wheel_rad", "right_wheel_rad"}), {}, {{}, {}}, of_wheels};
  if (!read.rows) read.rows = rows_of(recording, {"left_ticks", "right_ticks"});
  if (read.rows)
    for (const WheelSample& w : wheel_samples(recording, drive)) {
      read.time_s.push_back(w.time_s);
      read.paths[0].push_back(w.left_rad);
      read.paths[1].push_back(w.right_rad);
    }
  return evened_by(recording, read);
}

std::optional<EvenedRecording> evened_of(const Recording& recording, const std::vector<std::string>& encoders) {
  ReadEncoders read{rows_of(recording, encoders), {}, {}, [&](const std::string& name) {
                      return std::find(encoders.begin(), encoders.end(), name) != encoders.end();
                    }};
  if (read.rows) {
    for (std::size_t i = 0; i < recording.time_s.size(); ++i)
      if ((*read.rows)[i]) read.time_s.push_back(recording.time_s[i]);
    for (const std::string& name : encoders) {
      if (name.find("wheel_rad") == std::string::npos) continue;
      std::vector<double>& path = read.paths.emplace_back();
      for (std::size_t i = 0; i < recording.time_s.size(); ++i)
        if ((*read.rows)[i]) path.push_back(recording.channel(name)->values[i]);
    }
  }
  return evened_by(recording, read);
}

}  // namespace

std::optional<EvenedRecording> evened(const Recording& recording, const DifferentialDrive& drive) {
  return evened_once(recording, [&](const Recording& r) { return evened_of(r, drive); });
}

std::optional<EvenedRecording> evened(const Recording& recording, const std::vector<std::string>& encoders) {
  return evened_once(recording, [&](const Recording& r) { return evened_of(r, encoders); });
}

}  // namespace odolab
