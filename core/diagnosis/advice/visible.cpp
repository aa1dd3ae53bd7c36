#include "core/diagnosis/advice/visible.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/chi_square.h"
#include "core/base/formatted.h"
#include "core/base/parallel.h"
#include "core/base/two_digits.h"
#include "core/geometry/angles.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kShapes = 9;  // of a scan, to find what is typical

// The chi-square that is exceeded with that probability.
double chi_square_at(double probability, int freedom) {
  double low = 0.0, high = 200.0;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (chi_square_tail(middle, freedom) > probability ? low : high) = middle;
  }
  return high;
}

Visible visible_at(const JointModel& joint, const Effect& e, const std::vector<double>& shape, double probability) {
  Visible out;
  out.effect = &e;
  out.shape = shape;
  const CandidateTest t = joint.test(joint.columns_of(e, shape), -1, !e.local);
  out.standard = std::sqrt(chi_square_at(probability, static_cast<int>(e.amplitudes.size()))) + kPower;
  if (t.value.empty()) return out;
  out.excited = true;
  out.survives = t.survives;
  out.inflation = t.inflation;
  out.needed = 0.0;
  for (std::size_t k = 0; k < t.value.size(); ++k) {
    const double needed = out.standard * t.stderr_value[k] * std::sqrt(t.inflation) / e.amplitudes[k].medium;
    if (needed > out.needed) out.needed = needed, out.weakest = static_cast<int>(k);
  }
  return out;
}

// The column that takes up most of a medium one, in its standard errors.
void bend(Visible& v, const JointModel& joint, const MatrixXd& covariance) {
  if (!v.excited) return;
  const VectorXd taken = joint.absorbed(joint.columns_of(*v.effect, v.shape)).col(v.weakest) *
                         v.effect->amplitudes[static_cast<std::size_t>(v.weakest)].medium;
  const Eigen::Index first_amplitude = joint.first_column(0);
  VectorXd in_errors(first_amplitude);
  for (Eigen::Index c = 0; c < first_amplitude; ++c)
    in_errors(c) = covariance(c, c) > 0.0 ? std::abs(taken(c)) / std::sqrt(covariance(c, c)) : 0.0;
  Eigen::Index most = 0;
  in_errors.maxCoeff(&most);
  v.bends = static_cast<int>(most);
  v.bends_by = taken(most);
}

// Nothing where the recordings are too few for it to be asked.
std::optional<Visible> typical(const JointModel& joint, const Effect& e, double family_wise_error) {
  std::vector<std::vector<double>> shapes{{}};
  std::size_t scanned = 1;
  if (e.shape_follows_amplitude) {
    shapes = {{e.amplitudes[0].medium}};
    scanned = e.scan(joint.views()).size();
  } else if (e.scan) {
    const std::vector<std::vector<double>> all = e.scan(joint.views());
    scanned = std::max<std::size_t>(1, all.size());
    shapes.clear();
    for (std::size_t k = 0; k < kShapes && !all.empty(); ++k)
      shapes.push_back(all[(2 * k + 1) * all.size() / (2 * kShapes)]);
  }
  const double probability =
      family_wise_error /
      (static_cast<double>(catalogue().size() * scanned * std::max<std::size_t>(1, e.forms.size())));
  if (shapes.empty()) return std::nullopt;
  std::vector<Visible> of;
  for (std::vector<double>& s : shapes) {
    if (e.forms.size() > 1) s.push_back(0.0);
    of.push_back(visible_at(joint, e, s, probability));
  }
  std::stable_sort(of.begin(), of.end(), [](const Visible& a, const Visible& b) { return a.needed < b.needed; });
  return of[of.size() / 2];
}

// Of a unit of the catalogue: by what to multiply, and what to write behind it.
std::pair<double, std::string> as_people_read(const std::string& unit) {
  const auto per = [&](const std::string& of) { return unit == of || unit.rfind(of + "/", 0) == 0; };
  if (unit == "1") return {100.0, " %"};
  if (per("1")) return {100.0, " % per " + unit.substr(2)};
  if (per("m")) return {1e3, " m" + unit};
  if (per("rad")) return {180.0 / kPi, "\xC2\xB0" + unit.substr(3)};
  return {1.0, " " + unit};
}

}  // namespace

std::vector<Visible> visible(const JointModel& joint, double family_wise_error) {
  const bool commands = joint.views().front().from_commands;
  const bool has_headings = std::any_of(joint.runs().begin(), joint.runs().end(),
                                        [](const InnovationRun& run) { return run.truth_has_heading; });
  std::vector<const Effect*> asked;
  for (const Effect& e : catalogue()) {
    if (e.only_commands && !commands) continue;
    if (commands && (e.name == "encoder_missed_counts" || e.name == "wheel_eccentricity")) continue;
    if (std::any_of(joint.accepted.begin(), joint.accepted.end(),
                    [&](const AcceptedEffect& a) { return a.effect->name == e.name; }))
      continue;
    // A mounting turned the other way, seen as that; of places alone, the heading that a run began with.
    if (e.name == "wheel_toe" && has_headings) continue;
    asked.push_back(&e);
  }
  std::vector<std::optional<Visible>> looks(asked.size());
  parallel_for(static_cast<int>(asked.size()), [&](int i) { looks[i] = typical(joint, *asked[i], family_wise_error); });
  std::vector<Visible> seen;
  for (const std::optional<Visible>& v : looks) {
    if (!v) continue;
    const auto same = std::find_if(seen.begin(), seen.end(), [&](const Visible& s) {
      return s.effect->name == v->effect->name && s.effect->component == v->effect->component;
    });
    if (same == seen.end())
      seen.push_back(*v);
    else if (v->needed < same->needed)
      *same = *v;
  }
  const MatrixXd covariance = joint.covariance();
  for (Visible& v : seen) bend(v, joint, covariance);
  return seen;
}

std::vector<Visible> least_visible(const std::vector<Visible>& visible) {
  std::vector<Visible> least;
  for (const Visible& v : visible) {
    const auto same =
        std::find_if(least.begin(), least.end(), [&](const Visible& l) { return l.effect->name == v.effect->name; });
    if (same == least.end())
      least.push_back(v);
    else if (v.needed > same->needed)
      *same = v;
  }
  return least;
}

std::vector<Visible> unseen(const std::vector<Visible>& visible) {
  std::vector<Visible> dark = least_visible(visible);
  std::erase_if(dark, [](const Visible& v) { return v.needed <= 1.0; });
  return dark;
}

namespace {

// So many times the medium size of the number that shows least, as findings have it.
FoundParameter as_found(const Visible& v, double times_medium) {
  const Effect::Amplitude& a = v.effect->amplitudes[static_cast<std::size_t>(v.weakest)];
  const double value = times_medium * a.medium;
  if (v.effect->to_parameters && v.effect->amplitudes.size() == 1) {
    const std::vector<FoundParameter> found = v.effect->to_parameters({value}, {0.0});
    if (found.size() == 1) return found.front();
  }
  return {a.name, value, 0.0, a.unit};
}

// Whether a size that would have been seen is one that it can have.
bool any_size_shows(const Visible& v) {
  constexpr double kNoSize = 1e4;  // of the medium one: none of any size
  const Effect::Amplitude& a = v.effect->amplitudes[static_cast<std::size_t>(v.weakest)];
  return v.excited && v.needed < kNoSize && v.needed * a.medium <= std::max(std::abs(a.low), std::abs(a.high));
}

}  // namespace

std::optional<FoundParameter> least_seen(const Visible& v) {
  if (!any_size_shows(v)) return std::nullopt;
  return as_found(v, v.needed);
}

std::string because_of(const Visible& v) {
  if (!v.excited) return "these drives hold nothing that would show it";
  const FoundParameter least = as_found(v, v.needed), medium = as_found(v, 1.0);
  const auto [factor, unit] = as_people_read(least.unit);
  const bool absorbed = v.survives < 0.05;
  const std::string share = absorbed ? formatted("on these drives calibration absorbs %.3g %% of what it would do: ",
                                                 100.0 * (1.0 - v.survives))
                                     : "";
  if (!any_size_shows(v)) return share + "none of any size that it can have would have shown here";
  return share + "less than " + two_digits(least.value * factor) + unit + " would not have shown here, and " +
         two_digits(medium.value * factor) + unit + " is of importance";
}

}  // namespace odolab
