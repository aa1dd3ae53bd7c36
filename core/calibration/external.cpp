#include "core/calibration/external.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>

#include "core/geometry/angles.h"
#include "core/recording/vehicle_samples.h"

namespace odolab {

namespace {

// What both kinds with a trailer have in common.
struct Train {
  DifferentialDrive tow, trailer;
  double hitch_offset_m = 0.0;  // from the towing vehicle's centre back to the hitch
  double drawbar_length_m = 1.0;
  double hitch_angle_offset_rad = 0.0;
  double hitch_angle_resolution_rad = 0.0;
};

Train train_of(const Vehicle& vehicle) {
  if (const auto* basic = std::get_if<EncoderTrailer>(&vehicle.kind))
    return {basic->tow,
            basic->trailer,
            basic->hitch_offset_m,
            basic->drawbar_length_m,
            basic->hitch_angle_offset_rad,
            basic->hitch_angle_resolution_rad};
  const SmartEncoderTrailer& smart = std::get<SmartEncoderTrailer>(vehicle.kind);
  return {smart.tow,
          smart.trailer,
          0.0,
          smart.drawbar_length_m,
          smart.hitch_angle_offset_rad,
          smart.hitch_angle_resolution_rad};
}

template <typename Kind>
void put(const Train& train, Kind& kind) {
  kind.tow = train.tow;
  kind.trailer = train.trailer;
  kind.drawbar_length_m = train.drawbar_length_m;
  kind.hitch_angle_offset_rad = train.hitch_angle_offset_rad;
}

ParameterEstimate* parameter(LeastSquaresCalibration& calibration, const std::string& name) {
  for (ParameterEstimate& p : calibration.parameters)
    if (p.name == name) return &p;
  return nullptr;
}

constexpr const char* kHeading = "truth_mounting.heading_rad";

bool is_of_wheels(const ParameterEstimate& p) { return p.name.rfind("truth_mounting.", 0) != 0; }

// What rounding leaves of the mean of an encoder's readings: those within one of its steps err alike.
double rounding_of_mean_rad(const std::vector<Recording>& recordings, double step_rad) {
  if (step_rad <= 0.0) return 0.0;
  std::map<long long, double> dwells;
  double all = 0.0, squares = 0.0;
  for (const Recording& recording : recordings)
    for (const TrailerSample& sample : trailer_samples(recording)) {
      dwells[std::llround(sample.hitch_angle_rad / step_rad)] += 1.0;
      all += 1.0;
    }
  for (const auto& [step, times] : dwells) squares += times * times;
  return all > 0.0 ? step_rad / std::sqrt(12.0) * std::sqrt(squares) / all : 0.0;
}

// The trailer's wheels as the vehicle's, with the truth of its axle: the towing vehicle's, taken back over hitch and
// drawbar.
Result<Recording> trailer_alone(const Recording& recording, const Vehicle& nominal, const Train& train,
                                const TruthMounting& mounting) {
  if (const std::optional<Error> lacks = lacks_encoders(recording, nominal)) return *lacks;
  const double kNone = std::numeric_limits<double>::quiet_NaN();
  const std::vector<TrailerSample> encoders = trailer_samples(recording);
  const std::vector<TruthSample> truth = truth_samples(recording);
  Recording alone;
  alone.name = recording.name;
  alone.provenance = recording.provenance;
  alone.time_s = recording.time_s;
  alone.add_channel("left_wheel_rad").values = recording.channel("trailer_left_wheel_rad")->values;
  alone.add_channel("right_wheel_rad").values = recording.channel("trailer_right_wheel_rad")->values;
  for (const char* name : {"truth_x_m", "truth_y_m", "truth_heading_rad"})
    alone.add_channel(name).values.assign(alone.time_s.size(), kNone);
  const std::size_t first_truth = alone.channels.size() - 3;

  std::size_t row = 0, after = 0;
  bool any = false;
  for (const TruthSample& t : truth) {
    while (row < alone.time_s.size() && alone.time_s[row] < t.time_s) ++row;
    const double read_s = t.time_s - mounting.time_offset_s;
    while (after < encoders.size() && encoders[after].time_s < read_s) ++after;
    if (!t.heading_rad || row == alone.time_s.size() || after == 0 || after == encoders.size()) continue;
    const TrailerSample &a = encoders[after - 1], &b = encoders[after];
    const double share = b.time_s > a.time_s ? (read_s - a.time_s) / (b.time_s - a.time_s) : 1.0;
    const double hitch_rad = a.hitch_angle_rad + share * (b.hitch_angle_rad - a.hitch_angle_rad);
    const Pose tow = Pose{t.position.x_m, t.position.y_m, *t.heading_rad} * inverse(mounting.axle_T_tracked);
    const Pose axle = tow * Pose{-train.hitch_offset_m, 0.0, -(hitch_rad - train.hitch_angle_offset_rad)} *
                      Pose{-train.drawbar_length_m, 0.0, 0.0};
    alone.channels[first_truth].values[row] = axle.x_m;
    alone.channels[first_truth + 1].values[row] = axle.y_m;
    alone.channels[first_truth + 2].values[row] = axle.heading_rad;
    any = true;
  }
  if (!any)
    return Error{recording.name.empty() ? "recording" : recording.name, "a truth without headings",
                 "truth_heading_rad: the trailer's place follows from where the towing vehicle points"};
  return alone;
}

Result<ExternalCalibration> calibrate_train(const std::vector<Recording>& recordings, const Vehicle& nominal,
                                            const LeastSquaresOptions& options, const Progress& progress) {
  Train train = train_of(nominal);
  const auto half = [&](double begin) {
    return [progress, begin](double share) { return goes_on(progress, begin + 0.5 * share); };
  };
  for (const Recording& recording : recordings)  // before the long way
    if (const Result<Recording> alone = trailer_alone(recording, nominal, train, nominal.truth); !alone)
      return alone.error();
  Vehicle part = nominal;
  part.kind = train.tow;
  Result<LeastSquaresCalibration> tow = calibrate_least_squares(recordings, part, options, half(0.0));
  if (!tow) return tow.error();
  // Tracks that skid seem to turn about another place, and late. Only the direction of straights is free of that.
  const bool skids = std::holds_alternative<EncoderTrailer>(nominal.kind);
  TruthMounting mounting = tow->vehicle.truth;
  if (skids) {
    mounting = nominal.truth;
    mounting.axle_T_tracked.heading_rad = tow->vehicle.truth.axle_T_tracked.heading_rad;
    tow->cannot_tell.push_back(
        "truth_mounting.x_m, y_m and time_offset_s from how the tracks skid: they stay as given");
  }

  std::vector<Recording> of_trailer;
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    TruthMounting here = mounting;
    if (!skids) here.time_offset_s = tow->time_offset_s[i];
    Result<Recording> alone = trailer_alone(recordings[i], nominal, train, here);
    if (!alone) return alone.error();
    of_trailer.push_back(std::move(*alone));
  }
  part.kind = train.trailer;
  part.truth = {};
  part.truth.time_offset_s = mounting.time_offset_s;
  LeastSquaresOptions behind = options;
  behind.fit_truth_mounting = true;  // there drawbar and hitch show
  Result<LeastSquaresCalibration> trailer = calibrate_least_squares(of_trailer, part, behind, half(0.5));
  if (!trailer) return trailer.error();

  train.tow = std::get<DifferentialDrive>(tow->vehicle.kind);
  train.trailer = std::get<DifferentialDrive>(trailer->vehicle.kind);
  std::vector<ParameterEstimate> of_tow, of_hitch;
  for (ParameterEstimate p : tow->parameters) {
    if (is_of_wheels(p)) p.name = "tow." + p.name;
    if (!skids || is_of_wheels(p) || p.name == kHeading) of_tow.push_back(p);
  }
  for (ParameterEstimate p : trailer->parameters) {
    if (!is_of_wheels(p)) continue;
    p.name = "trailer." + p.name;
    of_hitch.push_back(p);
  }
  // The truth that was carried back stands too far ahead where the drawbar is longer than believed, and is turned to
  // the right by as much as the hitch reads too much. What is uncertain about the tow's own mounting is so about these.
  const double rounding_rad = rounding_of_mean_rad(recordings, train.hitch_angle_resolution_rad);
  const auto hitch = [&](const char* of_mounting, const char* name, double before, double sign, double rounding) {
    const ParameterEstimate* p = parameter(*trailer, of_mounting);
    const ParameterEstimate* tows = parameter(*tow, of_mounting);
    if (!p) return before;
    ParameterEstimate e = *p;
    e.name = name;
    e.nominal = before;
    e.determined = p->determined;
    e.value = e.determined ? before + sign * p->value : before;
    e.stderr_value = std::hypot(
        p->stderr_value, tows && !(skids && std::string_view(of_mounting) != kHeading) ? tows->stderr_value : 0.0);
    e.stderr_value = std::hypot(e.stderr_value, rounding);
    of_hitch.push_back(e);
    return e.value;
  };
  train.drawbar_length_m = hitch("truth_mounting.x_m", "drawbar_length_m", train.drawbar_length_m, 1.0,
                                 train.drawbar_length_m * rounding_rad);
  train.hitch_angle_offset_rad =
      hitch(kHeading, "hitch_angle_offset_rad", train.hitch_angle_offset_rad, -1.0, rounding_rad);
  tow->parameters = of_tow;
  trailer->parameters = of_hitch;

  ExternalCalibration result;
  result.vehicle = nominal;
  result.vehicle.truth = mounting;
  if (auto* basic = std::get_if<EncoderTrailer>(&result.vehicle.kind)) put(train, *basic);
  if (auto* smart = std::get_if<SmartEncoderTrailer>(&result.vehicle.kind)) put(train, *smart);
  result.parts.push_back({"tow", std::move(*tow)});
  result.parts.push_back({"trailer", std::move(*trailer)});
  return result;
}

Result<ExternalCalibration> calibrate_tracks(const std::vector<Recording>& recordings, const Vehicle& nominal,
                                             const LeastSquaresOptions& options, const Progress& progress) {
  const Tracked& before = std::get<Tracked>(nominal.kind);
  Vehicle drive = nominal;
  drive.kind = as_differential_drive(before);
  Result<LeastSquaresCalibration> found = calibrate_least_squares(recordings, drive, options, progress);
  if (!found) return found.error();
  const DifferentialDrive& seems = std::get<DifferentialDrive>(found->vehicle.kind);
  Tracked after = before;
  after.sprocket_radius_left_m = seems.wheel_radius_left_m;
  after.sprocket_radius_right_m = seems.wheel_radius_right_m;
  after.slip_factor = seems.wheelbase_m / before.track_width_m;
  for (ParameterEstimate& p : found->parameters) {
    if (p.name == "wheel_radius_left_m") p.name = "sprocket_radius_left_m";
    if (p.name == "wheel_radius_right_m") p.name = "sprocket_radius_right_m";
    if (p.name == "wheelbase_m")
      p = {"slip_factor", "1", before.slip_factor, after.slip_factor, p.stderr_value / before.track_width_m,
           p.determined};
  }
  std::vector<std::string>& warnings = found->warnings;  // that it turns wider than its tracks is no surprise
  warnings.erase(std::remove_if(warnings.begin(), warnings.end(),
                                [](const std::string& w) { return w.rfind("wheelbase_m:", 0) == 0; }),
                 warnings.end());
  ExternalCalibration result;
  result.vehicle = found->vehicle;
  result.vehicle.kind = after;
  result.parts.push_back({"", std::move(*found)});
  return result;
}

}  // namespace

bool can_calibrate_externally(const Vehicle& vehicle) {
  return std::holds_alternative<DifferentialDrive>(vehicle.kind) || std::holds_alternative<Tracked>(vehicle.kind) ||
         std::holds_alternative<EncoderTrailer>(vehicle.kind) ||
         std::holds_alternative<SmartEncoderTrailer>(vehicle.kind);
}

Result<ExternalCalibration> calibrate_externally(const std::vector<Recording>& recordings, const Vehicle& nominal,
                                                 const Progress& progress, const LeastSquaresOptions& options) {
  if (std::holds_alternative<Tracked>(nominal.kind)) return calibrate_tracks(recordings, nominal, options, progress);
  if (std::holds_alternative<EncoderTrailer>(nominal.kind) || std::holds_alternative<SmartEncoderTrailer>(nominal.kind))
    return calibrate_train(recordings, nominal, options, progress);
  Result<LeastSquaresCalibration> found = calibrate_least_squares(recordings, nominal, options, progress);
  if (!found) return found.error();
  ExternalCalibration result;
  result.vehicle = found->vehicle;
  result.parts.push_back({"", std::move(*found)});
  return result;
}

}  // namespace odolab
