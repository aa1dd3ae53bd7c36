// Folders, files and their text, as the tests of core/io read and write them.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/base/result.h"
#include "source_dir.h"

namespace odolab {

// A folder of its own for each test, gone at its end.
class ScratchFolder {
 public:
  ScratchFolder() {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = "odolab-" + std::to_string(::getpid()) + "-" + test->test_suite_name() + "-" + test->name();
    for (char& c : name)
      if (c == '/') c = '-';
    folder_ = std::filesystem::temp_directory_path() / name;
    std::filesystem::create_directories(folder_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return path(name);
  }

  std::size_t files() const {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) count += entry.exists() ? 1 : 0;
    return count;
  }

 private:
  std::filesystem::path folder_;
};

// The message of an error, with the folder taken off; "ok" where there is none.
template <typename T>
std::string message_of(const Result<T>& result, const std::string& path) {
  if (result.ok()) return "ok";
  std::string text = result.error().message();
  const std::string folder = std::filesystem::path(path).parent_path().string() + "/";
  for (std::size_t at; (at = text.find(folder)) != std::string::npos;) text.erase(at, folder.size());
  return text;
}

inline std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

inline std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size()) ++n;
  return n;
}

// The folder of real recordings; empty where it is absent.
inline std::string recordings_folder() {
  const char* named = std::getenv("ODOLAB_RECORDINGS");
  const std::string folder = named ? named : ODOLAB_SOURCE_DIR "/../shared/recordings";
  return std::filesystem::is_directory(folder) ? folder : "";
}

#define SKIP_WITHOUT_RECORDINGS()  \
  if (recordings_folder().empty()) \
  GTEST_SKIP() << "the real recordings are not there: ../shared/recordings or ODOLAB_RECORDINGS"

}  // namespace odolab
