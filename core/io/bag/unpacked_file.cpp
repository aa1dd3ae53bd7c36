#include "core/io/bag/unpacked_file.h"

#include <unistd.h>
#include <zstd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <vector>

#include "core/io/bag/file_window.h"

namespace odolab {

namespace {

namespace fs = std::filesystem;

struct Free {
  void operator()(ZSTD_DStream* s) const { ZSTD_freeDStream(s); }
  void operator()(std::FILE* f) const { std::fclose(f); }
};

}  // namespace

bool starts_like_zstd(std::string_view start) { return start.substr(0, 4) == "\x28\xB5\x2F\xFD"; }

Result<UnpackedFile> UnpackedFile::of(const std::string& path, const Progress& progress) {
  Result<FileWindow> packed = FileWindow::open(path, progress);
  if (!packed) return packed.error();
  if (!starts_like_zstd(packed->peek(4)))
    return Error{path, packed->size() == 0 ? "an empty file" : "other first bytes", "a file packed by zstd"};
  std::error_code failure;
  const fs::path folder = fs::temp_directory_path(failure);
  std::string name = ((failure ? fs::path("/tmp") : folder) / "odolab-XXXXXX").string();
  const int descriptor = ::mkstemp(name.data());
  if (descriptor < 0) return Error{name, std::strerror(errno), "a folder for temporary files"};
  UnpackedFile unpacked;
  unpacked.path_ = name;
  const std::unique_ptr<std::FILE, Free> out(::fdopen(descriptor, "wb"));
  if (!out) return Error{name, std::strerror(errno), "a folder for temporary files"};
  const fs::space_info room = fs::space(name, failure);
  const std::uintmax_t most = failure ? 1ull << 32 : room.available / 2;

  const std::unique_ptr<ZSTD_DStream, Free> stream(ZSTD_createDStream());
  ZSTD_initDStream(stream.get());
  std::vector<char> buffer(ZSTD_DStreamOutSize());
  std::uintmax_t size = 0;
  std::string why;
  std::size_t unfinished = 0;  // zstd's hint of what a frame still needs; 0 between frames
  while (unpacked.damage_.empty()) {
    const std::string_view bytes = packed->peek(1 << 18);
    if (bytes.empty()) break;
    ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
    bool full = true;
    while (in.pos < in.size || full) {
      ZSTD_outBuffer to{buffer.data(), buffer.size(), 0};
      unfinished = ZSTD_decompressStream(stream.get(), &to, &in);
      if (ZSTD_isError(unfinished)) {
        why = std::string(" (zstd: ") + ZSTD_getErrorName(unfinished) + ")";
        unpacked.damage_ = "the packed file is damaged" + why + "; what could be unpacked before was read";
        break;
      }
      size += to.pos;
      if (size > most)
        return Error{path, "more than " + std::to_string(most >> 20) + " MB when unpacked",
                     "twice the room in " + fs::path(name).parent_path().string() + " (TMPDIR names another folder)"};
      if (std::fwrite(buffer.data(), 1, to.pos, out.get()) != to.pos)
        return Error{name, std::strerror(errno), "room for the unpacked file"};
      full = to.pos == to.size;
      if (unfinished == 0 && in.pos == in.size) break;
    }
    packed->advance(bytes.size());
  }
  if (unpacked.damage_.empty() && unfinished != 0)
    unpacked.damage_ = "the packed file is cut; what could be unpacked was read";
  if (std::fflush(out.get()) != 0) return Error{name, std::strerror(errno), "room for the unpacked file"};
  if (size == 0) return Error{path, "nothing that can be unpacked" + why, "a file packed by zstd"};
  return unpacked;
}

UnpackedFile::UnpackedFile(UnpackedFile&& other) noexcept
    : path_(std::move(other.path_)), damage_(std::move(other.damage_)) {
  other.path_.clear();
}

UnpackedFile::~UnpackedFile() {
  if (!path_.empty()) std::remove(path_.c_str());
}

}  // namespace odolab
