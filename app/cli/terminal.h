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
// Prints the error and gives back the exit code for bad input.
int bad_input(const Error& error);

// printf into a string.
std::string text_of(const char* format, ...) __attribute__((format(printf, 1, 2)));

// A table on standard output, columns aligned; the first one to the left, the others to the right.
void print_table(const std::vector<std::vector<std::string>>& rows);

// Shows the share done on a terminal and nothing in a pipe; says stop after an interrupt.
Progress terminal_progress(const std::string& label);

// Ctrl-C lets the work in hand end cleanly.
void catch_interrupts();
bool interrupted();

}  // namespace odolab
