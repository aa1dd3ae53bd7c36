#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>

#include "app/cli/command.h"
#include "app/cli/terminal.h"
#include "core/base/nearest_word.h"

namespace odolab {

namespace {

std::vector<Command> commands() {
  return {gui_command(),     run_command(),    calibrate_command(), diagnose_command(),
          predict_command(), import_command(), export_command(),    reproduce_command()};
}

// Whether a word is a number of that kind, in the words of all other bad input.
template <typename Number>
CLI::Validator number_as(const char* expected) {
  const auto problem = [expected](const std::string& word) -> std::string {
    Number number{};
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (fault == std::errc() && end == word.data() + word.size()) return "";
    return "found '" + word + "', expected " + expected;
  };
  return {problem, ""};
}

class CliArguments : public Arguments {
 public:
  explicit CliArguments(CLI::App& app) : app_(app) {}

  void file(const std::string& name, std::string& value, const std::string& about) override {
    app_.add_option(name, value, about)->required();
  }
  void files(const std::string& name, std::vector<std::string>& values, const std::string& about,
             bool required) override {
    app_.add_option(name, values, about)->required(required);
  }
  void option(const std::string& name, std::string& value, const std::string& about, bool required) override {
    app_.add_option(name, value, about)->required(required);
  }
  void output(const std::string& name, std::string& value, const std::string& about, bool required) override {
    app_.add_option(name, value, about + "; - for standard output")
        ->required(required)
        ->transform([](std::string path) {
          return path == "-" || path == "/dev/stdout" ? standard_output_for_a_file() : path;
        });
  }
  void option(const std::string& name, int& value, const std::string& about) override {
    app_.add_option(name, value, about)->check(number_as<int>("a whole number"));
  }
  void option(const std::string& name, double& value, const std::string& about) override {
    app_.add_option(name, value, about)->check(number_as<double>("a number"));
  }
  void flag(const std::string& name, bool& value, const std::string& about) override {
    app_.add_flag(name, value, about);
  }

 private:
  CLI::App& app_;
};

// What is wrong with the command line. What is not known comes before what is missing: it may be the same, misspelt.
std::string in_words(const CLI::ParseError& error, const CLI::App& app, const std::vector<CLI::App*>& subcommands) {
  for (const CLI::App* sub : subcommands) {
    if (!sub->parsed()) continue;
    const std::string command = "odolab " + sub->get_name();
    for (const std::string& word : sub->remaining())
      if (word.rfind("-", 0) == 0) return command + ": no option " + word + "; see " + command + " --help";
    for (const CLI::Option* option : sub->get_options())
      if (option->get_positional() && option->get_items_expected_max() == 1 && !sub->remaining().empty())
        return command + ": found " + sub->remaining().front() + " besides " + option->results().front() +
               ", expected one " + option->get_name() + "; see " + command + " --help";
    return command + ": " + error.what() + "; see " + command + " --help";
  }
  std::vector<std::string> names;
  for (const CLI::App* sub : subcommands) names.push_back(sub->get_name());
  for (const std::string& word : app.remaining())
    if (const std::string* meant = nearest_word(word, names))
      return "odolab: no command " + word + "; the nearest is " + *meant + "; see odolab --help";
  return "odolab: " + std::string(error.what()) + "; see odolab --help";
}

}  // namespace

int run_command_line(int argc, char** argv) {
  CLI::App app{"OdoLab: odometry of wheeled robots, simulated, calibrated and explained", "odolab"};
  app.require_subcommand(0, 1);
  app.set_version_flag("--version", "odolab " ODOLAB_VERSION);
  app.footer(
      "Exit codes: 0 done, 1 a check failed, 2 bad usage or bad input, 130 stopped by Ctrl-C.\n"
      "odolab COMMAND --help shows an example of each.");
  const std::vector<Command> list = commands();
  std::vector<CLI::App*> subcommands;
  for (const Command& command : list) {
    CLI::App* sub = app.add_subcommand(command.name, command.about);
    sub->footer("Example:\n  " + command.example + (command.files.empty() ? "" : "\n\n" + command.files));
    CliArguments arguments(*sub);
    command.declare(arguments);
    subcommands.push_back(sub);
  }
  std::vector<std::string> words(argv + 1, argv + argc);
  if (!words.empty() && words.front() == "help") {  // `odolab help diagnose` as `odolab diagnose --help`
    words.erase(words.begin());
    words.emplace_back("--help");
  }
  std::reverse(words.begin(), words.end());  // as the parser wants them
  try {
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    print_error(in_words(error, app, subcommands));
    return kBadInput;
  }
  for (std::size_t i = 0; i < list.size(); ++i)
    if (subcommands[i]->parsed()) {
      catch_interrupts(list[i].name);
      return list[i].execute();
    }
  catch_interrupts(list.front().name);
  return list.front().execute();
}

}  // namespace odolab
