#include "core/calibration/numbered_rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/quantile.h"

namespace odolab {

namespace {

// The period of stamps with these numbers, by a straight line through each stretch without a pause.
double period_by_lines(const std::vector<double>& time_s, const std::vector<int>& numbers, double otherwise_s) {
  double product = 0.0, square = 0.0;
  for (std::size_t from = 0, end = 1; from < numbers.size(); from = end++) {
    while (end < numbers.size() && numbers[end] - numbers[end - 1] < kPausePeriods) ++end;
    double mean_s = 0.0, mean = 0.0;
    for (std::size_t i = from; i < end; ++i) mean_s += time_s[i] - time_s[from], mean += numbers[i] - numbers[from];
    mean_s /= static_cast<double>(end - from), mean /= static_cast<double>(end - from);
    for (std::size_t i = from; i < end; ++i) {
      const double by = numbers[i] - numbers[from] - mean;
      product += by * (time_s[i] - time_s[from] - mean_s);
      square += by * by;
    }
  }
  return square > 0.0 ? product / square : otherwise_s;
}

// A row that is late by half a period, behind others that were late, seems to have left one out, and the beat follows
// it: where the rows behind are early by a period against those before, none is missing there.
void put_back_what_none_left_out(const std::vector<double>& time_s, double period_s, std::vector<int>& numbers) {
  constexpr std::size_t kLook = 20, kLeast = 5;  // rows on either side without another gap
  constexpr double kEarly = 0.6;                 // periods
  const std::size_t rows = numbers.size();
  const auto is_gap = [&](std::size_t i) { return numbers[i] - numbers[i - 1] > 1; };
  const auto middle_of_late_s = [&](std::size_t from, std::size_t end) {
    std::vector<double> late_s;
    for (std::size_t i = from; i < end; ++i) late_s.push_back(time_s[i] - period_s * numbers[i]);
    return quantile(std::move(late_s), 0.5);
  };
  for (std::size_t i = 1; i < rows; ++i) {
    if (!is_gap(i) || numbers[i] - numbers[i - 1] >= kPausePeriods) continue;
    std::size_t from = i - 1, end = i + 1;
    while (from > 0 && i - from < kLook && !is_gap(from)) --from;
    while (end < rows && end - i < kLook && !is_gap(end)) ++end;
    if (i - from < kLeast || end - i < kLeast) continue;
    const double early = (middle_of_late_s(from, i) - middle_of_late_s(i, end)) / period_s;
    if (early < kEarly) continue;
    const int none = std::min(static_cast<int>(std::lround(early)), numbers[i] - numbers[i - 1] - 1);
    for (std::size_t k = i; k < rows; ++k) numbers[k] -= none;
  }
}

// The rows' numbers, missing ones counted, where stamps tremble by so little about an even beat that nearly each tells
// its own; else nothing. `period_s`, that of many rows and so without packets, is made that of these.
std::vector<int> numbers_told_by_beat(const std::vector<double>& time_s, double& period_s) {
  constexpr double kUnclear = 0.45, kAlike = 0.3, kOfOne = 0.6;  // periods
  constexpr double kFollows = 0.1;                               // of what a stamp is off the beat: slow clocks drift
  constexpr double kMostUnclear = 0.01;                          // of the stamps
  std::vector<double> gaps;
  for (std::size_t i = 1; i < time_s.size(); ++i) gaps.push_back(time_s[i] - time_s[i - 1]);
  const double middle_s = quantile(gaps, 0.5);
  if (std::abs(middle_s - period_s) > kAlike * period_s) return {};
  double near_s = 0.0, near = 0.0;
  for (const double gap_s : gaps)
    if (std::abs(gap_s - middle_s) < kOfOne * middle_s) near_s += gap_s, near += 1.0;
  const double usual_s = near_s / std::max(1.0, near);
  std::vector<int> numbers{0};
  double begin_s = time_s[0], unclear = 0.0;  // when number 0 was by the beat as it is now
  for (std::size_t i = 1; i < time_s.size(); ++i) {
    const int before = numbers.back();
    if (gaps[i - 1] > kPausePeriods * usual_s) {
      numbers.push_back(before + kPausePeriods);
      begin_s = time_s[i] - usual_s * numbers.back();
      continue;
    }
    int number = static_cast<int>(std::lround((time_s[i] - begin_s) / usual_s));
    // Of two that seem to have one number the first was late, if it left one out.
    if (number <= before && i > 1 && numbers[i - 2] < before - 1) numbers.back() = before - 1;
    number = std::max(number, numbers.back() + 1);
    const double off = (time_s[i] - begin_s) / usual_s - number;
    unclear += std::abs(off) > kUnclear ? 1.0 : 0.0;
    begin_s += kFollows * std::clamp(off, -0.5, 0.5) * usual_s;
    numbers.push_back(number);
  }
  if (unclear > kMostUnclear * static_cast<double>(time_s.size())) return {};
  put_back_what_none_left_out(time_s, usual_s, numbers);
  period_s = period_by_lines(time_s, numbers, period_s);
  return numbers;
}

// Rows of one period whose stamps tremble by any part of it: how many are missing before each is the likeliest that the
// steps of their phase leave (Viterbi 1967), of rows that err by `tremble_s` and are missing one in a hundred.
class MissingRows {
 public:
  MissingRows(const std::vector<double>& time_s, double tremble_s) : time_s_(time_s), tremble_s_(tremble_s) {}

  MissingRows without_any() const {
    MissingRows none(time_s_, tremble_s_);
    none.is_missing_ = kNone;
    return none;
  }

  // Twice the least negative log-likelihood of that period; the rows' numbers where these are asked for.
  double cost(double period_s, std::vector<int>* numbers = nullptr) const {
    double sum = 0.0;
    for (std::size_t from = 0, end = 1; from < time_s_.size(); from = end++) {
      while (end < time_s_.size() && time_s_[end] - time_s_[end - 1] <= kPausePeriods * period_s) ++end;
      const int first = numbers && !numbers->empty() ? numbers->back() + kPausePeriods : 0;
      sum += cost_of_stretch(from, end, period_s, first, numbers);
    }
    return sum;
  }

 private:
  static constexpr int kStates = 40, kKept = 8;  // missing rows beyond those that are sure; of these stay in sight
  static constexpr double kMostOff2 = 9.0, kIsMissing = 9.0, kAnother = 0.5, kFollows = 0.05;
  static constexpr double kNone = 1e300;
  struct State {
    double cost = kNone, phase_s = 0.0;
    int before = 0;
  };

  double cost_of_stretch(std::size_t from, std::size_t end, double period_s, int first,
                         std::vector<int>* numbers) const {
    constexpr std::size_t kBegins = 15;
    std::vector<double> phases_s;
    for (std::size_t i = from; i < std::min(end, from + kBegins); ++i)
      phases_s.push_back(time_s_[i] - period_s * static_cast<double>(i - from));
    std::vector<State> now(kStates);
    now[0] = {0.0, quantile(std::move(phases_s), 0.5), 0};
    std::vector<std::vector<int>> before;
    std::vector<int> sure{0};
    for (std::size_t i = from + 1; i < end; ++i) {
      const int best = likeliest(now), shift = best >= kKept ? best - kKept / 2 : 0;
      sure.push_back(sure.back() + shift);
      const double gap_s = time_s_[i] - time_s_[i - 1];
      const int most = std::clamp(static_cast<int>((gap_s + 5.0 * tremble_s_) / period_s), 0, kPausePeriods);
      std::vector<State> next(kStates);
      for (int k = 0; k < kStates; ++k) {
        if (now[k].cost == kNone) continue;
        for (int missing = 0; missing <= (is_missing_ < kNone ? most : 0); ++missing) {
          const int to = k + missing - shift;
          if (to < 0 || to >= kStates) continue;
          const double number = static_cast<double>(i - from) + sure.back() + to;
          const double off = (time_s_[i] - now[k].phase_s - period_s * number) / tremble_s_;
          const double cost = now[k].cost + std::min(off * off, kMostOff2) +
                              (missing > 0 ? is_missing_ + kAnother * (missing - 1) : 0.0);
          if (cost < next[to].cost)
            next[to] = {cost, now[k].phase_s + kFollows * std::clamp(off, -2.0, 2.0) * tremble_s_, k};
        }
      }
      now = std::move(next);
      if (!numbers) continue;
      before.emplace_back();
      for (const State& s : now) before.back().push_back(s.before);
    }
    int k = likeliest(now);
    const double cost = now[k].cost;
    if (!numbers) return cost;
    const std::size_t rows = end - from, at = numbers->size();
    numbers->resize(at + rows);
    for (std::size_t i = rows; i-- > 0;) {
      (*numbers)[at + i] = first + static_cast<int>(i) + sure[i] + k;
      if (i > 0) k = before[i - 1][static_cast<std::size_t>(k)];
    }
    return cost;
  }

  static int likeliest(const std::vector<State>& states) {
    return static_cast<int>(
        std::min_element(states.begin(), states.end(), [](const State& a, const State& b) { return a.cost < b.cost; }) -
        states.begin());
  }

  const std::vector<double>& time_s_;
  double tremble_s_;
  double is_missing_ = kIsMissing;  // what one costs
};

// The same where stamps tremble too much for each to tell its number, but rows that are missing step the phase of all
// behind them; nothing where none is, or where no one period explains the stamps. Missing rows make the typical period
// seem longer: the likeliest near it is sought.
std::vector<int> numbers_told_by_steps(const std::vector<double>& time_s, double& period_s) {
  constexpr double kFrom = 0.98, kTo = 1.004, kStep = 0.002, kFinest = 1e-4;  // of the period
  constexpr double kExplained = 1.5, kDecisively = 100.0;                     // of twice the log-likelihood: a row; all
  std::vector<double> off_s;
  for (std::size_t i = 1; i < time_s.size(); ++i) off_s.push_back(time_s[i] - time_s[i - 1] - period_s);
  double tremble_s = scatter_about_zero(std::move(off_s)) / std::sqrt(2.0);
  if (!(tremble_s > 0.0)) return {};
  const auto rows = static_cast<double>(time_s.size());
  double best_s = period_s, least = 0.0;
  const auto find_best = [&] {
    const MissingRows missing(time_s, tremble_s);
    best_s = period_s;
    least = missing.cost(period_s);
    const auto try_near = [&](double middle_s, double low, double high, double step) {
      for (double times = low; times <= high; times += step)
        if (const double cost = missing.cost(times * middle_s); cost < least) least = cost, best_s = times * middle_s;
    };
    try_near(period_s, kFrom, kTo, kStep);
    for (double step = 0.5 * kStep; step > kFinest; step *= 0.5) try_near(double{best_s}, 1.0 - step, 1.0 + step, step);
  };
  find_best();
  // What arrives late now and then trembles by more than its middle half shows.
  if (least > rows) {
    tremble_s *= std::sqrt(least / rows);
    find_best();
  }
  std::vector<int> numbers;
  MissingRows(time_s, tremble_s).cost(best_s, &numbers);
  const bool any = numbers.back() - numbers.front() > static_cast<int>(time_s.size()) - 1;
  if (!any || least > kExplained * rows) return {};
  if (least > MissingRows(time_s, tremble_s).without_any().cost(best_s) - kDecisively) return {};
  period_s = period_by_lines(time_s, numbers, best_s);
  return numbers;
}

}  // namespace

std::vector<int> told_numbers(const std::vector<double>& time_s, double& period_s) {
  std::vector<int> numbers = numbers_told_by_beat(time_s, period_s);
  if (numbers.empty()) numbers = numbers_told_by_steps(time_s, period_s);
  return numbers;
}

}  // namespace odolab
