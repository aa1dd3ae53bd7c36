// Where the marks of an axis stand: at round numbers.
#pragma once

#include <string>
#include <vector>

namespace odolab::ui {

// Distance of marks, 1, 2 or 5 times a power of ten, so that a span has at most `most` of them. The span is above 0.
double round_step(double span, int most);

// All multiples of a step inside [low, high].
std::vector<double> ticks_every(double step, double low, double high);

// The same for the round step of which at most `most` lie in the span.
std::vector<double> round_ticks(double low, double high, int most);

// A tick's number with as many decimals as its step needs.
std::string tick_text(double value, double step);

}  // namespace odolab::ui
