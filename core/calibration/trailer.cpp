#include "core/calibration/trailer.h"

#include <algorithm>
#include <cmath>

#include "core/calibration/stretch_fit.h"
#include "core/geometry/angles.h"
#include "core/odometry/differential_drive.h"
#include "core/recording/vehicle_samples.h"

namespace odolab {

namespace {

// Departures from the vehicle file, relative but for the last.
enum UnknownOfTrailer {
  kDifferenceTow,
  kWheelbaseTow,
  kScaleTrailer,
  kDifferenceTrailer,
  kWheelbaseTrailer,
  kDrawbar,
  kHitch,
  kUnknownsOfTrailer
};
const std::vector<double> kTrailerPrior = {0.03, 0.05, 0.03, 0.03, 0.05, 0.05, 0.05};
constexpr double kTrailerStretch_m = 0.25, kTrailerStretch_rad = 0.25;

SmartEncoderTrailer trailer_with(const SmartEncoderTrailer& nominal, const std::vector<double>& x) {
  SmartEncoderTrailer v = nominal;
  v.tow.wheel_radius_left_m *= 1.0 - 0.5 * x[kDifferenceTow];
  v.tow.wheel_radius_right_m *= 1.0 + 0.5 * x[kDifferenceTow];
  v.tow.wheelbase_m *= 1.0 + x[kWheelbaseTow];
  v.trailer.wheel_radius_left_m *= (1.0 + x[kScaleTrailer]) * (1.0 - 0.5 * x[kDifferenceTrailer]);
  v.trailer.wheel_radius_right_m *= (1.0 + x[kScaleTrailer]) * (1.0 + 0.5 * x[kDifferenceTrailer]);
  v.trailer.wheelbase_m *= 1.0 + x[kWheelbaseTrailer];
  v.drawbar_length_m *= 1.0 + x[kDrawbar];
  v.hitch_angle_offset_rad += x[kHitch];
  return v;
}

struct TrailerStretch {
  const std::vector<TrailerSample>* samples = nullptr;
  std::size_t first = 0, last = 0;
};

void add_stretches(const std::vector<TrailerSample>& samples, const SmartEncoderTrailer& v,
                   std::vector<TrailerStretch>& stretches) {
  double travel_m = 0.0, turn_rad = 0.0;
  std::size_t first = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Pose tow = dead_reckoned(Pose{}, samples[i - 1].tow, samples[i].tow, v.tow);
    const Pose trailer = dead_reckoned(Pose{}, samples[i - 1].trailer, samples[i].trailer, v.trailer);
    travel_m += std::max(length(tow.position()), length(trailer.position()));
    turn_rad += std::max(std::abs(tow.heading_rad), std::abs(trailer.heading_rad));
    if (travel_m < kTrailerStretch_m && turn_rad < kTrailerStretch_rad) continue;
    stretches.push_back({&samples, first, i});
    first = i;
    travel_m = turn_rad = 0.0;
  }
}

// The hitch angle, and the hitch's place along and across the drawbar: what is read or known less what is predicted.
std::vector<double> trailer_contradictions(const TrailerStretch& stretch, const SmartEncoderTrailer& v) {
  const std::vector<TrailerSample>& s = *stretch.samples;
  Pose tow;
  Pose trailer = Pose{0.0, 0.0, -(s[stretch.first].hitch_angle_rad - v.hitch_angle_offset_rad)} *
                 Pose{-v.drawbar_length_m, 0.0, 0.0};
  for (std::size_t i = stretch.first + 1; i <= stretch.last; ++i) {
    tow = dead_reckoned(tow, s[i - 1].tow, s[i].tow, v.tow);
    trailer = dead_reckoned(trailer, s[i - 1].trailer, s[i].trailer, v.trailer);
  }
  const Vec2 hitch = inverse(trailer) * tow.position();
  const double read_rad = s[stretch.last].hitch_angle_rad - v.hitch_angle_offset_rad;
  return {wrapped(read_rad - (tow.heading_rad - trailer.heading_rad)), v.drawbar_length_m - hitch.x_m, -hitch.y_m};
}

StretchProblem trailer_problem(const std::vector<TrailerStretch>& stretches, const SmartEncoderTrailer& nominal) {
  StretchProblem problem;
  problem.stretches = static_cast<int>(stretches.size());
  problem.prior = kTrailerPrior;
  const double step_rad = nominal.hitch_angle_resolution_rad;
  const double aside_m = kTrailerStretch_m * step_rad / std::sqrt(12.0);  // a way in a direction that is rounded
  problem.least_deviation = {step_rad / std::sqrt(6.0), aside_m, aside_m};
  problem.contradictions = [&stretches, nominal](int stretch, const std::vector<double>& x) {
    return trailer_contradictions(stretches[static_cast<std::size_t>(stretch)], trailer_with(nominal, x));
  };
  problem.encoders = {{0, kHitch, step_rad, [&stretches](int stretch, bool at_end) {
                         const TrailerStretch& s = stretches[static_cast<std::size_t>(stretch)];
                         return (*s.samples)[at_end ? s.last : s.first].hitch_angle_rad;
                       }}};
  return problem;
}

const std::vector<StretchParameter<SmartEncoderTrailer>>& trailer_parameters() {
  using V = SmartEncoderTrailer;
  static const std::vector<StretchParameter<SmartEncoderTrailer>> list = {
      {"tow.wheel_radius_left_m", "m", [](const V& v) { return v.tow.wheel_radius_left_m; }, {kDifferenceTow}},
      {"tow.wheel_radius_right_m", "m", [](const V& v) { return v.tow.wheel_radius_right_m; }, {kDifferenceTow}},
      {"tow.wheelbase_m", "m", [](const V& v) { return v.tow.wheelbase_m; }, {kWheelbaseTow}},
      {"trailer.wheel_radius_left_m",
       "m",
       [](const V& v) { return v.trailer.wheel_radius_left_m; },
       {kScaleTrailer, kDifferenceTrailer}},
      {"trailer.wheel_radius_right_m",
       "m",
       [](const V& v) { return v.trailer.wheel_radius_right_m; },
       {kScaleTrailer, kDifferenceTrailer}},
      {"trailer.wheelbase_m", "m", [](const V& v) { return v.trailer.wheelbase_m; }, {kWheelbaseTrailer}},
      {"drawbar_length_m", "m", [](const V& v) { return v.drawbar_length_m; }, {kDrawbar}},
      {"hitch_angle_offset_rad", "rad", [](const V& v) { return v.hitch_angle_offset_rad; }, {kHitch}},
  };
  return list;
}

}  // namespace

Result<InternalCalibration> calibrate_trailer(const std::vector<Recording>& recordings, const Vehicle& nominal,
                                              const Progress& progress) {
  const SmartEncoderTrailer& before = std::get<SmartEncoderTrailer>(nominal.kind);
  std::vector<std::vector<TrailerSample>> samples;
  for (const Recording& recording : recordings) {
    if (const std::optional<Error> lacks = lacks_encoders(recording, nominal)) return *lacks;
    samples.push_back(trailer_samples(recording));
  }
  std::vector<TrailerStretch> stretches;
  for (const std::vector<TrailerSample>& s : samples) add_stretches(s, before, stretches);
  if (stretches.size() < 8)
    return Error{"recordings", std::to_string(stretches.size()) + " stretches of travel", "two metres or more"};

  const StretchProblem problem = trailer_problem(stretches, before);
  std::vector<int> free = {kDifferenceTow,    kWheelbaseTow, kScaleTrailer, kDifferenceTrailer,
                           kWheelbaseTrailer, kDrawbar,      kHitch};
  InternalCalibration result;
  StretchFit found = fit_stretches(problem, free, progress);
  if (!found.determined(kHitch)) {
    free.pop_back();
    found = fit_stretches(problem, free, progress);
    result.cannot_tell.push_back(
        "a biased hitch encoder from unequal wheels: hitch_angle_offset_rad is taken as in the vehicle file; turn on "
        "the "
        "spot by a quarter turn or more, and drive on with the trailer at that angle");
  }
  if (!goes_on(progress, 1.0)) return Error{"calibration", "stopped before its end", ""};
  if (!found.determined(kWheelbaseTow) || !found.determined(kWheelbaseTrailer))
    result.cannot_tell.push_back("a wheelbase: drive turns");
  if (!found.determined(kDrawbar))
    result.cannot_tell.push_back("the drawbar's length: drive with the trailer at an angle");

  for (int unknown = 0; unknown < kUnknownsOfTrailer; ++unknown)
    if (!found.determined(unknown)) found.x[static_cast<std::size_t>(unknown)] = 0.0;
  for (const StretchParameter<SmartEncoderTrailer>& p : trailer_parameters())
    result.parameters.push_back(estimate_of(p, before, trailer_with, found));
  result.vehicle = nominal;
  result.vehicle.kind = trailer_with(before, found.x);
  result.taken_as_known = {
      "the towing vehicle's mean wheel radius, the scale of all lengths: no encoder inside measures the floor",
      "a smooth floor; stretches over bumps count less"};
  return result;
}

}  // namespace odolab
