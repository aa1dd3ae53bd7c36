#include "physics/experiments/real/robot_transfer.h"

#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"
#include "core/calibration/minimise.h"
#include "core/diagnosis/diagnosis.h"
#include "core/odometry/prediction.h"

namespace odolab {

namespace {

constexpr double kFurthest_s = 0.3, kFastest = 0.005;  // of a clock that was set by hand

// What must be a robot's own. Scales act on the commands, since a prediction takes those at their word.
struct Own {
  double speed_scale = 1.0, yaw_scale = 1.0, yaw_per_m = 0.0;
  Pose mounting;
  double time_offset_s = 0.0;
};

// The simplex takes a step of one for each: a percent, a centimetre, a hundredth of a radian, 20 ms.
constexpr double kScaleStep = 0.01, kTurnStep_rad = 0.01, kLengthStep_m = 0.01, kTimeStep_s = 0.02;

Own own_of(const std::vector<double>& v, const Own& start) {
  Own own = start;
  own.speed_scale += kScaleStep * v[0];
  own.yaw_scale += kScaleStep * v[1];
  own.yaw_per_m += kTurnStep_rad * v[2];
  own.mounting.x_m += kLengthStep_m * v[3];
  own.mounting.y_m += kLengthStep_m * v[4];
  own.mounting.heading_rad += kTurnStep_rad * v[5];
  own.time_offset_s += kTimeStep_s * v[6];
  return own;
}

Recording part_of(const Recording& recording, double from_s, double to_s) {
  Recording part = recording;
  part.time_s.clear();
  for (Channel& channel : part.channels) channel.values.clear();
  for (std::size_t i = 0; i < recording.time_s.size(); ++i) {
    if (recording.time_s[i] < from_s || recording.time_s[i] >= to_s) continue;
    part.time_s.push_back(recording.time_s[i]);
    for (std::size_t c = 0; c < part.channels.size(); ++c)
      part.channels[c].values.push_back(recording.channels[c].values[i]);
  }
  return part;
}

// What each window of the truth gathers.
std::vector<TypicalError> gathered(const Track& estimate, const Track& truth) {
  std::vector<TypicalError> errors;
  const std::optional<TrackError> windows = track_error(estimate, truth);
  if (!windows) return errors;
  for (const auto& [from_s, to_s] : windows->window_s) {
    const auto a = pose_at(truth, from_s), b = pose_at(truth, to_s), c = pose_at(estimate, from_s),
               d = pose_at(estimate, to_s);
    if (!a || !b || !c || !d) continue;
    const Pose moved = between(*a, *b), reckoned = between(*c, *d);
    const double off_m = length(reckoned.position() - moved.position());
    if (!std::isfinite(off_m)) continue;
    errors.push_back(
        {length(reckoned.position() - moved.position()), std::abs(wrapped(reckoned.heading_rad - moved.heading_rad))});
  }
  return errors;
}

TypicalError typical(const std::vector<TypicalError>& errors) {
  const auto middle = [&](auto value) {
    std::vector<double> values;
    for (const TypicalError& e : errors) values.push_back(value(e));
    return median(std::move(values));
  };
  return {middle([](const TypicalError& e) { return e.position_m; }),
          middle([](const TypicalError& e) { return e.heading_rad; })};
}

// Empty where nothing can be predicted.
std::vector<TypicalError> errors_with(const Recording& recording, const Vehicle& nominal, const Own& own,
                                      const std::vector<ActiveEffect>& effects) {
  Recording scaled = recording;
  std::vector<double>* speed = nullptr;
  std::vector<double>* yaw_rate = nullptr;
  for (Channel& c : scaled.channels) {
    if (c.name == "command_speed_mps") speed = &c.values;
    if (c.name == "command_yaw_rate_radps") yaw_rate = &c.values;
  }
  if (!speed || !yaw_rate) return {};
  for (std::size_t i = 0; i < scaled.time_s.size(); ++i) {
    (*speed)[i] *= own.speed_scale;
    (*yaw_rate)[i] = own.yaw_scale * (*yaw_rate)[i] + own.yaw_per_m * (*speed)[i];
  }
  Vehicle vehicle = nominal;
  vehicle.truth.axle_T_tracked = own.mounting;
  vehicle.truth.time_offset_s = own.time_offset_s;
  const Result<Track> track = predicted_track(scaled, vehicle, effects);
  if (!track) return {};
  return gathered(*track, truth_track(recording));
}

// The truth's clock and mounting are no physics of the base: each robot has its own.
std::vector<ActiveEffect> carried_over(const FittedModel& others) {
  std::vector<ActiveEffect> effects;
  for (const FittedEffect& e : others.effects)
    if (e.recording.empty() && e.active.effect.compare(0, 6, "truth_") != 0) effects.push_back(e.active);
  return effects;
}

Own of_the_others(const FittedModel& others, const Vehicle& nominal) {
  const auto& drawn = std::get<DifferentialDrive>(nominal.kind);
  const auto& fitted = std::get<DifferentialDrive>(others.vehicle.kind);
  const double left = fitted.wheel_radius_left_m / drawn.wheel_radius_left_m;
  const double right = fitted.wheel_radius_right_m / drawn.wheel_radius_right_m;
  Own own;
  own.speed_scale = 0.5 * (left + right);
  own.yaw_scale = 0.5 * (left + right) * drawn.wheelbase_m / fitted.wheelbase_m;
  own.yaw_per_m = (right - left) / fitted.wheelbase_m / own.speed_scale;
  own.mounting = others.vehicle.truth.axle_T_tracked;
  own.time_offset_s = others.vehicle.truth.time_offset_s;
  for (const FittedEffect& e : others.effects) {
    if (e.active.effect == "truth_time_offset") own.time_offset_s = e.active.parameter("offset_s");
    if (e.active.effect == "truth_mounting_offset")
      own.mounting = {e.active.parameter("x_m"), e.active.parameter("y_m"), e.active.parameter("heading_rad")};
  }
  return own;
}

Own fitted_to(const Recording& recording, const Vehicle& nominal, const Own& start,
              const std::vector<ActiveEffect>& effects) {
  const std::vector<TypicalError> first = errors_with(recording, nominal, start, effects);
  if (first.empty()) return start;
  const TypicalError scale = typical(first);
  if (!(scale.position_m > 0.0) || !(scale.heading_rad > 0.0)) return start;
  const auto cost = [&](const std::vector<double>& v) {
    const std::vector<TypicalError> errors = errors_with(recording, nominal, own_of(v, start), effects);
    if (errors.empty()) return 1e9;
    double sum = 0.0;
    for (const TypicalError& e : errors)
      sum += std::log1p(std::pow(e.position_m / scale.position_m, 2)) +
             std::log1p(std::pow(e.heading_rad / scale.heading_rad, 2));
    return sum / static_cast<double>(errors.size());
  };
  return own_of(minimised(cost, std::vector<double>(7, 0.0), 1.0, 1e-5, 500), start);
}

}  // namespace

std::optional<TransferErrors> transferred(const FittedModel& others, const Vehicle& nominal, const Recording& robot,
                                          double share) {
  if (command_samples(robot).empty() || truth_track(robot).size() < 10) return std::nullopt;
  const double middle_s = robot.time_s.front() + share * robot.duration_s();
  const Recording first = part_of(robot, robot.time_s.front(), middle_s);
  const Recording rest = part_of(robot, middle_s, robot.time_s.back() + 1.0);
  const Own theirs = of_the_others(others, nominal);
  const std::vector<ActiveEffect> findings = carried_over(others);
  const Own alone = fitted_to(first, nominal, theirs, {});
  const Own beside = fitted_to(first, nominal, theirs, findings);
  const auto nominal_errors = errors_with(rest, nominal, {}, {}), as_others = errors_with(rest, nominal, theirs, {}),
             own = errors_with(rest, nominal, alone, {}), with = errors_with(rest, nominal, beside, findings);
  if (nominal_errors.empty() || as_others.empty() || own.empty() || with.empty()) return std::nullopt;
  return TransferErrors{typical(nominal_errors), typical(as_others), typical(own), typical(with)};
}

std::optional<TrackError> with_own_clock(const FittedModel& others, const Recording& recording) {
  const Track truth = truth_track(recording);
  const bool with_rate = std::any_of(others.effects.begin(), others.effects.end(), [](const FittedEffect& e) {
    return e.active.effect == "clock_rate" && !e.recording.empty();
  });
  const auto error_at = [&](double offset_s, double rate) -> std::optional<TrackError> {
    Vehicle vehicle = others.vehicle;
    vehicle.truth.time_offset_s = offset_s;
    std::vector<ActiveEffect> effects = others.effects_in(recording.name);
    effects.erase(std::remove_if(effects.begin(), effects.end(),
                                 [](const ActiveEffect& e) { return e.effect == "truth_time_offset"; }),
                  effects.end());
    if (with_rate) effects.push_back({"clock_rate", "vehicle", {{"rate", rate}}});
    const Result<Track> track = predicted_track(recording, vehicle, effects);
    if (!track) return std::nullopt;
    return track_error(*track, truth);
  };
  const auto cost = [](const std::optional<TrackError>& e) {
    return e ? std::pow(e->position_rms_m, 2) + std::pow(0.2 * e->heading_rms_rad, 2) : 1e9;  // 0.2 m: half a robot
  };
  std::optional<TrackError> best;
  double best_s = 0.0, best_rate = 0.0;
  const auto better = [&](double offset_s, double rate) {
    if (std::abs(offset_s) > kFurthest_s || std::abs(rate) > kFastest) return false;
    const std::optional<TrackError> e = error_at(offset_s, rate);
    if (best && cost(e) >= cost(best)) return false;
    best = e;
    best_s = offset_s;
    best_rate = rate;
    return true;
  };
  for (int k = -15; k <= 15; ++k) better(k * kFurthest_s / 15.0, 0.0);
  // Offset and rate together as well: what a rate does in the middle an offset undoes.
  const double half_s = 0.5 * (recording.time_s.back() - recording.time_s.front());
  for (double step_s = 0.08; step_s > 0.001; step_s *= 0.5)
    for (bool moved = true; moved;) {
      const double rate = step_s / half_s;
      moved = better(best_s + step_s, best_rate) || better(best_s - step_s, best_rate);
      if (with_rate)
        moved = better(best_s, best_rate + rate) || better(best_s, best_rate - rate) ||
                better(best_s + step_s, best_rate + rate) || better(best_s - step_s, best_rate - rate) || moved;
    }
  return best;
}

}  // namespace odolab
