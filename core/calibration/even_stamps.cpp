#include "core/calibration/even_stamps.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "core/base/quantile.h"
#include "core/base/stamp_digits.h"
#include "core/calibration/numbered_rows.h"

namespace odolab {

namespace {

using Series = std::vector<double>;

constexpr int kLeastRows = 100;    // in all
constexpr int kLeastStretch = 30;  // rows that a line is laid through
constexpr int kLook = 20;          // rows on either side of a missing one, or so many that ticks of a clock are
constexpr double kKnots_s = 5.0;   // so slowly may the sampling's own clock wander
constexpr double kEven = 0.001;    // of a period: rounded stamps
constexpr double kStandardErrors = 4.0;
constexpr double kMatters = 0.5;  // of the readings' own roughness: what lateness adds below that is one part in ten

// Periods by so many rows at a time that packets do not hide them.
Series periods_of(const Series& time_s, int look) {
  Series periods;
  const auto rows = static_cast<std::size_t>(look);
  for (std::size_t i = rows; i < time_s.size(); ++i) periods.push_back((time_s[i] - time_s[i - rows]) / look);
  return periods;
}

// The typical one. Of stamps that are rounded to a grain the mean of those that are a grain off the middle one at most,
// since between two grains there is none.
double typical_period_s(const Series& periods, int look, double grain_s) {
  const double middle_s = quantile(periods, 0.5), most_s = 1.01 * grain_s / look;
  if (grain_s == 0.0) return middle_s;
  double sum_s = 0.0, count = 0.0;
  for (const double period_s : periods)
    if (std::abs(period_s - middle_s) <= most_s) sum_s += period_s, count += 1.0;
  return count > 0.0 ? sum_s / count : middle_s;
}

// Ends of the stretches in which no row is missing. Lateness has a least value: the lower fifth of the rows before and
// behind shows a step of the phase far better than their mean does.
std::vector<int> ends_of_stretches(const Series& time_s, double period_s, int look) {
  const int n = static_cast<int>(time_s.size());
  Series early;  // of so many rows behind each, without those of the period
  for (int i = 0; i + look <= n; ++i) {
    Series late;
    for (int k = 0; k < look; ++k) late.push_back(time_s[i + k] - time_s[0] - period_s * k);
    early.push_back(quantile(std::move(late), 0.2));
  }
  Series step(time_s.size(), 0.0);
  for (int i = look; i + look <= n; ++i) step[i] = early[i] - early[i - look] - period_s * look;
  const double limit = std::max(0.4 * period_s, 5.0 * scatter_about_zero(step));
  std::vector<int> ends;
  for (int i = 1; i < n; ++i) {
    // A step shows for some rows around it; it lies where the gap is least like a period.
    int at = i;
    const bool gap = time_s[i] - time_s[i - 1] > kPausePeriods * period_s;
    if (gap) {
      ends.push_back(i);
      continue;
    }
    if (std::abs(step[i]) <= limit) continue;
    const auto unlike = [&](int k) { return std::abs(time_s[k] - time_s[k - 1] - period_s); };
    while (i < n && std::abs(step[i]) > limit) {
      if (unlike(i) > unlike(at)) at = i;
      ++i;
    }
    ends.push_back(at);
  }
  ends.push_back(n);
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

// Of rows whose numbers are told only where readings pause: missing ones are counted.
std::vector<int> ends_of_told(const std::vector<int>& numbers) {
  std::vector<int> ends;
  for (std::size_t i = 1; i < numbers.size(); ++i)
    if (numbers[i] - numbers[i - 1] >= kPausePeriods) ends.push_back(static_cast<int>(i));
  ends.push_back(static_cast<int>(numbers.size()));
  return ends;
}

// Stamps against their number: straight lines between knots, by least squares with Huber's weights.
void lay_line(const Series& time_s, const std::vector<int>& numbers, int from, int to, double period_s, Series& even) {
  const int n = to - from;
  const double all = numbers[to - 1] - numbers[from];
  const int spans = std::max(1, static_cast<int>(std::lround(all * period_s / kKnots_s)));
  const double rows = all / spans;
  const auto number = [&](int i) { return static_cast<double>(numbers[from + i] - numbers[from]); };
  Series late(n), weight(n, 1.0), knots(spans + 1, 0.0);
  for (int i = 0; i < n; ++i) late[i] = time_s[from + i] - time_s[from] - period_s * number(i);
  const auto span_of = [&](int i) { return std::min(spans - 1, static_cast<int>(number(i) / rows)); };
  for (int pass = 0; pass < 6; ++pass) {
    Series diagonal(spans + 1, 1e-12), beside(spans + 1, 0.0), right(spans + 1, 0.0);
    for (int i = 0; i < n; ++i) {
      const int k = span_of(i);
      const double u = number(i) / rows - k;
      diagonal[k] += weight[i] * (1.0 - u) * (1.0 - u);
      diagonal[k + 1] += weight[i] * u * u;
      beside[k] += weight[i] * u * (1.0 - u);
      right[k] += weight[i] * (1.0 - u) * late[i];
      right[k + 1] += weight[i] * u * late[i];
    }
    for (int k = 1; k <= spans; ++k) {
      const double share = beside[k - 1] / diagonal[k - 1];
      diagonal[k] -= share * beside[k - 1];
      right[k] -= share * right[k - 1];
    }
    for (int k = spans; k >= 0; --k) knots[k] = (right[k] - (k < spans ? beside[k] * knots[k + 1] : 0.0)) / diagonal[k];
    Series off(n);
    for (int i = 0; i < n; ++i) {
      const int k = span_of(i);
      const double u = number(i) / rows - k;
      off[i] = late[i] - (1.0 - u) * knots[k] - u * knots[k + 1];
      even[from + i] = time_s[from + i] - off[i];
    }
    const double scale = 2.0 * scatter_about_zero(off);
    for (int i = 0; i < n; ++i) weight[i] = std::abs(off[i]) > scale && scale > 0.0 ? scale / std::abs(off[i]) : 1.0;
  }
}

// Rows that share a stamp, but for what trembles, as where a clock ticks more slowly than rows are taken; 1 where few
// do.
double rows_of_a_tick(const Series& time_s, double period_s) {
  constexpr double kSame = 0.1;  // of a period
  double ticks = 1.0;
  for (std::size_t i = 1; i < time_s.size(); ++i) ticks += time_s[i] - time_s[i - 1] > kSame * period_s ? 1.0 : 0.0;
  return static_cast<double>(time_s.size()) / ticks;
}

// What stamps are rounded to, the coarsest that all of them are multiples of; 0 where there is none.
double grain_of(const Series& time_s) {
  for (const double grain_s : {0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001})
    if (std::all_of(time_s.begin(), time_s.end(),
                    [&](double t) { return std::abs(t - grain_s * std::round(t / grain_s)) < kStampDigits_s; }))
      return grain_s;
  return 0.0;
}

// Rounded stamps of one even period, which lie within half a grain of a straight line: then that is what they are, and
// lines between knots would follow the rounding where it changes its pattern. False where they are not.
bool lay_straight(const Series& time_s, const std::vector<int>& numbers, int from, int to, double period_s,
                  double grain_s, Series& even) {
  constexpr double kTolerance_s = 1e-5;
  double earliest = -1e300, latest = 1e300;  // that the first may be
  for (int i = from; i < to; ++i) {
    const double start_s = time_s[i] - period_s * (numbers[i] - numbers[from]);
    earliest = std::max(earliest, start_s - 0.5 * grain_s);
    latest = std::min(latest, start_s + 0.5 * grain_s);
  }
  if (!(grain_s > 0.0) || earliest > latest + kTolerance_s) return false;
  for (int i = from; i < to; ++i) even[i] = 0.5 * (earliest + latest) + period_s * (numbers[i] - numbers[from]);
  return true;
}

// The share of the lateness that a path shows, Eq. 13.
struct Share {
  double value = 1.0, stderr_value = 1e9;
  double size = 0.0;  // of the lateness, in times the path's own roughness
};

Share share_of(const Series& shown, const Series& lateness) {
  Share share;
  std::vector<char> used(shown.size(), 1);
  for (int pass = 0; pass < 4; ++pass) {
    double xy = 0.0, xx = 0.0, n = 0.0, ee = 0.0;
    for (std::size_t i = 0; i < shown.size(); ++i)
      if (used[i]) {
        xy += lateness[i] * shown[i];
        xx += lateness[i] * lateness[i];
        n += 1.0;
      }
    if (n < kLeastRows || !(xx > 0.0)) return {};
    share.value = xy / xx;
    Series left(shown.size());
    for (std::size_t i = 0; i < shown.size(); ++i) {
      left[i] = shown[i] - share.value * lateness[i];
      if (used[i]) ee += left[i] * left[i];
    }
    // Third differences of white noise are correlated by -15/20, 6/20 and -1/20 in both: 1 + 2 (sum of their squares).
    constexpr double kOverlap = 2.31;
    share.stderr_value = std::sqrt(kOverlap * ee / n / xx);
    share.size = ee > 0.0 ? std::sqrt(xx / ee) : 1e9;
    const double limit = 6.0 * scatter_about_zero(left);
    if (limit > 0.0)
      for (std::size_t i = 0; i < shown.size(); ++i) used[i] = std::abs(left[i]) <= limit;
  }
  return share;
}

// Whether no stamp is further off the line from the first to the last than what counts as even.
bool are_even(const Series& time_s) {
  const double period_s = (time_s.back() - time_s.front()) / static_cast<double>(time_s.size() - 1);
  for (std::size_t i = 0; i < time_s.size(); ++i)
    if (std::abs(time_s[i] - time_s.front() - period_s * static_cast<double>(i)) >= kEven * period_s) return false;
  return true;
}

}  // namespace

std::optional<EvenStamps> even_stamps(const Series& time_s, const std::vector<Series>& paths, bool together) {
  const int n = static_cast<int>(time_s.size());
  if (n < kLeastRows || are_even(time_s)) return std::nullopt;
  EvenStamps even;
  const double grain_s = grain_of(time_s);
  const double of_a_tick = rows_of_a_tick(time_s, typical_period_s(periods_of(time_s, kLook), kLook, grain_s));
  const int look = std::clamp(static_cast<int>(10.0 * of_a_tick), kLook, n / 4);
  const Series periods = periods_of(time_s, look);
  even.period_s = typical_period_s(periods, look, grain_s);
  if (!(even.period_s > 0.0)) return std::nullopt;
  even.time_s = time_s;
  const double round_s = quantile(periods, 0.5);  // where what stamps are rounded by cancels in so many rows
  std::vector<int> numbers = told_numbers(time_s, even.period_s);
  const bool told = !numbers.empty();
  const std::vector<int> ends = told ? ends_of_told(numbers) : ends_of_stretches(time_s, even.period_s, look);
  if (!told) {
    numbers.resize(time_s.size());
    std::iota(numbers.begin(), numbers.end(), 0);
  }
  std::vector<int> stretch(time_s.size(), -1);  // without a missing row
  int from = 0, laid = 0, blocks = 0, wandering = 0;
  for (const int end : ends) {
    if (end - from >= kLeastStretch) {
      const double own_s = (time_s[end - 1] - time_s[from]) / (numbers[end - 1] - numbers[from]);
      if (!lay_straight(time_s, numbers, from, end, round_s, grain_s, even.time_s) &&
          !lay_straight(time_s, numbers, from, end, even.period_s, grain_s, even.time_s) &&
          !lay_straight(time_s, numbers, from, end, own_s, grain_s, even.time_s))
        lay_line(time_s, numbers, from, end, even.period_s, even.time_s);
      for (int i = from; i < end; ++i) stretch[i] = i > from && numbers[i] - numbers[i - 1] == 1 ? stretch[i - 1] : i;
      laid += end - from;
      // Where whole blocks stay off the line, further than stamps tremble within, the readings were not taken at one
      // period: those of an encoder that speaks at each count, for one.
      for (int i = from; i + look <= end; i += look, ++blocks) {
        Series off;
        for (int k = i; k < i + look; ++k) off.push_back(time_s[k] - even.time_s[k]);
        const double middle_s = quantile(off, 0.5);
        for (double& by : off) by -= middle_s;
        wandering += std::abs(middle_s) > std::max(0.6 * even.period_s, scatter_about_zero(std::move(off)));
      }
    }
    from = end;
  }
  if (laid < 0.8 * n || wandering > 0.05 * blocks) return std::nullopt;
  double squares = 0.0;
  Series lateness(time_s.size());
  for (int i = 0; i < n; ++i) {
    lateness[i] = time_s[i] - even.time_s[i];
    squares += lateness[i] * lateness[i];
  }
  even.trembling_s = std::sqrt(squares / laid);
  if (even.trembling_s < kEven * even.period_s) return std::nullopt;

  // What the paths show of it.
  constexpr int kReach = 5;
  const auto third = [](const Series& v, int i) { return v[i + 3] - v[i] - 3.0 * (v[i + 2] - v[i + 1]); };
  Series thirds;
  for (int i = 0; i + 3 < n; ++i)
    if (stretch[i] >= 0 && stretch[i] == stretch[i + 3]) thirds.push_back(third(lateness, i));
  for (double& by : thirds) by = std::abs(by);
  // Rows of one tick are late by their number, of which third differences see nothing: they show where it ends.
  const double stalls = 8.0 * quantile(std::move(thirds), of_a_tick < 2.0 ? 0.5 : 0.9);
  Series shown, late;
  bool any = false;
  const auto judged = [&] {
    const Share share = share_of(shown, late);
    shown.clear();
    late.clear();
    if (share.value + kStandardErrors * share.stderr_value < 0.5 && share.size > kMatters) any = true;
    return share.value < 0.5 || share.stderr_value > 0.2;  // nothing speaks against it
  };
  for (const Series& path : paths) {
    for (int i = kReach; i + 3 + kReach < n; ++i) {
      const int a = i - kReach, b = i + 3 + kReach;
      if (stretch[a] < 0 || stretch[a] != stretch[b]) continue;
      const double by = third(lateness, i);
      if (std::abs(by) > stalls) continue;
      shown.push_back(third(path, i));
      late.push_back((path[b] - path[a]) / (even.time_s[b] - even.time_s[a]) * by);
    }
    if (!together && !judged()) return std::nullopt;
  }
  if (together && !judged()) return std::nullopt;
  if (!any) return std::nullopt;
  for (int i = 1; i < n; ++i) even.time_s[i] = std::max(even.time_s[i], even.time_s[i - 1]);
  return even;
}

}  // namespace odolab
