#include "core/io/bag/file_window.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace odolab {

namespace {

constexpr std::size_t kLeastBuffer = 1 << 18;

}  // namespace

Result<FileWindow> FileWindow::open(const std::string& path, Progress progress) {
  std::error_code failure;
  if (std::filesystem::is_directory(path, failure)) return Error{path, "a folder", "a file"};
  if (!std::filesystem::exists(path, failure)) return Error{path, "no such file", "a file that can be read"};
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) return Error{path, std::strerror(errno), "a file that can be read"};
  const long size = std::fseek(file, 0, SEEK_END) == 0 ? std::ftell(file) : -1;
  if (size < 0 || std::fseek(file, 0, SEEK_SET) != 0) {
    std::fclose(file);
    return Error{path, "no ordinary file", "a file that can be read"};
  }
  std::setvbuf(file, nullptr, _IONBF, 0);
  return FileWindow(file, static_cast<std::uint64_t>(size), std::move(progress));
}

std::string_view FileWindow::peek(std::uint64_t wanted) {
  wanted = std::min(wanted, left());
  if (end_ - begin_ < wanted) {
    if (!goes_on(progress_, static_cast<double>(position_) / static_cast<double>(size_))) {
      size_ = position_;
      return {};
    }
    if (end_ > begin_) std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
    const std::size_t room = std::max<std::size_t>(kLeastBuffer, static_cast<std::size_t>(wanted));
    if (buffer_.size() < room) buffer_.resize(room);
    while (end_ < wanted) {
      const std::size_t n = std::fread(buffer_.data() + end_, 1, buffer_.size() - end_, file_.get());
      if (n == 0) {
        size_ = position_ + end_;  // it shrank, or cannot be read further
        break;
      }
      end_ += n;
    }
  }
  return {buffer_.data() + begin_, std::min(static_cast<std::size_t>(wanted), end_ - begin_)};
}

void FileWindow::advance(std::uint64_t bytes) {
  bytes = std::min(bytes, left());
  if (bytes <= end_ - begin_) {
    begin_ += static_cast<std::size_t>(bytes);
    position_ += bytes;
  } else {
    seek(position_ + bytes);
  }
}

void FileWindow::seek(std::uint64_t position) {
  position_ = std::min(position, size_);
  begin_ = end_ = 0;
  std::fseek(file_.get(), static_cast<long>(position_), SEEK_SET);
}

}  // namespace odolab
