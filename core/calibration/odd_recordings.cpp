#include "core/calibration/odd_recordings.h"

#include <algorithm>
#include <cmath>

#include "core/base/chi_square.h"
#include "core/base/formatted.h"

namespace odolab {

namespace {

struct KnownLength {
  std::string name;
  double value_m = 0.0, variance_m2 = 0.0;
};
using Lengths = std::vector<KnownLength>;

// What a recording says of the vehicle's lengths. The factor by which a skidding vehicle turns wider is none: it is
// another one in another drive.
Lengths lengths_of(const std::vector<ParameterEstimate>& own) {
  Lengths lengths;
  for (const ParameterEstimate& p : own)
    if (p.determined && p.unit == "m" && p.name.rfind("truth_mounting.", 0) != 0)
      lengths.push_back({p.name, p.value, p.stderr_value * p.stderr_value});
  return lengths;
}

const KnownLength* find(const Lengths& lengths, const std::string& name) {
  const auto at = std::find_if(lengths.begin(), lengths.end(), [&](const KnownLength& l) { return l.name == name; });
  return at == lengths.end() ? nullptr : &*at;
}

// Tiny errors alone do not make two vehicles: a load or a warm tyre moves a radius by some tenths of a percent.
bool are_apart(const KnownLength& a, const KnownLength& b, std::size_t of_so_many) {
  constexpr double kLeast = 0.01, kByChance = 1e-4;
  const double apart_m = a.value_m - b.value_m;
  if (std::abs(apart_m) < kLeast * std::abs(b.value_m)) return false;
  return static_cast<double>(of_so_many) *
             chi_square_tail(apart_m * apart_m / (a.variance_m2 + b.variance_m2 + 1e-300), 1) <
         kByChance;
}

bool are_apart(const Lengths& a, const Lengths& b) {
  return std::any_of(a.begin(), a.end(), [&](const KnownLength& of_a) {
    const KnownLength* of_b = find(b, of_a.name);
    return of_b && are_apart(of_a, *of_b, a.size());
  });
}

// Each length's mean, weighted by precision, but no better known than these recordings agree on it.
Lengths agreed_lengths(const std::vector<Lengths>& all, const std::vector<std::size_t>& which) {
  Lengths mean;
  for (const std::size_t i : which)
    for (const KnownLength& known : all[i]) {
      if (find(mean, known.name)) continue;
      double weights = 0.0, sum_m = 0.0, chi2 = 0.0, count = 0.0;
      const auto each = [&](const auto& add) {
        for (const std::size_t k : which)
          if (const KnownLength* l = find(all[k], known.name)) add(*l, 1.0 / (l->variance_m2 + 1e-300));
      };
      each([&](const KnownLength& l, double weight) { weights += weight, sum_m += weight * l.value_m, count += 1.0; });
      const double value_m = sum_m / weights;
      each([&](const KnownLength& l, double weight) { chi2 += weight * std::pow(l.value_m - value_m, 2); });
      mean.push_back({known.name, value_m, std::max(1.0, chi2 / std::max(1.0, count - 1.0)) / weights});
    }
  return mean;
}

std::string listed(const std::vector<std::string>& words) {
  std::string list;
  for (std::size_t i = 0; i < words.size(); ++i)
    list += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return list;
}

}  // namespace

std::vector<OddRecording> odd_recordings(const std::vector<std::vector<ParameterEstimate>>& own) {
  std::vector<Lengths> all;
  for (const std::vector<ParameterEstimate>& parameters : own) all.push_back(lengths_of(parameters));
  std::vector<std::size_t> most;  // that go with one of them
  for (const Lengths& one : all) {
    if (one.empty()) continue;
    std::vector<std::size_t> with_it;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (!all[i].empty() && !are_apart(all[i], one)) with_it.push_back(i);
    if (with_it.size() > most.size()) most = std::move(with_it);
  }
  const Lengths of_most = agreed_lengths(all, most);
  std::vector<OddRecording> odd;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (std::find(most.begin(), most.end(), i) != most.end() || !are_apart(all[i], of_most)) continue;
    odd.push_back({i, most, {}});
    for (const KnownLength& l : all[i])
      if (const KnownLength* theirs = find(of_most, l.name); theirs && are_apart(l, *theirs, all[i].size()))
        odd.back().lengths.push_back({l.name, l.value_m / theirs->value_m - 1.0});
  }
  return odd;
}

std::vector<OddRecording> odd_recordings(const std::vector<Recording>& recordings, const Vehicle& nominal,
                                         const LeastSquaresOptions& options, const Progress& progress) {
  std::vector<std::vector<ParameterEstimate>> own(recordings.size());
  for (std::size_t i = 0; i < recordings.size() && recordings.size() > 1; ++i) {
    if (!goes_on(progress, static_cast<double>(i) / static_cast<double>(recordings.size()))) return {};
    LeastSquaresOptions of_one = options;
    of_one.left_out = {options.left_out_of(i)};
    const Result<ExternalCalibration> alone = calibrate_externally({recordings[i]}, nominal, progress, of_one);
    if (!alone) continue;
    for (const CalibratedPart& part : alone->parts)
      if (!part.calibration.scale_is_open)  // else its radii are as large as the vehicle's file has them
        own[i].insert(own[i].end(), part.calibration.parameters.begin(), part.calibration.parameters.end());
  }
  return odd_recordings(own);
}

std::string in_words(const OddRecording& odd, const std::vector<std::string>& names) {
  constexpr std::size_t kNamed = 3;
  std::vector<std::string> others, lengths;
  for (const std::size_t i : odd.others)
    if (others.size() < kNamed || odd.others.size() == kNamed + 1) others.push_back(names[i]);
  if (others.size() < odd.others.size()) others.push_back(std::to_string(odd.others.size() - others.size()) + " more");
  for (const OddRecording::Length& l : odd.lengths)
    lengths.push_back(l.name + formatted(" %.1f %% %s", 100.0 * std::abs(l.by), l.by < 0.0 ? "smaller" : "larger"));
  return names[odd.index] + " does not go with " + listed(others) + ": calibrated by itself it has " + listed(lengths) +
         " than " + (odd.others.size() == 1 ? "that one" : "those") +
         ". Another vehicle, other tyres or air pressure, a load, or another floor? Then calibrate it by itself";
}

}  // namespace odolab
