#include "core/diagnosis/units/prediction.h"

#include <algorithm>
#include <utility>

#include "core/calibration/repeated_stamps.h"
#include "core/calibration/smoothed_readings.h"
#include "core/diagnosis/effects/effect_motions.h"
#include "core/diagnosis/units/unit_models.h"
#include "core/odometry/cast.h"
#include "core/odometry/encoder_trailer.h"
#include "core/odometry/ipec.h"
#include "core/odometry/prediction.h"

namespace odolab {

namespace {

void move_left(Pose& pose, double by_m) {
  const Vec2 way = rotated({0.0, by_m}, pose.heading_rad);
  pose.x_m += way.x_m;
  pose.y_m += way.y_m;
}

// The vehicle's own odometry from the origin, with units that also move sideways.
struct Reckoned {
  const TrueUnits& units;

  Track rolled(const DifferentialDrive& drive, HeadingRule rule) const {
    Track track;
    Pose pose;
    for (std::size_t i = 0; i < units.samples.size(); ++i) {
      const UnitSample& now = units.samples[i];
      if (i > 0) {
        move_left(pose, units.sideways_m[i][0]);
        pose = dead_reckoned(pose, units.samples[i - 1].wheels[0], now.wheels[0], drive, rule);
      }
      track.push_back({now.time_s, pose});
    }
    return track;
  }
  Track operator()(const DifferentialDrive& drive) const { return rolled(drive, HeadingRule::arc); }
  Track operator()(const Tracked& vehicle) const { return (*this)(as_differential_drive(vehicle)); }
  Track operator()(const SynchroDrive&) const { return {}; }
  Track ipec_by(const std::vector<LinkedSample>& readings, const IpecTrucks& trucks) const {
    Track track;
    IpecState state;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      if (i == 0) {
        state = ipec_start(readings[0], Pose{});
      } else {
        move_left(state.a, units.sideways_m[i][0]);
        move_left(state.b, units.sideways_m[i][1]);
        state = ipec_step(state, readings[i - 1], readings[i], trucks);
      }
      track.push_back({readings[i].time_s, state.a});
    }
    return track;
  }
  Track operator()(const LinkedTrucks& v) const {
    std::vector<LinkedSample> readings;
    for (const UnitSample& s : units.samples)
      readings.push_back({s.time_s, s.wheels[0], s.wheels[1], s.joints[0] - v.link_angle_a_offset_rad,
                          s.joints[1] - v.link_angle_b_offset_rad, s.joints[2] - v.link_length_offset_m});
    return ipec_by(readings, {v.truck_a, v.truck_b, v.link_angle_resolution_rad, v.link_angle_resolution_rad});
  }
  Track operator()(const SmartEncoderTrailer& v) const {
    std::vector<LinkedSample> readings;
    for (const UnitSample& s : units.samples)
      readings.push_back(
          {s.time_s, s.wheels[0], s.wheels[1], s.joints[0] - v.hitch_angle_offset_rad, 0.0, v.drawbar_length_m});
    return ipec_by(readings, {v.tow, v.trailer, v.hitch_angle_resolution_rad, 0.0});
  }
  Track operator()(const EncoderTrailer& v) const {
    Track track = rolled(v.trailer, HeadingRule::middle);
    for (std::size_t i = 0; i < track.size(); ++i)
      track[i].pose = track[i].pose * trailer_T_tow(v, units.samples[i].joints[0]);
    return track;
  }
  Track operator()(const MultiCastor& v) const {
    const auto reading = [&](const UnitSample& s) {
      CastorSample sample{s.time_s, {}};
      for (std::size_t k = 0; k < v.castors.size(); ++k) sample.castors.push_back({s.wheels[k], s.joints[k]});
      return sample;
    };
    Track track;
    Pose body;
    CastorSample before;
    for (std::size_t i = 0; i < units.samples.size(); ++i) {
      const CastorSample now = reading(units.samples[i]);
      if (i > 0) {
        std::vector<PivotWay> ways = pivot_ways(v, before, now, body, HeadingRule::middle, {});
        for (std::size_t k = 0; k < ways.size(); ++k) {
          const double heading_rad =
              body.heading_rad + before.castors[k].pivot_rad - v.castors[k].pivot_encoder_offset_rad;
          ways[k].way = ways[k].way + rotated({0.0, units.sideways_m[i][k]}, heading_rad);
        }
        body = moved_by_pivots(body, ways, {});
      }
      track.push_back({now.time_s, body});
      before = now;
    }
    return track;
  }
};

// A pose for each reading, of a track that has one for each stamp.
Track at_each_reading(const Track& track, const std::vector<UnitSample>& readings) {
  Track all;
  std::size_t stamp = 0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (i > 0 && readings[i].time_s > readings[i - 1].time_s) ++stamp;
    all.push_back(track[stamp]);
  }
  return all;
}

}  // namespace

Result<Track> predicted_track_of_units(const Recording& recording, const Vehicle& vehicle,
                                       const std::vector<ActiveEffect>& effects) {
  const std::vector<UnitSample> readings = unit_readings(recording, vehicle);
  std::vector<UnitSample> samples = without_repeated(readings);
  if (samples.size() < 2) return predicted_track(recording, vehicle);
  Vehicle with = vehicle;
  with.truth = truth_under(effects, vehicle.truth);
  double rate = 0.0;
  for (const ActiveEffect& a : effects)
    if (a.effect == "clock_rate") rate += a.parameter("rate");
  const TimedPose start = predicted_start(recording, with.truth, samples.front().time_s);
  for (UnitSample& s : samples) s.time_s = start.time_s + (s.time_s - start.time_s) / (1.0 + rate);
  const std::vector<VehicleUnit> units = units_of(with);
  const auto motions_on = [&](const Track& track) {
    std::vector<std::vector<BodyMotion>> motions(units.size());
    for (std::size_t u = 0; u < units.size() && !track.empty(); ++u) {
      InnovationRun run;
      Track axle;
      for (std::size_t i = 0; i < samples.size(); ++i) {
        const WheelRotation& w = samples[i].wheels[u];
        run.wheels.push_back({samples[i].time_s, w.left_rad, w.right_rad});
        axle.push_back({samples[i].time_s, track[i].pose * tracked_T_axle(with, u, samples[i].joints)});
      }
      run.smooth = smoothed(run.wheels);
      run.truth = {TruthSample{axle[0].time_s, axle[0].pose.position(), axle[0].pose.heading_rad}};
      motions[u] =
          motions_of(drive_view(0, run, units[u].drive, false, axle), effects_of_unit(effects, units[u], units));
    }
    return motions;
  };
  Track track = settled([&](const Track& before) {
    Track axle_a = std::visit(Reckoned{without_effects(samples, units, motions_on(before))}, with.kind);
    return as_tracked(through(std::move(axle_a), start), with.truth);
  });
  return within_bounds(at_each_reading(track, readings), recording);
}

}  // namespace odolab
