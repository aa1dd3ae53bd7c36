#include "core/diagnosis/units/vehicle_units.h"

#include <algorithm>
#include <cassert>

#include "core/calibration/finer_readings.h"
#include "core/calibration/repeated_stamps.h"
#include "core/odometry/differential_drive.h"

namespace odolab {

namespace {

constexpr double kAnglePrior_rad = 0.05, kLengthPrior_m = 0.02, kMountingPrior_m = 0.2, kMountingPrior_rad = 0.3;
constexpr double kLeastAngle_rad = 0.001, kLeastLength_m = 0.004;  // as for the truth's mounting, core/diagnosis
constexpr double kWithoutSteps = 1e7;                              // counts per turn of an encoder without resolution

DifferentialDrive drive_of(const Castor& castor, double resolution_rad) {
  DifferentialDrive drive;
  drive.wheel_radius_left_m = castor.wheel_radius_left_m;
  drive.wheel_radius_right_m = castor.wheel_radius_right_m;
  drive.wheelbase_m = castor.track_m();
  drive.encoder_counts_per_revolution = resolution_rad > 0.0 ? 2.0 * kPi / resolution_rad : kWithoutSteps;
  return drive;
}

const LinkedTrucks* linked(const Vehicle& v) {
  if (const auto* clapper = std::get_if<Clapper>(&v.kind)) return clapper;
  return std::get_if<OmniMate>(&v.kind);
}
LinkedTrucks& linked(Vehicle& v) {
  if (auto* clapper = std::get_if<Clapper>(&v.kind)) return *clapper;
  return std::get<OmniMate>(v.kind);
}

struct UnitsOf {
  std::vector<VehicleUnit> operator()(const DifferentialDrive& d) const { return {{"", "", d, true}}; }
  std::vector<VehicleUnit> operator()(const SynchroDrive&) const { return {}; }
  std::vector<VehicleUnit> operator()(const Tracked& t) const { return {{"", "", as_differential_drive(t), true}}; }
  std::vector<VehicleUnit> operator()(const LinkedTrucks& t) const {
    return {{"truck_a", "truck_a", t.truck_a, true}, {"truck_b", "truck_b", t.truck_b}};
  }
  // The towing vehicle's own tracks are not looked at by its odometry.
  std::vector<VehicleUnit> operator()(const EncoderTrailer& t) const { return {{"trailer", "trailer", t.trailer}}; }
  std::vector<VehicleUnit> operator()(const SmartEncoderTrailer& t) const {
    return {{"", "tow", t.tow, true}, {"trailer", "trailer", t.trailer}};
  }
  std::vector<VehicleUnit> operator()(const MultiCastor& v) const {
    std::vector<VehicleUnit> units;
    for (std::size_t i = 0; i < v.castors.size(); ++i)
      units.push_back({"castor" + std::to_string(i + 1), "castor[" + std::to_string(i + 1) + "]",
                       drive_of(v.castors[i], v.wheel_encoder_resolution_rad)});
    return units;
  }
};

// From the point whose pose the truth is asked for, without its mounting, to the axle.
struct ReferenceToAxle {
  std::size_t unit;
  const std::vector<double>& joints;

  Pose operator()(const DifferentialDrive&) const { return {}; }
  Pose operator()(const SynchroDrive&) const { return {}; }
  Pose operator()(const Tracked&) const { return {}; }
  Pose operator()(const LinkedTrucks& t) const {
    if (unit == 0) return {};
    const Pose a_T_link{0.0, 0.0, -(joints[0] - t.link_angle_a_offset_rad)};
    return a_T_link * Pose{-(joints[2] - t.link_length_offset_m), 0.0, joints[1] - t.link_angle_b_offset_rad};
  }
  Pose operator()(const EncoderTrailer& t) const {
    return Pose{-t.hitch_offset_m, 0.0, -(joints[0] - t.hitch_angle_offset_rad)} * Pose{-t.drawbar_length_m, 0.0, 0.0};
  }
  Pose operator()(const SmartEncoderTrailer& t) const {
    if (unit == 0) return {};
    return Pose{0.0, 0.0, -(joints[0] - t.hitch_angle_offset_rad)} * Pose{-t.drawbar_length_m, 0.0, 0.0};
  }
  Pose operator()(const MultiCastor& v) const {
    const Castor& c = v.castors[unit];
    const Pose pivot{c.pivot().x_m, c.pivot().y_m, joints[unit] - c.pivot_encoder_offset_rad};
    return pivot * Pose{-c.offset_m, 0.5 * (c.wheel_offset_left_m - c.wheel_offset_right_m), 0.0};
  }
};

JointParameter angle_bias(std::string name, std::function<double&(Vehicle&)> of, std::string component,
                          std::string effect = "link_angle_bias") {
  return {std::move(name),      "rad",           kAnglePrior_rad, std::move(of), std::move(effect),
          std::move(component), kLeastAngle_rad, "bias_rad"};
}
JointParameter of_truth(const std::string& name, bool is_angle, std::function<double&(Vehicle&)> of) {
  return {"truth_mounting." + name,
          is_angle ? "rad" : "m",
          is_angle ? kMountingPrior_rad : kMountingPrior_m,
          std::move(of),
          "truth_mounting_offset",
          "truth",
          is_angle ? kLeastAngle_rad : kLeastLength_m,
          name};
}

}  // namespace

bool has_units(const Vehicle& vehicle) {
  return !std::holds_alternative<DifferentialDrive>(vehicle.kind) &&
         !std::holds_alternative<SynchroDrive>(vehicle.kind);
}

std::optional<Error> undiagnosed_kind(const Vehicle& vehicle) {
  if (!std::holds_alternative<SynchroDrive>(vehicle.kind)) return std::nullopt;
  return Error{
      vehicle.name + ": kind", "'synchro_drive'",
      "a differential_drive or a vehicle made of such drives: the base of this one does not turn with its wheels"};
}

std::vector<VehicleUnit> units_of(const Vehicle& vehicle) { return std::visit(UnitsOf{}, vehicle.kind); }

bool carries_truth(const std::vector<VehicleUnit>& units) {
  return std::any_of(units.begin(), units.end(), [](const VehicleUnit& u) { return u.carries_truth; });
}

Vehicle with_drive(Vehicle vehicle, std::size_t unit, const DifferentialDrive& drive) {
  if (auto* one = std::get_if<DifferentialDrive>(&vehicle.kind)) *one = drive;
  if (auto* tracks = std::get_if<Tracked>(&vehicle.kind)) {
    tracks->sprocket_radius_left_m = drive.wheel_radius_left_m;
    tracks->sprocket_radius_right_m = drive.wheel_radius_right_m;
    tracks->slip_factor = drive.wheelbase_m / tracks->track_width_m;
  }
  if (linked(static_cast<const Vehicle&>(vehicle)))
    (unit == 0 ? linked(vehicle).truck_a : linked(vehicle).truck_b) = drive;
  if (auto* train = std::get_if<EncoderTrailer>(&vehicle.kind)) train->trailer = drive;
  if (auto* train = std::get_if<SmartEncoderTrailer>(&vehicle.kind)) (unit == 0 ? train->tow : train->trailer) = drive;
  if (auto* platform = std::get_if<MultiCastor>(&vehicle.kind)) {
    Castor& castor = platform->castors[unit];
    const double wider = drive.wheelbase_m / castor.track_m();  // the pivot's line keeps its share of the axle
    castor.wheel_radius_left_m = drive.wheel_radius_left_m;
    castor.wheel_radius_right_m = drive.wheel_radius_right_m;
    castor.wheel_offset_left_m *= wider;
    castor.wheel_offset_right_m *= wider;
  }
  return vehicle;
}

void move_aside(Vehicle& vehicle, std::size_t unit, double by_m) {
  auto* platform = std::get_if<MultiCastor>(&vehicle.kind);
  if (!platform) return;
  platform->castors[unit].wheel_offset_left_m += by_m;
  platform->castors[unit].wheel_offset_right_m -= by_m;
}

std::vector<UnitSample> unit_readings(const Recording& recording, const Vehicle& vehicle) {
  std::vector<UnitSample> samples;
  if (linked(vehicle))
    for (const LinkedSample& s : linked_samples(recording))
      samples.push_back({s.time_s, {s.a, s.b}, {s.link_angle_a_rad, s.link_angle_b_rad, s.link_length_m}});
  else if (std::holds_alternative<EncoderTrailer>(vehicle.kind))
    for (const TrailerSample& s : trailer_samples(recording))
      samples.push_back({s.time_s, {s.trailer}, {s.hitch_angle_rad}});
  else if (std::holds_alternative<SmartEncoderTrailer>(vehicle.kind))
    for (const TrailerSample& s : trailer_samples(recording))
      samples.push_back({s.time_s, {s.tow, s.trailer}, {s.hitch_angle_rad}});
  else if (const auto* platform = std::get_if<MultiCastor>(&vehicle.kind))
    for (const CastorSample& s : castor_samples(recording, platform->castors.size())) {
      UnitSample sample{s.time_s, {}, {}};
      for (const CastorReading& c : s.castors) {
        sample.wheels.push_back(c.wheels);
        sample.joints.push_back(c.pivot_rad);
      }
      samples.push_back(std::move(sample));
    }
  else
    for (const VehicleUnit& only : units_of(vehicle))
      for (const WheelSample& s : wheel_samples(recording, only.drive))
        samples.push_back({s.time_s, {{s.left_rad, s.right_rad}}, {}});
  return samples;
}

std::vector<UnitSample> unit_samples(const Recording& recording, const Vehicle& vehicle) {
  return without_repeated(unit_readings(recording, vehicle));
}

std::vector<WheelSample> wheels_of(const std::vector<UnitSample>& samples, std::size_t unit) {
  std::vector<WheelSample> wheels;
  for (const UnitSample& s : samples) wheels.push_back({s.time_s, s.wheels[unit].left_rad, s.wheels[unit].right_rad});
  return wheels;
}

Track way_of(const std::vector<UnitSample>& samples, std::size_t unit, const DifferentialDrive& drive) {
  return dead_reckoned(finer_readings(wheels_of(samples, unit)), drive, Pose{}, HeadingRule::arc);
}

std::vector<double> joint_steps(const Vehicle& v) {
  if (const auto* t = std::get_if<EncoderTrailer>(&v.kind)) return {t->hitch_angle_resolution_rad};
  if (const auto* t = std::get_if<SmartEncoderTrailer>(&v.kind)) return {t->hitch_angle_resolution_rad};
  if (const auto* m = std::get_if<MultiCastor>(&v.kind))
    return std::vector<double>(m->castors.size(), m->pivot_encoder_resolution_rad);
  if (const LinkedTrucks* t = linked(v))
    return {t->link_angle_resolution_rad, t->link_angle_resolution_rad, t->link_length_resolution_m};
  return {};
}

std::vector<double> joints_at(const std::vector<UnitSample>& samples, double time_s) {
  assert(!samples.empty());
  const auto after = std::lower_bound(samples.begin(), samples.end(), time_s,
                                      [](const UnitSample& s, double t) { return s.time_s < t; });
  if (after == samples.begin()) return samples.front().joints;
  if (after == samples.end()) return samples.back().joints;
  constexpr double kSlow_s = 0.03, kGap_s = 0.5;
  const UnitSample &a = *(after - 1), &b = *after;
  const double apart_s = b.time_s - a.time_s, u = apart_s > 0.0 ? (time_s - a.time_s) / apart_s : 0.0;
  std::vector<double> joints = a.joints;
  for (std::size_t k = 0; k < joints.size(); ++k) joints[k] += u * (b.joints[k] - a.joints[k]);
  if (apart_s <= kSlow_s || apart_s >= kGap_s || after - 1 == samples.begin() || after + 1 == samples.end())
    return joints;
  // What the slopes at both ends, from their neighbours, are steeper than the line.
  const UnitSample &before = *(after - 2), &behind = *(after + 1);
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const double by = b.joints[k] - a.joints[k];
    const double at_a = apart_s / (b.time_s - before.time_s) * (b.joints[k] - before.joints[k]) - by;
    const double at_b = apart_s / (behind.time_s - a.time_s) * (behind.joints[k] - a.joints[k]) - by;
    joints[k] += u * (1.0 - u) * ((1.0 - u) * at_a - u * at_b);
  }
  return joints;
}

Pose tracked_T_axle(const Vehicle& vehicle, std::size_t unit, const std::vector<double>& joints) {
  return inverse(vehicle.truth.axle_T_tracked) * std::visit(ReferenceToAxle{unit, joints}, vehicle.kind);
}

JointRounding rounding_of_joints(const Vehicle& vehicle, std::size_t unit) {
  if (const LinkedTrucks* trucks = linked(vehicle); trucks && unit == 1)
    return {trucks->link_angle_resolution_rad * trucks->link_length_m + trucks->link_length_resolution_m,
            2.0 * trucks->link_angle_resolution_rad};
  if (const auto* train = std::get_if<EncoderTrailer>(&vehicle.kind))
    return {train->hitch_angle_resolution_rad * train->drawbar_length_m, train->hitch_angle_resolution_rad};
  if (const auto* train = std::get_if<SmartEncoderTrailer>(&vehicle.kind); train && unit == 1)
    return {train->hitch_angle_resolution_rad * train->drawbar_length_m, train->hitch_angle_resolution_rad};
  if (const auto* platform = std::get_if<MultiCastor>(&vehicle.kind))
    return {platform->pivot_encoder_resolution_rad * platform->castors[unit].offset_m,
            platform->pivot_encoder_resolution_rad};
  return {};
}

double length_of_joint_m(const Vehicle& vehicle) {
  if (const LinkedTrucks* trucks = linked(vehicle)) return trucks->link_length_m;
  if (const auto* train = std::get_if<EncoderTrailer>(&vehicle.kind)) return train->drawbar_length_m;
  if (const auto* train = std::get_if<SmartEncoderTrailer>(&vehicle.kind)) return train->drawbar_length_m;
  return 0.0;
}

std::vector<JointParameter> joint_parameters(const Vehicle& vehicle) {
  std::vector<JointParameter> list;
  const auto truth = [&](bool heading_too) {
    list.push_back(of_truth("x_m", false, [](Vehicle& v) -> double& { return v.truth.axle_T_tracked.x_m; }));
    list.push_back(of_truth("y_m", false, [](Vehicle& v) -> double& { return v.truth.axle_T_tracked.y_m; }));
    if (heading_too)
      list.push_back(
          of_truth("heading_rad", true, [](Vehicle& v) -> double& { return v.truth.axle_T_tracked.heading_rad; }));
  };
  if (linked(vehicle)) {
    truth(true);
    list.push_back(angle_bias(
        "link_angle_a_offset_rad", [](Vehicle& v) -> double& { return linked(v).link_angle_a_offset_rad; }, "truck_a"));
    list.push_back(angle_bias(
        "link_angle_b_offset_rad", [](Vehicle& v) -> double& { return linked(v).link_angle_b_offset_rad; }, "truck_b"));
    list.push_back({"link_length_offset_m", "m", kLengthPrior_m,
                    [](Vehicle& v) -> double& { return linked(v).link_length_offset_m; }, "link_length_bias", "link",
                    kLeastAngle_rad* linked(vehicle)->link_length_m, "bias_m"});
  } else if (std::holds_alternative<EncoderTrailer>(vehicle.kind)) {
    // A hitch further back is the same as a tracked point further forward, and a turned mounting as a biased hitch.
    truth(false);
    list.push_back(angle_bias(
        "hitch_angle_offset_rad",
        [](Vehicle& v) -> double& { return std::get<EncoderTrailer>(v.kind).hitch_angle_offset_rad; }, "trailer"));
    list.push_back({"drawbar_length_m", "m", kLengthPrior_m,
                    [](Vehicle& v) -> double& { return std::get<EncoderTrailer>(v.kind).drawbar_length_m; }, "", "",
                    kLeastLength_m, ""});
  } else if (std::holds_alternative<SmartEncoderTrailer>(vehicle.kind)) {
    truth(true);
    list.push_back(angle_bias(
        "hitch_angle_offset_rad",
        [](Vehicle& v) -> double& { return std::get<SmartEncoderTrailer>(v.kind).hitch_angle_offset_rad; }, "trailer"));
    list.push_back({"drawbar_length_m", "m", kLengthPrior_m,
                    [](Vehicle& v) -> double& { return std::get<SmartEncoderTrailer>(v.kind).drawbar_length_m; }, "",
                    "", kLeastLength_m, ""});
  } else if (const auto* platform = std::get_if<MultiCastor>(&vehicle.kind)) {
    truth(true);
    for (std::size_t i = 0; i < platform->castors.size(); ++i) {
      const auto castor = [i](Vehicle& v) -> Castor& { return std::get<MultiCastor>(v.kind).castors[i]; };
      const std::string number = std::to_string(i + 1), key = "castor[" + number + "].";
      list.push_back(angle_bias(
          key + "pivot_encoder_offset_rad", [=](Vehicle& v) -> double& { return castor(v).pivot_encoder_offset_rad; },
          "castor" + number, "pivot_angle_bias"));
      list.push_back({key + "offset_m", "m", kLengthPrior_m, [=](Vehicle& v) -> double& { return castor(v).offset_m; },
                      "", "", kLeastLength_m, ""});
      list.push_back({key + "pivot_radius_m", "m", kLengthPrior_m,
                      [=](Vehicle& v) -> double& { return castor(v).pivot_radius_m; }, "", "", kLeastLength_m, ""});
      list.push_back({key + "pivot_angle_rad", "rad", kAnglePrior_rad,
                      [=](Vehicle& v) -> double& { return castor(v).pivot_angle_rad; }, "", "", kLeastAngle_rad, ""});
    }
  }
  return list;
}

}  // namespace odolab
