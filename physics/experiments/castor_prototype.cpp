#include "physics/experiments/castor_prototype.h"

#include <cmath>

#include "core/base/random.h"

namespace odolab {

namespace {
constexpr double kPeriod_s = 0.05;
}

MultiCastor assumed_castor_prototype() {
  MultiCastor vehicle = three_castor_vehicle();
  vehicle.wheel_encoder_resolution_rad = radians(0.3);
  vehicle.pivot_encoder_resolution_rad = radians(0.07);
  for (Castor& castor : vehicle.castors) {
    castor.pivot_radius_m = 0.24;
    castor.offset_m = castor.wheel_radius_left_m = castor.wheel_radius_right_m = 0.05;
    castor.wheel_offset_left_m = castor.wheel_offset_right_m = 0.05;
  }
  return vehicle;
}

std::string castor_prototype_assumption() {
  return "the prototype's dimensions, which the paper does not give: pivots 0.24 m from the centre, r_c, d and r_w "
         "0.05 m";
}

MultiCastor drawn_castor_machine(const MultiCastor& nominal, std::uint64_t seed, bool with_pivot_offsets) {
  Random random(seed);
  const auto share = [&](double mean_share) { return 1.0 + random.uniform(-2.0 * mean_share, 2.0 * mean_share); };
  MultiCastor actual = nominal;
  for (Castor& castor : actual.castors) {
    castor.offset_m *= share(0.0021);
    castor.wheel_radius_left_m *= share(0.0207);
    castor.wheel_radius_right_m *= share(0.0207);
    castor.wheel_offset_left_m *= share(0.0089);
    castor.wheel_offset_right_m *= share(0.0089);
    const double beta_rad = radians(random.uniform(-2.0 * 7.98, 2.0 * 7.98));
    if (with_pivot_offsets) castor.pivot_encoder_offset_rad = beta_rad;
  }
  return actual;
}

std::vector<std::vector<CastorSample>> calibration_drives(const MultiCastor& actual, const MultiCastor& nominal,
                                                          double sweep_rad, std::uint64_t seed) {
  constexpr double kComingRound_rad = 1.2;  // by which r_c / D has brought the castors within a step of their way
  std::vector<std::vector<CastorSample>> drives;
  for (std::size_t still = 0; still < nominal.castors.size(); ++still)
    for (const bool clockwise : {true, false}) {
      const double rate = clockwise ? -0.5 : 0.5;
      const Vec2 pivot = actual.castors[still].pivot();
      const BodyTwist about{rate * pivot.y_m, -rate * pivot.x_m, rate, kPeriod_s};
      std::vector<double> angles = trailing_angles(nominal, about);  // as the readings show it, offsets and all
      for (std::size_t c = 0; c < angles.size(); ++c) angles[c] -= actual.castors[c].pivot_encoder_offset_rad;
      CastorKinematics vehicle(actual, {}, angles);
      const std::uint64_t phases = seed_of_stream(seed, 2 * still + (clockwise ? 1 : 0));
      std::vector<CastorSample> samples{rounded(vehicle.reading(), actual, phases)};
      const int intervals = static_cast<int>((sweep_rad + kComingRound_rad) / (0.5 * kPeriod_s));
      for (int i = 0; i < intervals; ++i) {
        vehicle.move(about);
        samples.push_back(rounded(vehicle.reading(), actual, phases));
      }
      drives.push_back(std::move(samples));
    }
  return drives;
}

std::vector<Revolution> calibration_revolutions(const MultiCastor& actual, const MultiCastor& nominal, double sweep_rad,
                                                std::uint64_t seed) {
  std::vector<Revolution> runs;
  for (const std::vector<CastorSample>& samples : calibration_drives(actual, nominal, sweep_rad, seed))
    if (Result<Revolution> run = revolution_in(samples, nominal)) runs.push_back(std::move(*run));
  return runs;
}

CastorRun castor_run(const MultiCastor& actual, const std::vector<BodyTwist>& twists) {
  CastorKinematics vehicle(actual, {}, trailing_angles(actual, twists.front()));
  CastorRun run;
  run.exact.push_back(vehicle.reading());
  double until_sample_s = kPeriod_s;
  for (BodyTwist twist : twists) {
    double left_s = twist.duration_s;
    while (left_s > 1e-9) {
      twist.duration_s = std::min(left_s, until_sample_s);
      vehicle.move(twist);
      left_s -= twist.duration_s;
      until_sample_s -= twist.duration_s;
      if (until_sample_s > 1e-9) continue;
      run.exact.push_back(vehicle.reading());
      until_sample_s = kPeriod_s;
    }
  }
  if (until_sample_s < kPeriod_s) run.exact.push_back(vehicle.reading());
  run.end = vehicle.body();
  return run;
}

std::vector<BodyTwist> castor_square(bool clockwise) {
  std::vector<BodyTwist> twists;
  for (int side = 0; side < 4; ++side) {
    twists.push_back({0.33, 0.0, 0.0, 1.5 / 0.33});
    twists.push_back({0.0, 0.0, clockwise ? -0.75 : 0.75, 0.5 * kPi / 0.75});
  }
  return twists;
}

std::vector<CastorSample> rounded(const std::vector<CastorSample>& exact, const MultiCastor& vehicle,
                                  std::uint64_t seed) {
  std::vector<CastorSample> samples;
  samples.reserve(exact.size());
  for (const CastorSample& sample : exact) samples.push_back(rounded(sample, vehicle, seed));
  return samples;
}

}  // namespace odolab
