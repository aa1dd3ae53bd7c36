#include "core/calibration/moved_mounting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/formatted.h"
#include "core/base/parallel.h"
#include "core/base/quantile.h"
#include "core/calibration/least_squares.h"
#include "core/calibration/run_fit.h"

namespace odolab {

namespace {

// Less than this other physics may feign from run to run, and calibration takes in its stride.
constexpr double kLeast_m = 0.015, kLeast_rad = 0.026;
constexpr double kSigmasOfMounting = 6.0;
constexpr double kExplainedByMounting = 0.9;

struct Seen {
  Pose mounting, stderrs;
};

std::optional<Seen> seen_in(const Recording& recording, const Vehicle& nominal) {
  const std::optional<RunFit> fit = run_fit(recording, nominal);
  if (!fit || !fit->drives || !fit->turns || fit->way_explained < kExplainedByMounting ||
      fit->turn_explained < kExplainedByMounting)
    return std::nullopt;
  return Seen{fit->axle_T_tracked, fit->mounting_stderr};
}

Recording part_of(const Recording& whole, double from_s, double to_s) {
  Recording part;
  part.name = whole.name;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < whole.time_s.size(); ++i)
    if (whole.time_s[i] >= from_s && whole.time_s[i] <= to_s) rows.push_back(i);
  for (std::size_t i : rows) part.time_s.push_back(whole.time_s[i]);
  for (const Channel& c : whole.channels) {
    Channel& copy = part.add_channel(c.name);
    for (std::size_t k = 0; k < rows.size(); ++k) copy.values[k] = c.values[rows[k]];
  }
  return part;
}

// By how much a mounting is off the usual one, and in standard errors.
struct Departure {
  Vec2 by_m;
  double by_rad = 0.0;
  double place_sigmas = 0.0, heading_sigmas = 0.0;

  bool of_place() const { return length(by_m) > kLeast_m && place_sigmas > kSigmasOfMounting; }
  bool of_heading() const { return std::abs(by_rad) > kLeast_rad && heading_sigmas > kSigmasOfMounting; }
  bool stands_out() const { return of_place() || of_heading(); }
};

Departure departure(const Seen& seen, const Seen& usual) {
  Departure d;
  d.by_m = seen.mounting.position() - usual.mounting.position();
  d.by_rad = wrapped(seen.mounting.heading_rad - usual.mounting.heading_rad);
  d.place_sigmas = length(d.by_m) / (1e-9 + std::hypot(seen.stderrs.x_m, usual.stderrs.x_m));
  d.heading_sigmas = std::abs(d.by_rad) / (1e-9 + std::hypot(seen.stderrs.heading_rad, usual.stderrs.heading_rad));
  return d;
}

// The middle of three runs or more; its error is how they scatter about it, the one in the middle of their own or more.
Seen middle_of(const std::vector<Seen>& all) {
  Seen middle;
  const auto over = [&](auto value) {
    std::vector<double> values;
    for (const Seen& s : all) values.push_back(value(s));
    return median(values);
  };
  const double around_rad = all.front().mounting.heading_rad;
  middle.mounting.x_m = over([](const Seen& s) { return s.mounting.x_m; });
  middle.mounting.y_m = over([](const Seen& s) { return s.mounting.y_m; });
  middle.mounting.heading_rad =
      around_rad + over([&](const Seen& s) { return wrapped(s.mounting.heading_rad - around_rad); });
  const auto off_m = [&](const Seen& s) { return length(s.mounting.position() - middle.mounting.position()); };
  const auto off_rad = [&](const Seen& s) {
    return std::abs(wrapped(s.mounting.heading_rad - middle.mounting.heading_rad));
  };
  middle.stderrs.x_m = std::max(over(off_m), over([](const Seen& s) { return s.stderrs.x_m; }));
  middle.stderrs.heading_rad = std::max(over(off_rad), over([](const Seen& s) { return s.stderrs.heading_rad; }));
  return middle;
}

// Not a truth that jumped on the way: in both halves alike.
bool holds_throughout(const Recording& recording, const Vehicle& nominal, const Seen& usual, const Departure& whole) {
  const double begin_s = recording.time_s.front(), end_s = recording.time_s.back(), half_s = 0.5 * (begin_s + end_s);
  for (const auto& [from_s, to_s] : {std::pair{begin_s, half_s}, std::pair{half_s, end_s}}) {
    const std::optional<Seen> half = seen_in(part_of(recording, from_s, to_s), nominal);
    if (!half) return false;
    const Departure d = departure(*half, usual);
    if (whole.of_place() && dot(d.by_m, whole.by_m) < 0.6 * dot(whole.by_m, whole.by_m)) return false;
    if (!whole.of_place() && d.by_rad * whole.by_rad < 0.6 * whole.by_rad * whole.by_rad) return false;
  }
  return true;
}

// The indices of runs that stand out, by their own fits.
std::vector<std::size_t> suspects(const std::vector<Recording>& recordings, const Vehicle& nominal) {
  std::vector<std::optional<Seen>> of_each(recordings.size());
  parallel_for(static_cast<int>(recordings.size()), [&](int i) {
    const auto r = static_cast<std::size_t>(i);
    of_each[r] = seen_in(recordings[r], nominal);
  });
  std::vector<Seen> seen;
  std::vector<std::size_t> index, out;
  for (std::size_t i = 0; i < recordings.size(); ++i)
    if (of_each[i]) {
      seen.push_back(*of_each[i]);
      index.push_back(i);
    }
  if (seen.size() < 2) return out;
  Seen usual;
  if (seen.size() == 2) {
    const auto from_file_m = [&](const Seen& s) {
      const Pose& drawn = nominal.truth.axle_T_tracked;
      const double lever_m = 0.5 * std::get<DifferentialDrive>(nominal.kind).wheelbase_m;
      return length(s.mounting.position() - drawn.position()) +
             lever_m * std::abs(wrapped(s.mounting.heading_rad - drawn.heading_rad));
    };
    usual = from_file_m(seen[0]) <= from_file_m(seen[1]) ? seen[0] : seen[1];
  } else {
    usual = middle_of(seen);
  }
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const Departure d = departure(seen[k], usual);
    if (d.stands_out() && holds_throughout(recordings[index[k]], nominal, usual, d)) out.push_back(index[k]);
  }
  if (2 * out.size() >= seen.size() && seen.size() > 2) out.clear();
  return out;
}

// On a circle what sits further along it looks turned, and what sits further out is a larger wheel.
bool tells_all(const LeastSquaresCalibration& calibration) {
  return !calibration.scale_is_open && std::all_of(calibration.parameters.begin(), calibration.parameters.end(),
                                                   [](const ParameterEstimate& p) { return p.determined; });
}

// As a calibration has it.
Seen measured(const LeastSquaresCalibration& calibration) {
  Seen seen{calibration.vehicle.truth.axle_T_tracked, {}};
  for (const ParameterEstimate& p : calibration.parameters) {
    if (p.name == "truth_mounting.x_m") seen.stderrs.x_m = p.stderr_value;
    if (p.name == "truth_mounting.y_m") seen.stderrs.y_m = p.stderr_value;
    if (p.name == "truth_mounting.heading_rad") seen.stderrs.heading_rad = p.stderr_value;
  }
  return seen;
}

void carry_truth(Recording& recording, const Pose& tracked_T_usual) {
  std::vector<double>* columns[3] = {};
  for (Channel& c : recording.channels) {
    if (c.name == "truth_x_m") columns[0] = &c.values;
    if (c.name == "truth_y_m") columns[1] = &c.values;
    if (c.name == "truth_heading_rad") columns[2] = &c.values;
  }
  if (!columns[0] || !columns[1] || !columns[2]) return;
  for (std::size_t i = 0; i < recording.time_s.size(); ++i) {
    double &x = (*columns[0])[i], &y = (*columns[1])[i], &heading = (*columns[2])[i];
    if (std::isnan(x) || std::isnan(y)) continue;
    if (std::isnan(heading)) {  // where it points is not known there, so neither is the other place
      x = y = std::numeric_limits<double>::quiet_NaN();
      continue;
    }
    const Pose carried = Pose{x, y, heading} * tracked_T_usual;
    x = carried.x_m;
    y = carried.y_m;
    heading = carried.heading_rad;
  }
}

// By a calibration of that run with the others' wheels, from their mounting; where a truth that points elsewhere is
// refused as another robot's, from what its own fit says. (From there always it would stay there on a circle, along
// which nothing is told but by the noise of the headings with which it is told.)
std::optional<Seen> measured_alone(const Recording& recording, const Vehicle& nominal,
                                   const LeastSquaresCalibration& of_others, const Progress& progress) {
  LeastSquaresOptions with_their_wheels;
  with_their_wheels.fit_drive = false;
  Pose carried_by;
  auto alone = calibrate_least_squares({recording}, of_others.vehicle, with_their_wheels, progress);
  if (!alone) {
    const std::optional<Seen> rough = seen_in(recording, nominal);
    if (!rough) return std::nullopt;
    const Pose& usual = of_others.vehicle.truth.axle_T_tracked;
    std::vector<Recording> near{recording};
    carry_truth(near.front(), inverse(rough->mounting) * usual);
    carried_by = inverse(usual) * rough->mounting;
    alone = calibrate_least_squares(near, of_others.vehicle, with_their_wheels, progress);
  }
  if (!alone || !tells_all(*alone)) return std::nullopt;
  Seen seen = measured(*alone);
  seen.mounting = seen.mounting * carried_by;
  return seen;
}

double squared(double value) { return value * value; }

}  // namespace

std::string MovedMounting::sentence() const {
  const Vec2 by = axle_T_tracked.position() - usual.position();
  return formatted(
      "in this recording the tracked point sits %.0f mm further %s and %.0f mm further %s on the vehicle than "
      "in the others, turned by %.1f degrees; put right",
      1e3 * std::abs(by.x_m), by.x_m < 0.0 ? "back" : "forward", 1e3 * std::abs(by.y_m),
      by.y_m < 0.0 ? "right" : "left", degrees(wrapped(axle_T_tracked.heading_rad - usual.heading_rad)));
}

PutRight mountings_put_right(const std::vector<Recording>& recordings, const Vehicle& nominal,
                             const Progress& progress) {
  PutRight result{recordings, {}};
  if (!std::holds_alternative<DifferentialDrive>(nominal.kind)) return result;
  const std::vector<std::size_t> moved = suspects(recordings, nominal);
  if (moved.empty()) return result;
  std::vector<Recording> others;
  for (std::size_t i = 0; i < recordings.size(); ++i)
    if (std::find(moved.begin(), moved.end(), i) == moved.end()) others.push_back(recordings[i]);
  const auto of_others = calibrate_least_squares(others, nominal, {}, progress);
  if (!of_others || !tells_all(*of_others)) return result;
  const Seen usual = measured(*of_others);
  for (std::size_t i : moved) {
    const std::optional<Seen> here = measured_alone(recordings[i], nominal, *of_others, progress);
    if (!here) continue;
    const Departure d = departure(*here, usual);
    if (!d.stands_out()) continue;
    result.moved.push_back({i, recordings[i].name, here->mounting, here->stderrs, usual.mounting,
                            0.5 * squared(d.of_place() ? d.place_sigmas : d.heading_sigmas)});
    carry_truth(result.recordings[i], inverse(here->mounting) * usual.mounting);
  }
  return result;
}

}  // namespace odolab
