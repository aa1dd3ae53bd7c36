#include "app/gui/folder_listing.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>

#include "core/io/file_kind.h"

namespace odolab {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostEntries = 500;

bool can_be_opened(const fs::path& path) {
  // Only files of these endings are looked into: a folder may hold anything.
  static const std::array<const char*, 5> kEndings = {".toml", ".csv", ".dat", ".txt", ".log"};
  const std::string ending = path.extension().string();
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end() &&
         file_kind(path.string()) != FileKind::unknown;
}

// `folder` is as typed: empty, or with a slash at its end.
std::vector<ui::PathEntry> entries_of(const std::string& folder) {
  std::vector<ui::PathEntry> folders, files;
  std::error_code ended;
  const fs::path where = folder.empty() ? fs::path(".") : fs::path(expanded(folder));
  fs::directory_iterator it(where, fs::directory_options::skip_permission_denied, ended);
  for (; !ended && it != fs::directory_iterator() && folders.size() + files.size() < kMostEntries;
       it.increment(ended)) {
    std::error_code unknown;
    const std::string name = it->path().filename().string();
    if (it->is_directory(unknown))
      folders.push_back({name + "/", folder + name + "/", true});
    else if (it->is_regular_file(unknown) && can_be_opened(it->path()))
      files.push_back({name, folder + name, false});
  }
  const auto by_name = [](const ui::PathEntry& a, const ui::PathEntry& b) { return a.name < b.name; };
  std::sort(folders.begin(), folders.end(), by_name);
  std::sort(files.begin(), files.end(), by_name);
  folders.insert(folders.end(), files.begin(), files.end());
  return folders;
}

bool begins_with(const std::string& name, const std::string& beginning) {
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
  };
  return beginning.size() <= name.size() && std::equal(beginning.begin(), beginning.end(), name.begin(), same);
}

}  // namespace

std::string expanded(const std::string& path) {
  const char* home = std::getenv("HOME");
  return home && (path == "~" || path.rfind("~/", 0) == 0) ? home + path.substr(1) : path;
}

const std::vector<ui::PathEntry>& FolderListing::of(const std::string& typed) {
  const std::size_t slash = typed.find_last_of('/');
  const std::string folder = slash == std::string::npos ? "" : typed.substr(0, slash + 1);
  std::string beginning = slash == std::string::npos ? typed : typed.substr(slash + 1);
  if (known_ && folder == folder_ && typed == typed_) return matching_;
  if (!known_ || folder != folder_) all_ = entries_of(folder);
  known_ = true;
  folder_ = folder;
  typed_ = typed;
  matching_.clear();
  for (const ui::PathEntry& e : all_)
    if (e.name == beginning) {  // typed in full: what else lies there is more use than this one again
      beginning.clear();
      break;
    }
  const fs::path above = fs::path(expanded(folder)).parent_path().parent_path();
  if (beginning.empty() && folder.size() > 1 && !above.empty())
    matching_.push_back({"../", above == "/" ? "/" : above.string() + "/", true});
  for (const ui::PathEntry& e : all_) {
    const bool hidden = e.name.front() == '.' && beginning.empty();
    if (!hidden && begins_with(e.name, beginning)) matching_.push_back(e);
  }
  return matching_;
}

}  // namespace odolab
