// What a command of the program is: its words, its arguments and what it does.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace odolab {

// Exit codes that scripts rely on.
inline constexpr int kDone = 0;
inline constexpr int kCheckFailed = 1;
inline constexpr int kBadInput = 2;
inline constexpr int kStopped = 130;  // by Ctrl-C, as a shell says it

// Where a command declares what it can be given; values are set when the command line is read.
class Arguments {
 public:
  virtual ~Arguments() = default;
  virtual void file(const std::string& name, std::string& value, const std::string& about) = 0;  // required
  virtual void files(const std::string& name, std::vector<std::string>& values, const std::string& about,
                     bool required) = 0;
  virtual void option(const std::string& name, std::string& value, const std::string& about, bool required = false) = 0;
  // A file to write; "-" is standard output, and what else is printed there goes to standard error then.
  virtual void output(const std::string& name, std::string& value, const std::string& about, bool required = false) = 0;
  virtual void option(const std::string& name, int& value, const std::string& about) = 0;
  virtual void option(const std::string& name, double& value, const std::string& about) = 0;
  virtual void flag(const std::string& name, bool& value, const std::string& about) = 0;
};

struct Command {
  std::string name;
  std::string about;    // one sentence
  std::string example;  // a whole command line
  std::string files;    // what the files in it look like; empty where they need no word
  std::function<void(Arguments&)> declare;
  std::function<int()> execute;  // returns an exit code
};

// The commands, one file each.
Command gui_command();
Command run_command();
Command calibrate_command();
Command diagnose_command();
Command predict_command();
Command import_command();
Command export_command();
Command reproduce_command();

// Reads the command line and does what it says. Without arguments the window opens.
int run_command_line(int argc, char** argv);

}  // namespace odolab
