#include "app/gui/settings.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <locale>
#include <sstream>

#include "core/io/whole_file.h"

namespace odolab {

namespace {

constexpr std::size_t kMostRecent = 8;

std::string from_environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

}  // namespace

std::string settings_path() {
  const std::string config = from_environment("XDG_CONFIG_HOME"), home = from_environment("HOME");
  if (!config.empty()) return config + "/odolab/window";
  return home.empty() ? "" : home + "/.config/odolab/window";
}

std::string data_folder() {
  const std::string data = from_environment("XDG_DATA_HOME"), home = from_environment("HOME");
  if (!data.empty()) return data + "/odolab";
  return home.empty() ? "" : home + "/.local/share/odolab";
}

Settings read_settings(const std::string& path) {
  Settings s;
  const Result<std::string> text = read_whole_file(path);
  std::istringstream file(text ? *text : "");
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    std::string key;
    words >> key;
    const auto number = [&](double& value, double least, double most) {
      double read = 0.0;
      if (words >> read) value = std::clamp(read, least, most);
    };
    const auto whole = [&](int& value, int least, int most) {
      int read = 0;
      if (words >> read) value = std::clamp(read, least, most);
    };
    if (key == "dark")
      s.dark = line == "dark 1";
    else if (key == "welcome_seen")
      s.welcome_seen = line == "welcome_seen 1";
    else if (key == "scale")
      number(s.scale, 0.0, 4.0);
    else if (key == "width")
      whole(s.width, 480, 16384);
    else if (key == "height")
      whole(s.height, 320, 16384);
    else if (key == "left_width")
      number(s.left_width, 120.0, 1000.0);
    else if (key == "right_width")
      number(s.right_width, 120.0, 1000.0);
    else if (key == "bottom_height")
      number(s.bottom_height, 80.0, 1000.0);
    else if (key == "recent" && line.size() > 7)
      s.recent_files.push_back(line.substr(7));
  }
  if (s.recent_files.size() > kMostRecent) s.recent_files.resize(kMostRecent);
  return s;
}

void write_settings(const std::string& path, const Settings& s) {
  if (path.empty()) return;
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << "dark " << (s.dark ? 1 : 0) << "\nwelcome_seen " << (s.welcome_seen ? 1 : 0) << "\nscale " << s.scale
       << "\nwidth " << s.width << "\nheight " << s.height << "\nleft_width " << s.left_width << "\nright_width "
       << s.right_width << "\nbottom_height " << s.bottom_height << "\n";
  for (std::size_t i = 0; i < std::min(kMostRecent, s.recent_files.size()); ++i)
    text << "recent " << s.recent_files[i] << "\n";
  const Result<Done> written = write_whole_file(path, text.str());
  (void)written;
}

}  // namespace odolab
