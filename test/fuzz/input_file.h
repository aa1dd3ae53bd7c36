// What a fuzzer made up, as a file: the readers take files.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "core/recording/recording.h"

namespace odolab {

// Written anew for each input, in memory where the system has a folder for that.
inline std::string input_file(const std::uint8_t* data, std::size_t size, const char* ending) {
  static const std::string folder = ::access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp";
  const std::string path = folder + "/odolab-fuzz-" + std::to_string(::getpid()) + ending;
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file) std::abort();
  if (size > 0 && std::fwrite(data, 1, size, file) != size) std::abort();
  std::fclose(file);
  return path;
}

// Whatever a reader hands over must be a sound recording.
inline void must_be_sound(const Recording& recording) {
  const std::vector<std::string> problems = problems_in(recording);
  if (problems.empty()) return;
  std::fprintf(stderr, "%s\n", problems.front().c_str());
  std::abort();
}

}  // namespace odolab
