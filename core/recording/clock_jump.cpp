#include "core/recording/clock_jump.h"

#include "core/base/quantile.h"

namespace odolab {

namespace {

constexpr std::size_t kFewest = 20;
constexpr double kTooFarApart_s = 3.0;

}  // namespace

std::optional<double> far_apart_s(const std::vector<double>& time_s) {
  if (time_s.size() < kFewest) return std::nullopt;
  std::vector<double> apart_s;
  for (std::size_t i = 1; i < time_s.size(); ++i)
    if (const double by_s = time_s[i] - time_s[i - 1]; by_s > 0.0) apart_s.push_back(by_s);
  const double usual_s = median(std::move(apart_s));
  return usual_s < kTooFarApart_s ? std::nullopt : std::optional(usual_s);
}

std::optional<std::size_t> first_after_jump(const std::vector<double>& time_s) {
  for (std::size_t i = 1; i < time_s.size(); ++i)
    if (time_s[i] - time_s[i - 1] > kLongestPause_s) return far_apart_s(time_s) ? std::nullopt : std::optional(i);
  return std::nullopt;
}

bool JumpWatch::add(double time_s) {
  const double step_s = rows_++ > 0 ? time_s - last_s_ : 0.0;
  last_s_ = time_s;
  if (step_s > 0.0) ++steps_;
  if (step_s >= kTooFarApart_s) ++far_steps_;
  if (step_s <= kLongestPause_s || has_jumped_) return false;
  return has_jumped_ = true;
}

bool JumpWatch::is_one_clock() const { return !has_jumped_ || (rows_ >= kFewest && 2 * far_steps_ > steps_); }

}  // namespace odolab
