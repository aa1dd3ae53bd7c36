// A file that was compressed as a whole, unpacked where programs that need a file of their own can read it.
#pragma once

#include <string>
#include <string_view>

#include "core/base/progress.h"
#include "core/base/result.h"

namespace odolab {

bool starts_like_zstd(std::string_view start);

// Lies in the system's folder for temporary files (TMPDIR) and is gone with this object.
class UnpackedFile {
 public:
  // Unpacks a zstd file as far as it goes. Errors: the file cannot be read or holds nothing that zstd can unpack, or
  // what comes out would take more than half of the room that is free.
  static Result<UnpackedFile> of(const std::string& path, const Progress& progress = {});
  UnpackedFile(UnpackedFile&& other) noexcept;
  UnpackedFile& operator=(UnpackedFile&&) = delete;
  ~UnpackedFile();

  const std::string& path() const { return path_; }
  const std::string& damage() const { return damage_; }  // what could not be unpacked, in words; empty where all was

 private:
  UnpackedFile() = default;
  std::string path_, damage_;
};

}  // namespace odolab
