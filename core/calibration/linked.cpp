#include "core/calibration/linked.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/calibration/stretch_fit.h"
#include "core/odometry/ipec.h"

namespace odolab {

namespace {

// What is estimated, as departures from the vehicle file.
enum UnknownOfLinked {
  kDifferenceA,
  kWheelbaseA,
  kScaleB,
  kDifferenceB,
  kWheelbaseB,
  kOffsetA,
  kOffsetB,
  kLength,
  kUnknownsOfLinked
};

// How far from the vehicle file a machine is expected at most.
constexpr std::array<double, kUnknownsOfLinked> kLinkedPrior = {0.03, 0.05, 0.03, 0.03, 0.05, 0.05, 0.05, 0.02};

LinkedTrucks linked_with(const LinkedTrucks& nominal, const std::vector<double>& x) {
  LinkedTrucks v = nominal;
  const auto truck = [](DifferentialDrive& t, double scale, double difference, double wheelbase) {
    t.wheel_radius_left_m *= (1.0 + scale) * (1.0 - 0.5 * difference);
    t.wheel_radius_right_m *= (1.0 + scale) * (1.0 + 0.5 * difference);
    t.wheelbase_m *= 1.0 + wheelbase;
  };
  truck(v.truck_a, 0.0, x[kDifferenceA], x[kWheelbaseA]);
  truck(v.truck_b, x[kScaleB], x[kDifferenceB], x[kWheelbaseB]);
  v.link_angle_a_offset_rad += x[kOffsetA];
  v.link_angle_b_offset_rad += x[kOffsetB];
  v.link_length_offset_m += x[kLength];
  return v;
}

// Consecutive samples of one recording, from `first` to `last`.
struct LinkedStretch {
  const std::vector<LinkedSample>* samples = nullptr;
  std::size_t first = 0, last = 0;
};

std::vector<LinkedStretch> linked_stretches(const std::vector<LinkedSample>& samples, const LinkedTrucks& v,
                                            const LinkedCalibrationOptions& options) {
  std::vector<LinkedStretch> stretches;
  double travel_m = 0.0, turn_rad = 0.0;
  std::size_t first = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const auto of = [&](const DifferentialDrive& t, const WheelRotation& from, const WheelRotation& to) {
      const Pose step = dead_reckoned(Pose{}, from, to, t);
      return std::array<double, 2>{length(step.position()), std::abs(step.heading_rad)};
    };
    const auto a = of(v.truck_a, samples[i - 1].a, samples[i].a), b = of(v.truck_b, samples[i - 1].b, samples[i].b);
    travel_m += std::max(a[0], b[0]);
    turn_rad += std::max(a[1], b[1]);
    if (travel_m < options.stretch_m && turn_rad < options.stretch_rad) continue;
    stretches.push_back({&samples, first, i});
    first = i;
    travel_m = turn_rad = 0.0;
  }
  return stretches;
}

// What the link's encoders read at the stretch's end, less what its start and the wheels predict: alpha, beta, length.
std::vector<double> linked_contradictions(const LinkedStretch& stretch, const LinkedTrucks& v) {
  const std::vector<LinkedSample>& s = *stretch.samples;
  LinkedSample start = s[stretch.first];
  start.link_angle_a_rad -= v.link_angle_a_offset_rad;
  start.link_angle_b_rad -= v.link_angle_b_offset_rad;
  start.link_length_m -= v.link_length_offset_m;
  const IpecState state = ipec_start(start, {});
  Pose a = state.a, b = state.b;
  for (std::size_t i = stretch.first + 1; i <= stretch.last; ++i) {
    a = dead_reckoned(a, s[i - 1].a, s[i].a, v.truck_a);
    b = dead_reckoned(b, s[i - 1].b, s[i].b, v.truck_b);
  }
  const Vec2 link = a.position() - b.position();
  const double link_rad = std::atan2(link.y_m, link.x_m);
  const LinkedSample& end = s[stretch.last];
  return {wrapped(end.link_angle_a_rad - v.link_angle_a_offset_rad - (a.heading_rad - link_rad)),
          wrapped(end.link_angle_b_rad - v.link_angle_b_offset_rad - (b.heading_rad - link_rad)),
          end.link_length_m - v.link_length_offset_m - length(link)};
}

StretchProblem linked_problem(const std::vector<LinkedStretch>& stretches, const LinkedTrucks& nominal) {
  StretchProblem problem;
  problem.stretches = static_cast<int>(stretches.size());
  problem.prior.assign(kLinkedPrior.begin(), kLinkedPrior.end());
  const double angle = nominal.link_angle_resolution_rad, way = nominal.link_length_resolution_m;
  problem.least_deviation = {angle / std::sqrt(6.0), angle / std::sqrt(6.0), way / std::sqrt(6.0)};
  problem.contradictions = [&stretches, nominal](int stretch, const std::vector<double>& x) {
    return linked_contradictions(stretches[static_cast<std::size_t>(stretch)], linked_with(nominal, x));
  };
  const auto sample = [&stretches](int stretch, bool at_end) -> const LinkedSample& {
    const LinkedStretch& s = stretches[static_cast<std::size_t>(stretch)];
    return (*s.samples)[at_end ? s.last : s.first];
  };
  problem.encoders = {
      {0, kOffsetA, angle, [sample](int stretch, bool at_end) { return sample(stretch, at_end).link_angle_a_rad; }},
      {1, kOffsetB, angle, [sample](int stretch, bool at_end) { return sample(stretch, at_end).link_angle_b_rad; }}};
  return problem;
}

const std::vector<StretchParameter<LinkedTrucks>>& linked_parameters() {
  static const std::vector<StretchParameter<LinkedTrucks>> list = {
      {"truck_a.wheel_radius_left_m",
       "m",
       [](const LinkedTrucks& v) { return v.truck_a.wheel_radius_left_m; },
       {kDifferenceA}},
      {"truck_a.wheel_radius_right_m",
       "m",
       [](const LinkedTrucks& v) { return v.truck_a.wheel_radius_right_m; },
       {kDifferenceA}},
      {"truck_a.wheelbase_m", "m", [](const LinkedTrucks& v) { return v.truck_a.wheelbase_m; }, {kWheelbaseA}},
      {"truck_b.wheel_radius_left_m",
       "m",
       [](const LinkedTrucks& v) { return v.truck_b.wheel_radius_left_m; },
       {kScaleB, kDifferenceB}},
      {"truck_b.wheel_radius_right_m",
       "m",
       [](const LinkedTrucks& v) { return v.truck_b.wheel_radius_right_m; },
       {kScaleB, kDifferenceB}},
      {"truck_b.wheelbase_m", "m", [](const LinkedTrucks& v) { return v.truck_b.wheelbase_m; }, {kWheelbaseB}},
      {"link_angle_a_offset_rad", "rad", [](const LinkedTrucks& v) { return v.link_angle_a_offset_rad; }, {kOffsetA}},
      {"link_angle_b_offset_rad", "rad", [](const LinkedTrucks& v) { return v.link_angle_b_offset_rad; }, {kOffsetB}},
      {"link_length_offset_m", "m", [](const LinkedTrucks& v) { return v.link_length_offset_m; }, {kLength}},
  };
  return list;
}

}  // namespace

Result<InternalCalibration> calibrate_linked(const std::vector<Recording>& recordings, const Vehicle& nominal,
                                             const Progress& progress, const LinkedCalibrationOptions& options) {
  const LinkedTrucks& before = std::holds_alternative<Clapper>(nominal.kind)
                                   ? static_cast<const LinkedTrucks&>(std::get<Clapper>(nominal.kind))
                                   : static_cast<const LinkedTrucks&>(std::get<OmniMate>(nominal.kind));
  std::vector<std::vector<LinkedSample>> samples;
  for (const Recording& recording : recordings) {
    if (const std::optional<Error> lacks = lacks_encoders(recording, nominal)) return *lacks;
    samples.push_back(linked_samples(recording));
  }
  std::vector<LinkedStretch> stretches;
  for (const std::vector<LinkedSample>& s : samples)
    for (const LinkedStretch& stretch : linked_stretches(s, before, options)) stretches.push_back(stretch);
  if (stretches.size() < 8)
    return Error{"recordings", std::to_string(stretches.size()) + " stretches of travel", "two metres or more"};

  std::vector<int> free = {kDifferenceA, kWheelbaseA, kScaleB, kDifferenceB, kWheelbaseB};
  if (options.fit_link_length) free.push_back(kLength);
  std::vector<int> with_angles = free;
  with_angles.insert(with_angles.end() - (options.fit_link_length ? 1 : 0), {kOffsetA, kOffsetB});
  InternalCalibration result;
  const StretchProblem problem = linked_problem(stretches, before);
  StretchFit found = fit_stretches(problem, options.fit_link_angles ? with_angles : free, progress);
  if (options.fit_link_angles && !(found.determined(kOffsetA) && found.determined(kOffsetB))) {
    found = fit_stretches(problem, free, progress);
    result.cannot_tell.push_back(
        "biased rotary encoders from unequal wheels: the link angles' offsets are taken as in the vehicle file; drive "
        "sideways, both trucks at 45 degrees to the link or more, and in line too");
  }
  if (!goes_on(progress, 1.0)) return Error{"calibration", "stopped before its end", ""};
  if (!found.determined(kWheelbaseA) || !found.determined(kWheelbaseB))
    result.cannot_tell.push_back("a wheelbase: drive turns with both trucks");
  if (options.fit_link_length && !found.determined(kLength))
    result.cannot_tell.push_back("the link length's bias: drive turns, a full one or more");

  for (int unknown = 0; unknown < kUnknownsOfLinked; ++unknown)
    if (!found.determined(unknown)) found.x[static_cast<std::size_t>(unknown)] = 0.0;
  for (const StretchParameter<LinkedTrucks>& p : linked_parameters())
    result.parameters.push_back(estimate_of(p, before, linked_with, found));
  const LinkedTrucks after = linked_with(before, found.x);
  result.vehicle = nominal;
  if (Clapper* clapper = std::get_if<Clapper>(&result.vehicle.kind)) static_cast<LinkedTrucks&>(*clapper) = after;
  if (OmniMate* omnimate = std::get_if<OmniMate>(&result.vehicle.kind)) static_cast<LinkedTrucks&>(*omnimate) = after;
  result.taken_as_known = {
      "truck A's mean wheel radius, the scale of all lengths: no encoder inside measures the floor",
      "a smooth floor; stretches over bumps count less"};
  return result;
}

}  // namespace odolab
