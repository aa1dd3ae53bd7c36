// What a command says to the person at the terminal: results on standard output, messages and progress on standard
// error.
#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"

namespace odolab {

void print_error(const std::string& line);
void print_message(const std::string& line);
// Prints the error and gives back the exit code for bad input. After an interrupt the error is that work was stopped,
// whatever it says of itself: then as stopped_before_its_end().
int bad_input(const Error& error);

// printf into a string.
std::string text_of(const char* format, ...) __attribute__((format(printf, 1, 2)));

// A table on standard output, columns aligned; the first one to the left, the others to the right.
void print_table(const std::vector<std::vector<std::string>>& rows);

// A path that stands for standard output. From here on all else that is printed goes to standard error, so that nothing
// is mixed into the file.
std::string standard_output_for_a_file();
// What a person calls an output: its path, or "standard output".
std::string name_of_output(const std::string& path);

// Shows the share done on a terminal and nothing in a pipe; says stop after an interrupt.
Progress terminal_progress(const std::string& label);

// Says stop after an interrupt, and shows nothing.
Progress until_interrupted();

// Ctrl-C lets the work in hand end cleanly. `command` is what was stopped then.
void catch_interrupts(const std::string& command);
bool interrupted();
// Prints that the command was stopped before anything was written, and gives back the exit code for it.
int stopped_before_its_end();

}  // namespace odolab
