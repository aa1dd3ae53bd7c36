#include "core/io/whole_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

namespace odolab {

namespace {

namespace fs = std::filesystem;

std::string lower_first(std::string text) {
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return text;
}

std::optional<int> number_of(const std::string& text) {
  int number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

// N of /dev/fd/N, which is what this process has open.
std::optional<int> own_descriptor(const fs::path& path) {
  std::error_code failure;
  const fs::path folder = fs::canonical(path.has_parent_path() ? path.parent_path() : ".", failure);
  if (failure || folder.filename() != "fd" ||
      folder.string().rfind("/proc/" + std::to_string(::getpid()) + "/", 0) != 0)
    return std::nullopt;
  return number_of(path.filename().string());
}

// What is written where a path is given.
struct Target {
  fs::path file;                  // links followed
  bool straight = false;          // it cannot be renamed onto
  std::optional<int> descriptor;  // of what is open already
};

Result<Target> target_of(const std::string& path) {
  constexpr int kMostLinks = 40;
  std::error_code failure;
  Target target{path, false, std::nullopt};
  for (int links = 0;; ++links) {
    target.descriptor = own_descriptor(target.file);
    if (target.descriptor) break;
    if (!fs::is_symlink(fs::symlink_status(target.file, failure))) break;
    if (links == kMostLinks) return Error{path, lower_first(std::strerror(ELOOP)), "a file that can be written"};
    const fs::path next = fs::read_symlink(target.file, failure);
    if (failure) return Error{path, lower_first(failure.message()), "a file that can be written"};
    target.file = target.file.parent_path() / next;  // `next` alone where it begins at the root
  }
  const fs::file_status status = fs::status(path, failure);
  // What another process has open is behind a link that only looks like one.
  target.straight =
      target.descriptor ||
      (fs::exists(status) && (!fs::is_regular_file(status) || !fs::equivalent(path, target.file, failure)));
  if (target.straight) target.file = path;
  return target;
}

void sync_folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const int handle = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY);
  if (handle < 0) return;
  ::fsync(handle);
  ::close(handle);
}

}  // namespace

Error stopped_reading(const std::string& path) { return {path, "a wish to stop", "time to read it"}; }

Result<std::string> read_whole_file(const std::string& path, const Progress& progress) {
  std::error_code failure;
  if (std::filesystem::is_directory(path, failure)) return Error{path, "a folder", "a file"};
  if (!std::filesystem::exists(path, failure)) return Error{path, "no such file", "a file that can be read"};
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) return Error{path, lower_first(std::strerror(errno)), "a file that can be read"};
  std::string text;
  char buffer[1 << 16];
  bool stop = false;
  ssize_t n = 1;  // of a pipe as much as has come
  while (!stop && (n > 0 || (n < 0 && errno == EINTR))) {
    n = ::read(::fileno(file), buffer, sizeof buffer);
    if (n > 0) text.append(buffer, static_cast<std::size_t>(n));
    stop = !goes_on(progress, 0.0);
  }
  const bool failed = n < 0;
  std::fclose(file);
  if (stop) return stopped_reading(path);
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

std::optional<Error> unwritable(const std::string& path) {
  const auto failed = [&] { return Error{path, lower_first(std::strerror(errno)), "a file that can be written"}; };
  std::error_code failure;
  if (fs::is_directory(path, failure)) return Error{path, "a folder", "a file that can be written"};
  const Result<Target> target = target_of(path);
  if (!target) return target.error();
  if (target->descriptor) {
    const int flags = ::fcntl(*target->descriptor, F_GETFL);
    if (flags >= 0 && (flags & O_ACCMODE) == O_RDONLY) errno = EBADF;
    if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY) return failed();
    return std::nullopt;
  }
  if (target->straight) {
    if (::access(path.c_str(), W_OK) != 0) return failed();
    return std::nullopt;
  }
  fs::path folder = target->file.has_parent_path() ? target->file.parent_path() : ".";
  std::string name = target->file.filename().string();
  while (!fs::exists(folder, failure) && folder.has_relative_path()) {  // it will be made
    name = folder.filename().string();
    folder = folder.has_parent_path() ? folder.parent_path() : ".";
  }
  const std::string tried = (folder / (name + ".part" + std::to_string(::getpid()))).string();
  const int handle = ::open(tried.c_str(), O_WRONLY | O_CREAT | O_EXCL, 0600);
  if (handle < 0) return failed();
  ::close(handle);
  ::unlink(tried.c_str());
  return std::nullopt;
}

std::string spill_folder_of(const std::string& path) {
  const Result<Target> target = target_of(path);
  std::error_code failure;
  if (!target || target->straight) return fs::temp_directory_path(failure).string();
  return target->file.has_parent_path() ? target->file.parent_path().string() : ".";
}

Result<GrowingFile> GrowingFile::create(const std::string& path) {
  std::error_code failure;
  if (fs::is_directory(path, failure)) return Error{path, "a folder", "a file that can be written"};
  const Result<Target> target = target_of(path);
  if (!target) return target.error();
  if (!target->straight && target->file.has_parent_path()) {
    fs::create_directories(target->file.parent_path(), failure);
    if (failure) return Error{path, lower_first(failure.message()), "a folder that can be made"};
  }
  static std::atomic<unsigned> counter{0};
  GrowingFile file;
  file.path_ = path;
  file.target_ = target->file.string();
  if (!target->straight)
    file.temporary_ = file.target_ + ".part" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
  if (target->descriptor) {
    std::fflush(stdout);  // what was printed comes first
    const int again = ::dup(*target->descriptor);
    file.file_ = again < 0 ? nullptr : ::fdopen(again, "wb");
    if (!file.file_ && again >= 0) ::close(again);
  } else {
    file.file_ = std::fopen((target->straight ? file.target_ : file.temporary_).c_str(), "wb");
  }
  if (!file.file_) return Error{path, lower_first(std::strerror(errno)), "a file that can be written"};
  return file;
}

GrowingFile::GrowingFile(GrowingFile&& other) noexcept
    : file_(other.file_),
      path_(std::move(other.path_)),
      target_(std::move(other.target_)),
      temporary_(std::move(other.temporary_)),
      failure_(other.failure_) {
  other.file_ = nullptr;
}

GrowingFile::~GrowingFile() {
  if (!file_) return;
  std::fclose(file_);
  if (!temporary_.empty()) std::remove(temporary_.c_str());
}

void GrowingFile::write(std::string_view bytes) {
  if (failure_ == 0 && std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) failure_ = errno;
}

Result<Done> GrowingFile::finish(bool durably) {
  if (durably && failure_ == 0 && (std::fflush(file_) != 0 || ::fsync(::fileno(file_)) != 0)) failure_ = errno;
  if (std::fclose(file_) != 0 && failure_ == 0) failure_ = errno;
  file_ = nullptr;
  const bool straight = temporary_.empty();
  if (failure_ == 0 && !straight && std::rename(temporary_.c_str(), target_.c_str()) != 0) failure_ = errno;
  if (failure_ == 0 && durably && !straight) sync_folder_of(target_);
  if (failure_ == 0) return Done{};
  if (!straight) std::remove(temporary_.c_str());
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
