#include "app/gui/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/diagnosis/quality/sound_recordings.h"
#include "core/odometry/estimators.h"
#include "core/recording/vehicle_samples.h"

namespace odolab {

namespace {

constexpr double kPicture_s = 0.04;  // between two postures in which the vehicle is drawn

void errors_along(const Track& estimate, const Track& truth, std::vector<double>& metres,
                  std::vector<double>& radians) {
  for (const TimedPose& t : truth) {
    const std::optional<Pose> e = pose_at(estimate, t.time_s);
    metres.push_back(e ? length(e->position() - t.pose.position()) : std::numeric_limits<double>::quiet_NaN());
    radians.push_back(e ? wrapped(e->heading_rad - t.pose.heading_rad) : std::numeric_limits<double>::quiet_NaN());
  }
}

Result<ComparedReplay> compared(const Scenario& scenario, const std::shared_ptr<const Recording>& recording,
                                const Progress& progress) {
  Result<Replay> result = replay(scenario, recording, progress, kPicture_s);
  if (!result) return result.error();
  ComparedReplay c;
  c.vehicle = scenario.vehicle;
  const bool by_wheels = std::get<ReplayPath>(scenario.path).by == ReplayPath::By::wheels;
  c.estimator = by_wheels ? estimators_for(scenario.vehicle.kind).front().name : "dead reckoning";
  c.replay = std::move(*result);
  const Track& truth = c.replay.truth;
  for (const TimedPose& t : truth) c.time_s.push_back(t.time_s - truth.front().time_s);
  errors_along(c.replay.simulated, truth, c.simulated_m, c.simulated_rad);
  errors_along(c.replay.dead_reckoned, truth, c.dead_reckoned_m, c.dead_reckoned_rad);
  return c;
}

// The same machine on the same floor, with other lengths, believed and true.
Scenario with_vehicle(Scenario scenario, const Vehicle& vehicle) {
  scenario.vehicle = vehicle;
  const ActualDrive drawn = as_drawn(std::get<DifferentialDrive>(vehicle.kind));
  scenario.actual.wheel_radius_left_m = drawn.wheel_radius_left_m;
  scenario.actual.wheel_radius_right_m = drawn.wheel_radius_right_m;
  scenario.actual.wheelbase_m = drawn.wheelbase_m;
  return scenario;
}

}  // namespace

void Comparison::open(std::shared_ptr<const Recording> recording, const Scenario& scenario, Jobs& jobs,
                      OnError on_error) {
  if (jobs.running()) return;
  as_given_ = std::move(recording);
  SoundRecordings sound = sound_recordings({*as_given_}, scenario.vehicle);
  recording_ = std::make_shared<const Recording>(std::move(sound.recordings.front()));
  how_ = std::move(sound.how);
  faults_ = std::move(sound.said);
  scenario_ = scenario;
  nominal_.reset();
  calibrated_.reset();
  calibration_.reset();
  chosen_ = ui::ReplayVehicle::nominal;
  time_s = 0.0;
  const std::shared_ptr<const Recording> driven = recording_;
  jobs.start("driving the recording in the simulation",
             [this, driven, scenario, on_error](const Progress& progress, const Jobs::Deliver& deliver) {
               const auto result = std::make_shared<Result<ComparedReplay>>(compared(scenario, driven, progress));
               deliver([this, result, on_error] {
                 if (*result) {
                   nominal_ = std::move(**result);
                   time_s = duration_s();  // the whole of it in sight
                 } else if (on_error) {
                   on_error(result->error().message());
                 }
               });
             });
}

void Comparison::calibrate(Jobs& jobs, OnError on_error) {
  if (!recording_ || jobs.running()) return;
  const std::shared_ptr<const Recording> recording = recording_;
  const Scenario scenario = scenario_;
  const LeastSquaresOptions how = how_;
  jobs.start("calibrating from the recording",
             [this, recording, scenario, how, on_error](const Progress& progress, const Jobs::Deliver& deliver) {
               const Progress first = [&](double share) { return goes_on(progress, 0.7 * share); };
               const Progress second = [&](double share) { return goes_on(progress, 0.7 + 0.3 * share); };
               const auto found = std::make_shared<Result<LeastSquaresCalibration>>(
                   calibrate_least_squares({*recording}, scenario.vehicle, how, first));
               if (!*found) {
                 deliver([found, on_error] {
                   if (on_error) on_error(found->error().message());
                 });
                 return;
               }
               const auto result = std::make_shared<Result<ComparedReplay>>(
                   compared(with_vehicle(scenario, (*found)->vehicle), recording, second));
               deliver([this, found, result, on_error] {
                 if (!*result) {
                   if (on_error) on_error(result->error().message());
                   return;
                 }
                 calibration_ = std::move(**found);
                 calibrated_ = std::move(**result);
                 chosen_ = ui::ReplayVehicle::calibrated;
               });
             });
}

bool Comparison::has_wheels() const { return recording_ && missing_columns(*recording_, scenario_.vehicle).empty(); }

bool Comparison::can_be_calibrated() const {
  return has_wheels() && std::holds_alternative<DifferentialDrive>(scenario_.vehicle.kind);
}

VehiclePosture ComparedReplay::posture_at(double time_s) const {
  const std::vector<TimedPosture>& p = replay.postures;
  if (p.empty()) return {};
  const auto after =
      std::lower_bound(p.begin(), p.end(), time_s, [](const TimedPosture& a, double time) { return a.time_s < time; });
  if (after == p.begin()) return p.front().posture;
  if (after == p.end()) return p.back().posture;
  const TimedPosture& before = *(after - 1);
  return between(before.posture, after->posture, (time_s - before.time_s) / (after->time_s - before.time_s));
}

double Comparison::start_s() const {
  if (const ComparedReplay* c = shown())
    if (!c->replay.truth.empty()) return c->replay.truth.front().time_s;
  return recording_ && !recording_->time_s.empty() ? recording_->time_s.front() : 0.0;
}

double Comparison::duration_s() const {
  if (const ComparedReplay* c = shown())
    if (!c->time_s.empty()) return c->time_s.back();
  return recording_ ? recording_->duration_s() : 0.0;
}

}  // namespace odolab
