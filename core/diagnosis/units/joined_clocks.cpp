#include "core/diagnosis/units/joined_clocks.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/chi_square.h"
#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/naming/select.h"

namespace odolab {

namespace {

struct Mean {
  double rate = 0.0, stderr_rate = 0.0, scatter = 0.0;  // chi-square about the mean
};

Mean mean_of(const std::vector<ClockRate>& rates) {
  Mean mean;
  double weights = 0.0;
  for (const ClockRate& r : rates) {
    const double weight = 1.0 / (r.stderr_rate * r.stderr_rate);
    mean.rate += weight * r.rate, weights += weight;
  }
  mean.rate /= weights;
  mean.stderr_rate = 1.0 / std::sqrt(weights);
  for (const ClockRate& r : rates) mean.scatter += std::pow((r.rate - mean.rate) / r.stderr_rate, 2);
  return mean;
}

bool differ(const std::vector<ClockRate>& rates) {
  return std::any_of(rates.begin(), rates.end(), [&](const ClockRate& r) { return r.rate != rates[0].rate; });
}

double evidence_of(const std::vector<ClockRate>& rates) {
  double sum = 0.0;
  for (const ClockRate& r : rates) sum += std::pow(r.rate / r.stderr_rate, 2);
  return sum;
}

// Of each run.
std::vector<ClockRate> clock_rates(const std::vector<JoinedRun>& runs, const GeometryFit& geometry) {
  constexpr std::ptrdiff_t kFewest = 20;  // truth samples in each half
  Vehicle vehicle = geometry.vehicle;     // as all runs have it, wheels too
  for (std::size_t u = 0; u < geometry.drives.size(); ++u) vehicle = with_drive(vehicle, u, geometry.drives[u]);
  std::vector<std::string> held = {kWheelsHeld};
  for (const JointEstimate& joint : geometry.joints) held.push_back(joint.parameter.name);
  std::vector<ClockRate> rates;
  for (const JoinedRun& run : runs) {
    const std::ptrdiff_t half = std::ssize(run.tracked) / 2;
    if (half < kFewest) return {};
    const auto middle = run.tracked.begin() + half;
    const JoinedRun early{run.samples, Track(run.tracked.begin(), middle)},
        late{run.samples, Track(middle, run.tracked.end())};
    const GeometryFit first = fitted_geometry({early}, vehicle, held), second = fitted_geometry({late}, vehicle, held);
    const auto middle_s = [](const JoinedRun& r) { return 0.5 * (r.tracked.front().time_s + r.tracked.back().time_s); };
    const double apart_s = middle_s(late) - middle_s(early);
    rates.push_back({(first.clock_s[0] - second.clock_s[0]) / apart_s,
                     std::hypot(first.clock_stderr_s[0], second.clock_stderr_s[0]) / apart_s});
    if (!(rates.back().stderr_rate > 0.0)) return {};
  }
  return rates;
}

// All of them or none.
std::vector<ClockRate> beyond_doubt(const std::vector<ClockRate>& rates) {
  constexpr double kByChance = 1e-3;
  if (rates.empty() || evidence_of(rates) < kDecisive) return {};
  const Mean mean = mean_of(rates);
  const int others = static_cast<int>(rates.size()) - 1;
  if (others > 0 && chi_square_tail(mean.scatter, others) < kByChance) return rates;
  if (std::pow(mean.rate / mean.stderr_rate, 2) < kDecisive) return {};
  return std::vector<ClockRate>(rates.size(), {mean.rate, mean.stderr_rate});
}

}  // namespace

void put_right(Track& tracked, double rate) {
  if (tracked.empty()) return;
  const double first_s = tracked.front().time_s;
  for (TimedPose& p : tracked) p.time_s = first_s + (p.time_s - first_s) * (1.0 + rate);
}

std::vector<ClockRate> put_clocks_right(std::vector<JoinedRun>& runs, const Vehicle& nominal, GeometryFit& geometry) {
  constexpr int kRounds = 2;  // the geometry was fitted with clocks that ran apart
  std::vector<ClockRate> rates = beyond_doubt(clock_rates(runs, geometry));
  if (rates.empty()) return rates;
  const bool one_for_all = !differ(rates);
  const std::vector<JoinedRun> as_stamped = runs;
  for (int round = 0; round <= kRounds; ++round) {
    runs = as_stamped;
    for (std::size_t r = 0; r < runs.size(); ++r) put_right(runs[r].tracked, rates[r].rate);
    geometry = fitted_geometry(runs, nominal);
    if (round == kRounds) break;
    const std::vector<ClockRate> left = clock_rates(runs, geometry);
    for (std::size_t r = 0; r < left.size(); ++r) rates[r].rate += one_for_all ? mean_of(left).rate : left[r].rate;
  }
  return rates;
}

void put_clocks_right_as(const std::vector<ClockRate>& fitted, std::vector<JoinedRun>& runs, const Vehicle& nominal,
                         const GeometryFit& geometry) {
  if (fitted.empty() || runs.empty()) return;
  if (differ(fitted)) {
    GeometryFit own = geometry;
    put_clocks_right(runs, nominal, own);
  } else {
    for (JoinedRun& run : runs) put_right(run.tracked, fitted.front().rate);
  }
}

Finding finding_of(const std::vector<ClockRate>& rates) {
  const Effect clocks = effects::clock_rate().front();
  Finding f;
  f.effect = clocks.name;
  f.component = clocks.component;
  f.sentence = clocks.sentence;
  f.where.regime = clocks.regime;
  if (differ(rates)) {
    const Mean mean = mean_of(rates);
    f.parameters.push_back({"rate", mean.rate, mean.stderr_rate, "1"});
    for (std::size_t r = 0; r < rates.size(); ++r)
      f.parameters.push_back({"rate_" + std::to_string(r + 1), rates[r].rate, rates[r].stderr_rate, "1"});
    f.sentence += ", in each recording at one of its own";
  } else {
    f.parameters.push_back({"rate", rates[0].rate, rates[0].stderr_rate, "1"});
  }
  const double evidence = differ(rates) ? evidence_of(rates) : std::pow(rates[0].rate / rates[0].stderr_rate, 2);
  f.log_likelihood_gain = 0.5 * evidence;
  f.p_value = chi_square_tail(evidence, differ(rates) ? static_cast<int>(rates.size()) : 1);
  return f;
}

}  // namespace odolab
