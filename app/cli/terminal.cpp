#include "app/cli/terminal.h"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdarg>
#include <cstdio>

#include "app/cli/command.h"
#include "core/base/letters.h"

namespace odolab {

namespace {
volatile std::sig_atomic_t interrupt_seen = 0;
std::string interrupted_command;
std::string standard_output;  // where a file goes there
int letters_of_progress = 0;  // on the terminal's last line

void wipe_progress() {
  if (letters_of_progress > 0) std::fprintf(stderr, "\r%*s\r", letters_of_progress, "");
  letters_of_progress = 0;
}
}  // namespace

void print_error(const std::string& line) {
  wipe_progress();
  std::fprintf(stderr, "%s\n", line.c_str());
}
void print_message(const std::string& line) { print_error(line); }

int stopped_before_its_end() {
  print_error(interrupted_command + ": stopped before its end; nothing was written");
  return kStopped;
}

int bad_input(const Error& error) {
  if (interrupted()) return stopped_before_its_end();
  print_error(error.message());
  return kBadInput;
}

std::string text_of(const char* format, ...) {
  char text[1024];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

void print_table(const std::vector<std::vector<std::string>>& rows) {
  std::vector<int> widths;
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (widths.size() <= i) widths.push_back(0);
      widths[i] = std::max(widths[i], letters_of(row[i]));
    }
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string pad(static_cast<std::size_t>(widths[i] - letters_of(row[i])), ' ');
      line += (i > 0 ? "   " : "") + (i == 0 ? row[i] + pad : pad + row[i]);
    }
    while (!line.empty() && line.back() == ' ') line.pop_back();
    std::printf("%s\n", line.c_str());
  }
}

std::string standard_output_for_a_file() {
  if (standard_output.empty()) {
    std::fflush(stdout);
    const int kept = ::dup(STDOUT_FILENO);
    if (kept < 0 || ::dup2(STDERR_FILENO, STDOUT_FILENO) < 0) return "/dev/stdout";  // one of them is closed
    standard_output = "/dev/fd/" + std::to_string(kept);
  }
  return standard_output;
}

std::string name_of_output(const std::string& path) {
  return !path.empty() && path == standard_output ? "standard output" : path;
}

Progress terminal_progress(const std::string& label) {
  const bool shown = isatty(STDERR_FILENO) != 0;
  return [label, shown, most = 0.0](double share) mutable {
    if (shown) {
      most = std::max(most, share);  // what is looked at twice is no step back
      std::fprintf(stderr, "\r%s %3.0f %%", label.c_str(), 100.0 * most);
      letters_of_progress = letters_of(label) + 6;
      if (share >= 1.0) wipe_progress();
      std::fflush(stderr);
    }
    return !interrupted();
  };
}

Progress until_interrupted() {
  return [](double) { return !interrupted(); };
}

void catch_interrupts(const std::string& command) {
  interrupted_command = command;
  std::signal(SIGINT, [](int) {
    interrupt_seen = 1;
    std::signal(SIGINT, SIG_DFL);  // a second one ends what does not listen
  });
}

bool interrupted() { return interrupt_seen != 0; }

}  // namespace odolab
