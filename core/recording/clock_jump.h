// Stamps of a clock that was set while it was read.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace odolab {

// A log may pause for hours; a clock that gets its date after the start jumps by years.
inline constexpr double kLongestPause_s = 86400.0;
inline constexpr char kRowsOfOneClock[] = "rows a day apart at most, by one clock that nobody sets meanwhile";

// From one row to the next, usually, where rows are so far apart that their stamps are hardly seconds. Of twenty rows
// and more.
std::optional<double> far_apart_s(const std::vector<double>& time_s);

// The first row that stands more than `kLongestPause_s` behind the one before it. Nothing where all are so far apart
// that their stamps are hardly seconds. `time_s` never decreases.
std::optional<std::size_t> first_after_jump(const std::vector<double>& time_s);

// The same of times that come one by one.
class JumpWatch {
 public:
  bool add(double time_s);    // whether it is the first behind a jump
  bool is_one_clock() const;  // by all that were added

 private:
  bool has_jumped_ = false;
  std::size_t rows_ = 0, steps_ = 0, far_steps_ = 0;
  double last_s_ = 0.0;
};

}  // namespace odolab
