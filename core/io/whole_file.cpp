#include "core/io/whole_file.h"

#include <fcntl.h>
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

void sync_folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const int handle = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY);
  if (handle < 0) return;
  ::fsync(handle);
  ::close(handle);
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

bool is_utf16(std::string_view start) { return start.substr(0, 2) == "\xFF\xFE" || start.substr(0, 2) == "\xFE\xFF"; }

Error utf16_error(const std::string& path) {
  return {path, "text in UTF-16", "text in UTF-8: 'iconv -f UTF-16 -t UTF-8' makes it"};
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

Result<GrowingFile> GrowingFile::create(const std::string& path) {
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
  GrowingFile file;
  file.path_ = path;
  file.temporary_ = in_place ? path : path + ".part" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
  file.file_ = std::fopen(file.temporary_.c_str(), "wb");
  if (!file.file_) return Error{path, lower_first(std::strerror(errno)), "a file that can be written"};
  return file;
}

GrowingFile::GrowingFile(GrowingFile&& other) noexcept
    : file_(other.file_),
      path_(std::move(other.path_)),
      temporary_(std::move(other.temporary_)),
      failure_(other.failure_) {
  other.file_ = nullptr;
}

GrowingFile::~GrowingFile() {
  if (!file_) return;
  std::fclose(file_);
  if (temporary_ != path_) std::remove(temporary_.c_str());
}

void GrowingFile::write(std::string_view bytes) {
  if (failure_ == 0 && std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) failure_ = errno;
}

Result<Done> GrowingFile::finish(bool durably) {
  if (durably && failure_ == 0 && (std::fflush(file_) != 0 || ::fsync(::fileno(file_)) != 0)) failure_ = errno;
  if (std::fclose(file_) != 0 && failure_ == 0) failure_ = errno;
  file_ = nullptr;
  const bool in_place = temporary_ == path_;
  if (failure_ == 0 && !in_place && std::rename(temporary_.c_str(), path_.c_str()) != 0) failure_ = errno;
  if (failure_ == 0 && durably) sync_folder_of(path_);
  if (failure_ == 0) return Done{};
  if (!in_place) std::remove(temporary_.c_str());
  return Error{path_, lower_first(std::strerror(failure_)), "a file that can be written"};
}

Result<Done> write_whole_file(const std::string& path, const std::string& text) {
  Result<GrowingFile> file = GrowingFile::create(path);
  if (!file) return file.error();
  file->write(text);
  return file->finish();
}

Result<Done> write_whole_file_durably(const std::string& path, const std::string& text) {
  Result<GrowingFile> file = GrowingFile::create(path);
  if (!file) return file.error();
  file->write(text);
  return file->finish(true);
}

}  // namespace odolab
