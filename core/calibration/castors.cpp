#include "core/calibration/castors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>

namespace odolab {

namespace {

struct Key {
  const char* name;
  const char* unit;
  double Castor::*value;
};
constexpr Key kKeys[] = {{"offset_m", "m", &Castor::offset_m},
                         {"wheel_radius_left_m", "m", &Castor::wheel_radius_left_m},
                         {"wheel_radius_right_m", "m", &Castor::wheel_radius_right_m},
                         {"wheel_offset_left_m", "m", &Castor::wheel_offset_left_m},
                         {"wheel_offset_right_m", "m", &Castor::wheel_offset_right_m},
                         {"pivot_encoder_offset_rad", "rad", &Castor::pivot_encoder_offset_rad}};

// Readings of a castor that stands, or has settled, stay within so many of its encoder's steps.
constexpr double kSteps = 1.6;

double spread_of(const std::vector<CastorSample>& samples, std::size_t from,
                 const std::function<double(const CastorSample&)>& value) {
  double least = value(samples[from]), most = least;
  for (std::size_t i = from; i < samples.size(); ++i) {
    least = std::min(least, value(samples[i]));
    most = std::max(most, value(samples[i]));
  }
  return most - least;
}

// The castor whose wheels stand while its pivot turns.
std::optional<std::size_t> still_castor(const std::vector<CastorSample>& samples, const MultiCastor& nominal) {
  const double wheel_rad = kSteps * std::max(nominal.wheel_encoder_resolution_rad, 1e-6);
  std::optional<std::size_t> found;
  for (std::size_t c = 0; c < nominal.castors.size(); ++c) {
    const double left = spread_of(samples, 0, [&](const CastorSample& s) { return s.castors[c].wheels.left_rad; });
    const double right = spread_of(samples, 0, [&](const CastorSample& s) { return s.castors[c].wheels.right_rad; });
    const double pivot = spread_of(samples, 0, [&](const CastorSample& s) { return s.castors[c].pivot_rad; });
    if (left > wheel_rad || right > wheel_rad || pivot < 0.1) continue;
    if (found) return std::nullopt;
    found = c;
  }
  return found;
}

// The true castor angle along the clockwise way about the still pivot.
double theta_perp_rad(const Castor& castor, const Castor& still) {
  const Vec2 arm = castor.pivot() - still.pivot();
  return std::atan2(arm.y_m, arm.x_m) - 0.5 * kPi;
}

}  // namespace

Result<Revolution> revolution_in(const std::vector<CastorSample>& samples, const MultiCastor& nominal) {
  if (samples.size() < 3)
    return Error{"samples", std::to_string(samples.size()) + " in which all encoders can be told", "three or more"};
  const std::optional<std::size_t> still = still_castor(samples, nominal);
  if (!still)
    return Error{"castors", "not one alone whose wheels stand while its pivot turns",
                 "one castor held still and the others driving the vehicle about it"};
  // From the last sample back, as long as every other castor keeps its angle.
  const double pivot_rad = kSteps * std::max(nominal.pivot_encoder_resolution_rad, 1e-6);
  std::size_t from = samples.size() - 1;
  const auto settled = [&](std::size_t i) {
    for (std::size_t c = 0; c < nominal.castors.size(); ++c) {
      const double off_rad = samples[i].castors[c].pivot_rad - samples.back().castors[c].pivot_rad;
      if (c != *still && std::abs(off_rad) > pivot_rad) return false;
    }
    return true;
  };
  while (from > 0 && settled(from - 1)) --from;
  const CastorSample &first = samples[from], &last = samples.back();
  const double swivel_rad = last.castors[*still].pivot_rad - first.castors[*still].pivot_rad;
  if (std::abs(swivel_rad) < 0.1)
    return Error{"castors", "no way of a tenth of a radian on which all have settled", "a longer turn"};
  Revolution run;
  run.still = *still;
  run.clockwise = swivel_rad > 0.0;  // the still castor's angle falls as the body turns counter-clockwise
  run.turn_rad = std::abs(swivel_rad);
  run.castors.resize(nominal.castors.size());
  for (std::size_t c = 0; c < nominal.castors.size(); ++c) {
    if (c == *still) continue;
    double sum_rad = 0.0;
    for (std::size_t i = from; i < samples.size(); ++i) sum_rad += samples[i].castors[c].pivot_rad;
    const WheelRotation &begin = first.castors[c].wheels, &end = last.castors[c].wheels;
    run.castors[c] = {sum_rad / static_cast<double>(samples.size() - from), std::abs(end.left_rad - begin.left_rad),
                      std::abs(end.right_rad - begin.right_rad)};
  }
  return run;
}

Castor castor_from_circles(const CastorOnCircle& cw, double turn_cw_rad, const CastorOnCircle& ccw, double turn_ccw_rad,
                           double pivot_distance_m, double theta_perp_rad) {
  const double d_m = pivot_distance_m;
  // Eq. 1, the difference of the readings modulo a turn
  const double gamma_rad = 0.5 * (kPi - unwrapped(ccw.pivot_rad - cw.pivot_rad, kPi));
  Castor castor;
  // Eq. 2: the clockwise reading is theta_perp + Gamma + beta
  castor.pivot_encoder_offset_rad = wrapped(cw.pivot_rad - gamma_rad - theta_perp_rad);
  castor.offset_m = d_m * std::sin(gamma_rad);  // Eq. 3
  // Eqs. 8 and 9, which solve 4 to 7. Clockwise, the left wheel runs outside.
  const auto wheel = [&](double c_cw_rad, double c_ccw_rad, double sign, double& radius_m, double& offset_m) {
    const double sum = turn_ccw_rad * c_cw_rad + turn_cw_rad * c_ccw_rad;
    radius_m = 2.0 * d_m * std::cos(gamma_rad) * turn_ccw_rad * turn_cw_rad / sum;
    offset_m = sign * d_m * std::cos(gamma_rad) * (turn_ccw_rad * c_cw_rad - turn_cw_rad * c_ccw_rad) / sum;
  };
  wheel(cw.left_rad, ccw.left_rad, 1.0, castor.wheel_radius_left_m, castor.wheel_offset_left_m);
  wheel(cw.right_rad, ccw.right_rad, -1.0, castor.wheel_radius_right_m, castor.wheel_offset_right_m);
  return castor;
}

MultiCastor calibrated_castors(const std::vector<Revolution>& runs, const MultiCastor& nominal) {
  MultiCastor result = nominal;
  for (std::size_t c = 0; c < nominal.castors.size(); ++c) {
    Castor first;
    std::array<double, std::size(kKeys)> sum{};
    int estimates = 0;
    for (const Revolution& cw : runs)
      for (const Revolution& ccw : runs) {
        if (!cw.clockwise || ccw.clockwise || cw.still != ccw.still || cw.still == c) continue;
        const Castor& still = nominal.castors[cw.still];
        Castor one = castor_from_circles(cw.castors[c], cw.turn_rad, ccw.castors[c], ccw.turn_rad,
                                         length(nominal.castors[c].pivot() - still.pivot()),
                                         theta_perp_rad(nominal.castors[c], still));
        if (estimates++ == 0) first = one;
        one.pivot_encoder_offset_rad = unwrapped(one.pivot_encoder_offset_rad, first.pivot_encoder_offset_rad);
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += one.*kKeys[k].value;
      }
    for (std::size_t k = 0; k < sum.size() && estimates > 0; ++k)
      result.castors[c].*kKeys[k].value = sum[k] / estimates;
  }
  return result;
}

namespace {

// Variances of all castors' parameters, castor by castor in the order of kKeys: each reading errs by its rounding, and
// acts on the estimates by differences.
std::vector<double> variances(const std::vector<Revolution>& runs, const MultiCastor& nominal) {
  const std::size_t keys = std::size(kKeys);
  std::vector<double> sum(keys * nominal.castors.size(), 0.0);
  const auto add = [&](const std::vector<Revolution>& more, const std::vector<Revolution>& less) {
    const MultiCastor up = calibrated_castors(more, nominal), down = calibrated_castors(less, nominal);
    for (std::size_t c = 0; c < nominal.castors.size(); ++c)
      for (std::size_t k = 0; k < keys; ++k) {
        const double by = up.castors[c].*kKeys[k].value - down.castors[c].*kKeys[k].value;
        const double half = 0.5 * (kKeys[k].value == &Castor::pivot_encoder_offset_rad ? wrapped(by) : by);
        sum[c * keys + k] += half * half;
      }
  };
  const auto vary = [&](std::size_t run, const std::function<double&(Revolution&)>& reading, double error) {
    if (error <= 0.0) return;
    std::vector<Revolution> more = runs, less = runs;
    reading(more[run]) += error;
    reading(less[run]) -= error;
    add(more, less);
  };
  // The standard deviation of rounding is a step over root 12; a way has it at both ends.
  const double pivot_rad = nominal.pivot_encoder_resolution_rad / std::sqrt(12.0);
  const double way_rad = nominal.wheel_encoder_resolution_rad / std::sqrt(6.0);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    vary(
        r, [](Revolution& x) -> double& { return x.turn_rad; }, nominal.pivot_encoder_resolution_rad / std::sqrt(6.0));
    for (std::size_t c = 0; c < nominal.castors.size(); ++c) {
      if (c == runs[r].still) continue;
      vary(
          r, [c](Revolution& x) -> double& { return x.castors[c].pivot_rad; }, pivot_rad);
      vary(
          r, [c](Revolution& x) -> double& { return x.castors[c].left_rad; }, way_rad);
      vary(
          r, [c](Revolution& x) -> double& { return x.castors[c].right_rad; }, way_rad);
    }
  }
  return sum;
}

}  // namespace

Result<InternalCalibration> calibrate_castors(const std::vector<Recording>& recordings, const Vehicle& nominal) {
  const MultiCastor& before = std::get<MultiCastor>(nominal.kind);
  std::vector<Revolution> runs;
  for (const Recording& recording : recordings) {
    const std::string where = recording.name.empty() ? "recording" : recording.name;
    if (const std::optional<Error> lacks = lacks_encoders(recording, nominal)) return *lacks;
    Result<Revolution> run = revolution_in(castor_samples(recording, before.castors.size()), before);
    if (!run) return Error{where + ": " + run.error().where, run.error().found, run.error().expected};
    runs.push_back(std::move(*run));
  }
  const MultiCastor after = calibrated_castors(runs, before);
  const std::vector<double> variance = variances(runs, before);
  InternalCalibration result;
  result.vehicle = nominal;
  result.vehicle.kind = after;
  for (std::size_t c = 0; c < before.castors.size(); ++c) {
    bool both_ways = false;
    for (const Revolution& cw : runs)
      for (const Revolution& ccw : runs)
        both_ways = both_ways || (cw.clockwise && !ccw.clockwise && cw.still == ccw.still && cw.still != c);
    const std::string number = std::to_string(c + 1), castor = "castor[" + number + "]";
    if (!both_ways)
      result.cannot_tell.push_back("castor " + number +
                                   ": it did not go both ways about one still castor; hold another castor " +
                                   "still and drive clockwise, then counter-clockwise");
    for (std::size_t k = 0; k < std::size(kKeys); ++k)
      result.parameters.push_back({castor + "." + kKeys[k].name, kKeys[k].unit, before.castors[c].*kKeys[k].value,
                                   after.castors[c].*kKeys[k].value, std::sqrt(variance[c * std::size(kKeys) + k]),
                                   both_ways});
  }
  result.taken_as_known = {"the distances between the pivots, of which all lengths are shares",
                           "that no wheel slipped; the uncertainty is that of the encoders' rounding"};
  if (const std::vector<std::string> problems = problems_in(after); !problems.empty())
    return Error{nominal.name, "recordings from which " + problems.front(),
                 "runs of this vehicle about still castors, clockwise and counter-clockwise"};
  return result;
}

}  // namespace odolab
