#include "core/calibration/unfiltered_truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "core/base/formatted.h"
#include "core/base/parallel.h"
#include "core/base/quantile.h"
#include "core/calibration/calibrated_by_all.h"

namespace odolab {

namespace {

// From one sample of the truth's position to the next, of all recordings.
std::vector<double> truth_periods_s(const std::vector<Recording>& recordings) {
  std::vector<double> periods;
  for (const Recording& r : recordings) {
    const Channel* x = r.channel("truth_x_m");
    double last_s = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; x && i < r.time_s.size(); ++i) {
      if (std::isnan(x->values[i])) continue;
      if (r.time_s[i] > last_s) periods.push_back(r.time_s[i] - last_s);
      last_s = r.time_s[i];
    }
  }
  return periods;
}

// The beginning of each, so that all together have about so many samples of the truth.
std::vector<Recording> beginnings(const std::vector<Recording>& recordings, std::size_t samples, std::size_t of_all) {
  const double share =
      std::min(1.0, static_cast<double>(samples) / static_cast<double>(std::max<std::size_t>(1, of_all)));
  std::vector<Recording> shorter;
  for (const Recording& r : recordings) {
    const double until_s = r.time_s.front() + share * (r.time_s.back() - r.time_s.front());
    const auto rows = std::upper_bound(r.time_s.begin(), r.time_s.end(), until_s) - r.time_s.begin();
    shorter.push_back({r.name, r.provenance, {r.time_s.begin(), r.time_s.begin() + rows}, {}});
    for (const Channel& c : r.channels)
      shorter.back().channels.push_back({c.name, {c.values.begin(), c.values.begin() + rows}});
  }
  return shorter;
}

double per_innovation(const LeastSquaresCalibration& fit) {
  return fit.minus_two_log_likelihood / std::max(1, fit.innovations);
}

bool is_white(const LeastSquaresCalibration& c) {
  constexpr double kNext = 0.25, kLasting = 0.06;
  return std::max({std::abs(c.correlation[0]), std::abs(c.correlation[1]), std::abs(c.correlation[2])}) < kNext &&
         c.lasting_correlation < kLasting;
}

struct TriedFilter {
  TruthFilter filter;
  double minus_two_log_likelihood = std::numeric_limits<double>::infinity();  // of each innovation, as recorded
  std::optional<LeastSquaresCalibration> fit;
};

// The least of a parabola through the value here and those to either side; nothing at an end.
std::optional<double> summit_about(const std::map<double, double>& values, double here) {
  const auto at = values.find(here);
  if (at == values.end() || at == values.begin() || std::next(at) == values.end()) return std::nullopt;
  const auto [x0, y0] = *std::prev(at);
  const auto [x1, y1] = *at;
  const auto [x2, y2] = *std::next(at);
  const double left = (y1 - y0) / (x1 - x0), right = (y2 - y1) / (x2 - x1);
  if (!(right > left)) return std::nullopt;
  const double summit = 0.5 * (x0 + x1) - left * 0.5 * (x2 - x0) / (right - left);
  return std::clamp(summit, x0, x2);
}

class FilterSearch {
 public:
  FilterSearch(const std::vector<Recording>& recordings, const Vehicle& nominal, const LeastSquaresOptions& options)
      : recordings_(recordings), nominal_(nominal), options_(options), periods_s_(truth_periods_s(recordings)) {}

  // What it takes to look about among these: calibrations by no more than so many samples.
  static constexpr std::size_t kSamples = 2500;
  bool is_long() const { return periods_s_.size() > kSamples; }

  bool has_samples() const {
    constexpr std::size_t kFewest = 100;
    return periods_s_.size() > kFewest;
  }
  std::size_t samples() const { return periods_s_.size(); }
  double period_s() const { return quantile(periods_s_, 0.5); }

  // -2 log L of each innovation by the samples as they are; unset where nothing can be fitted.
  std::optional<double> as_recorded() const {
    const Result<LeastSquaresCalibration> fit = calibrated_by_all(recordings_, nominal_, options_, {});
    if (!fit) return std::nullopt;
    return per_innovation(*fit);
  }

  // The likeliest of these time constants, of ever closer ones, and at last where a parabola through the three about
  // the likeliest has its summit.
  TriedFilter likeliest(TruthFilter::Kind kind, const std::vector<double>& time_constants_s,
                        double first_factor = 1.4142) const {
    constexpr double kClose = 1.05;
    constexpr int kParabolas = 2;
    TriedFilter best;
    std::map<double, double> by_log_of_time;
    const auto look = [&](const std::vector<double>& all_s) {
      std::vector<TriedFilter> tried(all_s.size());
      parallel_for(static_cast<int>(tried.size()), [&](int k) {
        const auto at = static_cast<std::size_t>(k);
        tried[at] = with({kind, all_s[at]});
      });
      for (TriedFilter& t : tried) {
        if (!t.fit) continue;
        by_log_of_time[std::log(t.filter.time_constant_s)] = t.minus_two_log_likelihood;
        if (t.minus_two_log_likelihood < best.minus_two_log_likelihood) best = std::move(t);
      }
    };
    look(time_constants_s);
    for (double factor = first_factor; best.fit && factor > kClose; factor = std::sqrt(factor))
      look({best.filter.time_constant_s / factor, best.filter.time_constant_s * factor});
    for (int k = 0; best.fit && k < kParabolas; ++k)
      if (const std::optional<double> summit = summit_about(by_log_of_time, std::log(best.filter.time_constant_s)))
        look({std::exp(*summit)});
    return best;
  }

 private:
  TriedFilter with(const TruthFilter& filter) const {
    TriedFilter tried;
    tried.filter = filter;
    std::vector<Recording> measured;
    for (const Recording& r : recordings_) measured.push_back(unfiltered_truth(r, filter));
    Result<LeastSquaresCalibration> fit = calibrated_by_all(measured, nominal_, options_, {});
    if (!fit) return tried;
    double spread = 0.0;
    for (const double dt_s : periods_s_) spread += std::log(spread_of_measured(filter, dt_s));
    tried.minus_two_log_likelihood = per_innovation(*fit) - 2.0 * spread / static_cast<double>(periods_s_.size());
    tried.fit = std::move(*fit);
    return tried;
  }

  const std::vector<Recording>& recordings_;
  const Vehicle& nominal_;
  const LeastSquaresOptions& options_;
  std::vector<double> periods_s_;
};

}  // namespace

std::string filter_in_words(const TruthFilter& filter) {
  const char* how = filter.kind == TruthFilter::Kind::low_pass ? "a low pass of first order"
                    : filter.kind == TruthFilter::Kind::low_pass_twice
                        ? "a low pass of second order"
                        : "one that carries the pose on at the speed so far";
  return formatted(
      "the truth was filtered before it was recorded, by %s over %.2g s: it is judged by what had been "
      "measured",
      how, filter.time_constant_s);
}

std::optional<LeastSquaresCalibration> calibrated_unfiltered(const LeastSquaresCalibration& as_it_is,
                                                             const std::vector<Recording>& recordings,
                                                             const Vehicle& nominal, const LeastSquaresOptions& options,
                                                             const Progress& progress) {
  constexpr std::array<double, 7> kPeriods = {1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0};
  constexpr double kLongest_s = 5.0, kLikelier = 50.0;
  // For each innovation, than by the low pass: noise that lasts by itself is whitened as well by another, and is no
  // likelier then (0.016 at most; such filters by 0.14 to 0.5).
  constexpr double kPlainly = 0.05;
  constexpr double kCloserByAll = 1.06;  // one look to either side, and the parabolas
  const FilterSearch by_all(recordings, nominal, options);
  if (!by_all.has_samples()) return std::nullopt;
  const std::vector<Recording> some =
      by_all.is_long() ? beginnings(recordings, FilterSearch::kSamples, by_all.samples()) : recordings;
  const FilterSearch search(some, nominal, options);
  const std::optional<double> as_recorded = by_all.is_long() ? search.as_recorded() : per_innovation(as_it_is);
  std::vector<double> time_constants_s;
  for (const double periods : kPeriods)
    if (periods * search.period_s() <= kLongest_s) time_constants_s.push_back(periods * search.period_s());
  const auto is_likelier = [&](const TriedFilter& t) {
    return as_recorded && t.fit && (*as_recorded - t.minus_two_log_likelihood) * t.fit->innovations > kLikelier;
  };
  const auto accepted = [&](TriedFilter& t) -> std::optional<LeastSquaresCalibration> {
    if (!is_likelier(t) || !is_white(*t.fit)) return std::nullopt;
    if (by_all.is_long()) t = by_all.likeliest(t.filter.kind, {t.filter.time_constant_s}, kCloserByAll);
    if (!t.fit || !is_white(*t.fit)) return std::nullopt;
    t.fit->truth_filter = t.filter;
    t.fit->warnings.push_back(filter_in_words(t.filter));
    return std::move(t.fit);
  };
  TriedFilter once = search.likeliest(TruthFilter::Kind::low_pass, time_constants_s);
  if (!goes_on(progress, 0.5) || !is_likelier(once)) return std::nullopt;
  const double about_s = once.filter.time_constant_s, by_low_pass = once.minus_two_log_likelihood;
  if (auto fit = accepted(once)) return fit;
  for (const auto kind : {TruthFilter::Kind::constant_velocity, TruthFilter::Kind::low_pass_twice}) {
    TriedFilter other = search.likeliest(kind, {0.5 * about_s, about_s, 2.0 * about_s});
    if (!goes_on(progress, 1.0)) return std::nullopt;
    if (other.minus_two_log_likelihood > by_low_pass - kPlainly) continue;
    if (auto fit = accepted(other)) return fit;
  }
  return std::nullopt;
}

}  // namespace odolab
