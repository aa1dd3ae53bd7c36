#include "core/io/export/plotjuggler_csv.h"

#include <cmath>

#include "core/io/csv_table.h"
#include "core/io/number_text.h"
#include "core/io/whole_file.h"

namespace odolab {

std::string plotjuggler_name(const std::string& channel) {
  for (const char* group : {"truth", "command", "trailer", "link", "a", "b"}) {
    const std::string prefix = std::string(group) + "_";
    if (channel.compare(0, prefix.size(), prefix) == 0) return std::string(group) + "/" + channel.substr(prefix.size());
  }
  if (channel.compare(0, 6, "castor") == 0)
    if (const std::size_t end = channel.find('_'); end != std::string::npos)
      return channel.substr(0, end) + "/" + channel.substr(end + 1);
  if (channel.find("wheel") != std::string::npos || channel.find("ticks") != std::string::npos)
    return "wheels/" + channel;
  return channel;
}

Result<Done> write_plotjuggler_csv(const std::string& path, const Recording& recording) {
  Result<GrowingFile> file = GrowingFile::create(path);
  if (!file) return file.error();
  std::string text = "time_s";
  for (const Channel& channel : recording.channels) text += ',' + csv_name(plotjuggler_name(channel.name));
  for (std::size_t i = 0; i < recording.time_s.size(); ++i) {
    text += '\n';
    text += decimal_text(recording.time_s[i]);
    for (const Channel& channel : recording.channels) {
      text += ',';
      if (!std::isnan(channel.values[i])) text += decimal_text(channel.values[i]);
    }
    if (text.size() < 1 << 16) continue;
    file->write(text);
    text.clear();
  }
  file->write(text + '\n');
  return file->finish();
}

}  // namespace odolab
