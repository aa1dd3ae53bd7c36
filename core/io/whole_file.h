// Files read and written in one piece, so that no output is ever half-written.
#pragma once

#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/progress.h"
#include "core/base/result.h"

namespace odolab {

// The bytes of a file. An error names the file where it is missing, is a folder or cannot be read, or where `progress`,
// which is told no share here, says stop.
Result<std::string> read_whole_file(const std::string& path, const Progress& progress = {});
Error stopped_reading(const std::string& path);

// The first bytes of a file, enough to see what it is; empty where it cannot be read.
// Text that programs of one make write, which nobody else reads.
bool is_utf16(std::string_view start);
Error utf16_error(const std::string& path);

std::string read_file_start(const std::string& path, std::size_t bytes = 8192);

// Writes to a temporary file beside `path` and renames it: whoever looks sees the old file or the whole new one.
// Folders that are missing on the way are made. A link stays: what it leads to is written. What cannot be renamed onto,
// a device or a pipe, is written straight, and so is what this process has open, such as /dev/stdout, whatever it is.
Result<Done> write_whole_file(const std::string& path, const std::string& text);

// The same, and what was written is on the disk when this returns: it outlives a crash of the machine, too. Takes the
// time of a disk, some milliseconds.
Result<Done> write_whole_file_durably(const std::string& path, const std::string& text);

// What would keep `path` from being written, told before the work begins; nothing is left there.
std::optional<Error> unwritable(const std::string& path);

// The folder for what is put aside until `path` is written: its own, or the one for temporary files where `path` is no
// file that is made there.
std::string spill_folder_of(const std::string& path);

// The same for a file that is written piece by piece. Where finish() is not reached, nothing is left.
class GrowingFile {
 public:
  static Result<GrowingFile> create(const std::string& path);
  GrowingFile(GrowingFile&& other) noexcept;
  GrowingFile& operator=(GrowingFile&&) = delete;
  ~GrowingFile();

  void write(std::string_view bytes);  // what goes wrong comes out of finish()
  Result<Done> finish(bool durably = false);

 private:
  GrowingFile() = default;
  std::FILE* file_ = nullptr;
  std::string path_, target_, temporary_;  // as given, with links followed, and empty where it is written straight
  int failure_ = 0;                        // errno of the first write that failed
};

}  // namespace odolab
