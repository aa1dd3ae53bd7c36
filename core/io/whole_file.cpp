#include "core/io/whole_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace odolab {

namespace {

std::string lower_first(std::string text) {
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return text;
}

}  // namespace

Result<std::string> read_whole_file(const std::string& path) {
  std::error_code failure;
  if (std::filesystem::is_directory(path, failure)) return Error{path, "a folder", "a file"};
  if (!std::filesystem::exists(path, failure)) return Error{path, "no such file", "a file that can be read"};
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) return Error{path, lower_first(std::strerror(errno)), "a file that can be read"};
  std::string text;
  char buffer[1 << 16];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, file)) > 0;) text.append(buffer, n);
  const bool failed = std::ferror(file) != 0;
  std::fclose(file);
  if (failed) return Error{path, "an error while reading", "a file that can be read"};
  return text;
}

std::string read_file_start(const std::string& path, std::size_t bytes) {
  std::error_code failure;
  if (!std::filesystem::is_regular_file(path, failure)) return {};
  std::ifstream file(path, std::ios::binary);
  std::string text(bytes, '\0');
  file.read(text.data(), static_cast<std::streamsize>(bytes));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

Result<Done> write_whole_file(const std::string& path, const std::string& text) {
  const std::filesystem::path target(path);
  std::error_code failure;
  if (std::filesystem::is_directory(target, failure)) return Error{path, "a folder", "a file that can be written"};
  if (target.has_parent_path()) {
    std::filesystem::create_directories(target.parent_path(), failure);
    if (failure) return Error{path, lower_first(failure.message()), "a folder that can be made"};
  }
  static std::atomic<unsigned> counter{0};
  // a pipe or a terminal cannot be renamed onto
  const bool in_place = std::filesystem::exists(target, failure) && !std::filesystem::is_regular_file(target, failure);
  const std::string temporary =
      in_place ? path : path + ".part" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
  std::FILE* file = std::fopen(temporary.c_str(), "wb");
  if (!file) return Error{path, lower_first(std::strerror(errno)), "a file that can be written"};
  bool whole = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  int reason = errno;
  if (std::fclose(file) != 0 && whole) {
    whole = false;
    reason = errno;
  }
  if (whole && !in_place && std::rename(temporary.c_str(), path.c_str()) != 0) {
    whole = false;
    reason = errno;
  }
  if (whole) return Done{};
  if (!in_place) std::remove(temporary.c_str());
  return Error{path, lower_first(std::strerror(reason)), "a file that can be written"};
}

}  // namespace odolab
