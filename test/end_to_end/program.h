// Runs the program as a script would.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "source_dir.h"

namespace odolab {

struct Outcome {
  int exit_code = -1;
  std::string output;  // standard output
  std::string errors;  // standard error
};

inline std::string text_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// A folder of the running test's own, empty at its start: tests run beside each other.
inline std::filesystem::path fresh_folder(std::string name) {
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  name = std::string("odolab_") + test->test_suite_name() + "_" + test->name() + "_" + name;
  std::replace(name.begin(), name.end(), '/', '-');
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

// `arguments` as a shell would read them; the program starts in the project's folder.
inline Outcome odolab(const std::string& arguments) {
  static int count = 0;
  const std::filesystem::path log = std::filesystem::temp_directory_path() /
                                    ("odolab_log_" + std::to_string(::getpid()) + "_" + std::to_string(++count));
  const std::string command = "cd '" ODOLAB_SOURCE_DIR "' && '" ODOLAB_PROGRAM "' " + arguments + " >'" + log.string() +
                              ".out' 2>'" + log.string() + ".err' </dev/null";
  const int status = std::system(command.c_str());
  Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of_file(log.string() + ".out"),
                  text_of_file(log.string() + ".err")};
  std::filesystem::remove(log.string() + ".out");
  std::filesystem::remove(log.string() + ".err");
  return outcome;
}

// Bad usage or bad input: exit 2, one line that names all of `words`, and nothing on standard output.
inline void expect_refused(const std::string& arguments, const std::vector<std::string>& words) {
  const Outcome outcome = odolab(arguments);
  EXPECT_EQ(outcome.exit_code, 2) << arguments << "\n" << outcome.errors;
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  for (const std::string& word : words)
    EXPECT_NE(outcome.errors.find(word), std::string::npos) << word << " in: " << outcome.errors;
  EXPECT_EQ(outcome.output, "") << arguments;
}

}  // namespace odolab
