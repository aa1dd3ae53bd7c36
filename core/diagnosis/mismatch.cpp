#include "core/diagnosis/mismatch.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"
#include "core/calibration/noise_slopes.h"

namespace odolab {

namespace {

constexpr double kGathered_s[] = {0.05, 0.5};  // to both sides

double size_of(std::vector<double> values) {
  values.erase(std::remove_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); }), values.end());
  return scatter_about_zero(std::move(values));
}

// What lies far below the noise of one sample shows here as soon as it keeps its direction.
void gather(const Residuals& r, const ResidualSizes& noise, double half_s, std::vector<double>& largest) {
  std::vector<double> sum[3] = {{0.0}, {0.0}, {0.0}};
  const std::vector<double>* channels[3] = {&r.along_m, &r.across_m, &r.heading_rad};
  const double sizes[3] = {noise.along_m, noise.across_m, noise.heading_rad};
  for (int c = 0; c < 3; ++c)
    for (double v : *channels[c]) sum[c].push_back(sum[c].back() + (std::isfinite(v) ? v : 0.0));
  std::size_t from = 0, to = 0;
  for (std::size_t i = 0; i < r.time_s.size(); ++i) {
    while (to < r.time_s.size() && r.time_s[to] <= r.time_s[i] + half_s) ++to;
    while (r.time_s[from] < r.time_s[i] - half_s) ++from;
    double squares = 0.0;
    int used = 0;
    for (int c = 0; c < 3; ++c) {
      if (!(sizes[c] > 0.0) || sum[c].size() != r.time_s.size() + 1) continue;
      const double gathered = (sum[c][to] - sum[c][from]) / (sizes[c] * std::sqrt(static_cast<double>(to - from)));
      squares += gathered * gathered;
      ++used;
    }
    if (used > 0) largest[i] = std::max(largest[i], std::sqrt(squares / used));
  }
}

double largest_between(const std::vector<double>& time_s, const std::vector<double>& value, double from_s,
                       double to_s) {
  double largest = 0.0;
  for (std::size_t i = 0; i < std::min(time_s.size(), value.size()); ++i)
    if (time_s[i] >= from_s && time_s[i] <= to_s) largest = std::max(largest, value[i]);
  return largest;
}

// What lies on the floor acts in every recording; a push has a place, but happened once.
bool is_of_the_floor(const Finding& f) { return f.effect == "slip_zone" || f.effect == "bump"; }

// Whether a name is that of a recording, or of one of its units: "run.csv, truck_a".
bool is_of(const std::string& name, const std::string& recording) {
  return name == recording || name.rfind(recording + ", ", 0) == 0;
}

// Residuals stand at the truth's stamps, what was found at the wheels'.
double lateness_of_truth_s(const Diagnosis& d, const std::string& recording) {
  if (!of_recording(d.residuals_before, recording)) return 0.0;
  for (const auto& [name, offset_s] : d.truth_clock_s)
    if (is_of(recording, name)) return offset_s;
  return 0.0;
}

void add_passes(const WhereFound::Zone& zone, const Residuals* r, std::size_t finding,
                std::vector<LocatedStretch>& all) {
  constexpr double kJoin_s = 0.5;  // between two passes that are one
  bool passed = false;
  for (std::size_t i = 0; r && i < r->time_s.size(); ++i) {
    if (!(std::hypot(r->x_m[i] - zone.x_m, r->y_m[i] - zone.y_m) <= zone.radius_m)) continue;
    const double t = r->time_s[i];
    if (passed && t - all.back().to_s < kJoin_s)
      all.back().to_s = t;
    else
      all.push_back({finding, t, t});
    passed = true;
  }
}

}  // namespace

FittedNoise noise_of_pictures(FittedNoise calibrated, const FittedNoise& with_findings) {
  FittedNoise other = with_findings;
  for (int k = 0; k < noise_size::count; ++k)
    size_of(calibrated, k) = std::sqrt(size_of(calibrated, k) * size_of(other, k));
  return calibrated;
}

double axis_origin_s(double first_s) {
  constexpr double kMany_s = 1e5;
  return first_s > kMany_s ? std::floor(first_s) : 0.0;
}

ResidualSizes sizes_of(const Residuals& r) { return {size_of(r.along_m), size_of(r.across_m), size_of(r.heading_rad)}; }

std::vector<double> times_noise(const Residuals& r, const ResidualSizes& noise) {
  std::vector<double> result(r.time_s.size(), 0.0);
  for (double half_s : kGathered_s) gather(r, noise, half_s, result);
  return result;
}

double mean_square(const Residuals& r) {
  double sum = 0.0;
  int count = 0;
  for (double s : r.squared)
    if (std::isfinite(s)) sum += s, ++count;
  return count > 0 ? sum / count : 0.0;
}

const Residuals* of_recording(const std::vector<Residuals>& all, const std::string& recording) {
  for (const Residuals& r : all)
    if (r.recording == recording) return &r;
  for (const Residuals& r : all)  // of a unit of it: "run.csv, truck_a"
    if (r.recording.rfind(recording + ", ", 0) == 0) return &r;
  return nullptr;
}

const char* mismatch_level_text(int level) {
  static const char* const kTexts[kMismatchLevels] = {"noise",
                                                      "2\xE2\x80\x93"
                                                      "3\xC3\x97",
                                                      "3\xE2\x80\x93"
                                                      "5\xC3\x97",
                                                      "5\xE2\x80\x93"
                                                      "8\xC3\x97",
                                                      "over 8\xC3\x97"};
  return kTexts[std::clamp(level, 0, kMismatchLevels - 1)];
}

int mismatch_level(double times_noise) {
  int level = 0;
  while (level + 1 < kMismatchLevels && times_noise >= kMismatchSteps[level]) ++level;
  return level;
}

double MismatchOverTime::largest_before(double from_s, double to_s) const {
  return largest_between(time_s, before, from_s, to_s);
}

double MismatchOverTime::largest_after(double from_s, double to_s) const {
  return largest_between(time_s, after, from_s, to_s);
}

MismatchOverTime mismatch_over_time(const Diagnosis& d, const std::string& recording) {
  MismatchOverTime m;
  const Residuals* before = of_recording(d.residuals_before, recording);
  if (!before) return m;
  const Residuals* after = of_recording(d.residuals_after, recording);
  const ResidualSizes noise = sizes_of(after ? *after : *before);
  m.time_s = before->time_s;
  m.x_m = before->x_m;
  m.y_m = before->y_m;
  m.before = times_noise(*before, noise);
  if (!after || d.findings.empty()) return m;
  // The filter may have set other samples aside: what it has at the same time.
  const std::vector<double> then = times_noise(*after, noise);
  std::size_t k = 0;
  for (double t : m.time_s) {
    while (k + 1 < after->time_s.size() && after->time_s[k] < t - 1e-9) ++k;
    m.after.push_back(k < then.size() ? then[k] : 0.0);
  }
  return m;
}

std::vector<LocatedStretch> located_stretches(const Diagnosis& d, const std::string& recording) {
  std::vector<LocatedStretch> all;
  for (std::size_t k = 0; k < d.findings.size(); ++k) {
    const WhereFound& where = d.findings[k].where;
    const double late_s = d.findings[k].effect == "truth_frozen" ? 0.0 : lateness_of_truth_s(d, recording);
    if (where.recording.empty() || is_of(recording, where.recording))
      for (const auto& [from_s, to_s] : where.time_s) all.push_back({k, from_s + late_s, to_s + late_s});
    else if (where.zone && is_of_the_floor(d.findings[k]))
      add_passes(*where.zone, of_recording(d.residuals_before, recording), k, all);
  }
  return all;
}

}  // namespace odolab
