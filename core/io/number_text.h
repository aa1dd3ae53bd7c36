// Numbers as text, exactly: what is written reads back to the same bits, in every locale.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "core/vehicle/key_words.h"

namespace odolab {

// Stands for a number that is not there: an empty cell.
inline constexpr double kEmpty = std::numeric_limits<double>::quiet_NaN();

// Without blanks, tabs and carriage returns at both ends.
std::string_view trimmed(std::string_view text);

// The whole of a trimmed text as a finite number; a leading '+' is allowed. Nothing where it is none.
std::optional<double> number_from(std::string_view text);

// A cell with one comma, and no point, that is to be read as a decimal point; `buffer` holds it where there is one.
std::string_view with_decimal_point(std::string_view cell, std::string& buffer);

// Whether a cell stands for no number, in the words that programs have for it: nothing, NaN, NA, #N/A, null, None.
bool says_nothing(std::string_view cell);

// Appends the shortest text that reads back to the same bits. The value is finite.
void append_number(std::string& text, double value);
std::string number_text(double value);

// The same with a decimal point whatever the value, for readers that tell numbers from counts or texts by it.
std::string decimal_text(double value);

// As printf writes it, for people: "%.2f".
std::string number_text(const char* format, double value);

// A piece of foreign text made fit for one line of an error message: 40 letters at most, '?' for each that a terminal
// obeys or cannot show.
std::string printable(std::string_view text);
// The same in quotes.
std::string in_quotes(std::string_view text);

}  // namespace odolab
