#include "core/io/unread_columns.h"

#include <algorithm>
#include <string_view>

#include "core/base/nearest_word.h"
#include "core/io/number_text.h"
#include "core/io/recording_csv.h"

namespace odolab {

namespace {

std::string_view first_word(std::string_view name) { return name.substr(0, name.find('_')); }

// The names that would say what nothing in the recording says.
std::vector<std::string> missing_in(const Recording& recording) {
  static const std::vector<std::vector<std::string>> kSaySame = {{"left_wheel_rad", "left_ticks"},
                                                                 {"right_wheel_rad", "right_ticks"},
                                                                 {"truth_x_m"},
                                                                 {"truth_y_m"},
                                                                 {"truth_heading_rad"},
                                                                 {"command_speed_mps"},
                                                                 {"command_yaw_rate_radps"}};
  std::vector<std::string> missing;
  for (const std::vector<std::string>& names : kSaySame)
    if (std::none_of(names.begin(), names.end(), [&](const std::string& name) {
          return std::any_of(recording.channels.begin(), recording.channels.end(),
                             [&](const Channel& channel) { return channel.name == name; });
        }))
      missing.insert(missing.end(), names.begin(), names.end());
  return missing;
}

// Of those that begin with the same word the one that is most like it; else one that is nearly the same.
const std::string* meant_by(const std::string& name, const std::vector<std::string>& missing) {
  const std::string* meant = nullptr;
  for (const std::string& other : missing)
    if (first_word(other) == first_word(name) && (!meant || edit_distance(name, other) < edit_distance(name, *meant)))
      meant = &other;
  return meant ? meant : nearest_word(name, missing);
}

}  // namespace

std::vector<std::string> unread_columns(const Recording& recording) {
  const std::vector<std::string> missing = missing_in(recording);
  std::vector<std::string> sentences;
  for (const Channel& channel : recording.channels) {
    if (is_recording_column(channel.name)) continue;
    if (const std::string* meant = meant_by(channel.name, missing))
      sentences.push_back("the column " + in_quotes(channel.name) + " is not read: if it is '" + *meant +
                          "', it must be called so (odolab import --map " + *meant + "=" + printable(channel.name) +
                          "[,UNIT] does it)");
  }
  return sentences;
}

}  // namespace odolab
