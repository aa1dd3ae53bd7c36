// A file read from front to back through a buffer that does not grow with it.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"

namespace odolab {

class FileWindow {
 public:
  // An error where the path is no file that can be read. Where `progress`, told the share that was read, says to stop,
  // the file ends there.
  static Result<FileWindow> open(const std::string& path, Progress progress = {});

  // The next `wanted` bytes, fewer where the file ends before; they stay valid until the next call. The buffer grows to
  // what is asked for, but never beyond what the file really holds.
  std::string_view peek(std::uint64_t wanted);
  // Steps over bytes, of which the peeked ones are the first; stops at the end.
  void advance(std::uint64_t bytes);
  void seek(std::uint64_t position);

  std::uint64_t position() const { return position_; }
  std::uint64_t size() const { return size_; }
  std::uint64_t left() const { return size_ - position_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  FileWindow(std::FILE* file, std::uint64_t size, Progress progress)
      : file_(file), size_(size), progress_(std::move(progress)) {}

  std::unique_ptr<std::FILE, Close> file_;
  std::uint64_t size_ = 0;
  Progress progress_;
  std::uint64_t position_ = 0;  // of the first byte not yet stepped over
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // of what the buffer holds, from position_ on
};

}  // namespace odolab
