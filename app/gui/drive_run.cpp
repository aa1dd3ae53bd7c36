#include "app/gui/drive_run.h"

#include <algorithm>
#include <cmath>

namespace odolab {

namespace {

constexpr double kPicture = 0.020;  // s
constexpr double kSameEvent = 0.4;  // s: both wheels over one cable are one event
constexpr std::size_t kMostEvents = 200;

double mixed_value(double a, double b, double u) { return a + u * (b - a); }

Pose mixed_pose(const Pose& a, const Pose& b, double u) {
  return {mixed_value(a.x_m, b.x_m, u), mixed_value(a.y_m, b.y_m, u), mixed_value(a.heading_rad, b.heading_rad, u)};
}

}  // namespace

DriveRun::DriveRun(const Scenario& scenario, std::shared_ptr<const Recording> replayed)
    : scenario_(scenario),
      replayed_(std::move(replayed)),
      simulation_(scenario, scenario.seed, replayed_),
      estimates_(scenario, simulation_) {
  simulation_.keep_no_tracks();
  steps_per_picture_ = std::max(1, int(std::lround(kPicture / scenario.step_s)));
  shape_ = simulation_.shape();
  remember();
}

void DriveRun::restart() {
  simulation_ = Simulation(scenario_, scenario_.seed, replayed_);
  simulation_.keep_no_tracks();
  history_.clear();
  postures_.clear();
  times_.clear();
  gap_m_.clear();
  gap_heading_.clear();
  events_.clear();
  kept_ = KeptRows();
  kept_samples_ = KeptSamples();
  samples_seen_ = 1;
  gap_ = {};
  estimates_ = RunEstimates(scenario_, simulation_);
  shown_s_ = 0.0;
  remember();
}

void DriveRun::see_sample() {
  if (simulation_.samples() == samples_seen_) return;
  samples_seen_ = simulation_.samples();
  gap_ = between(simulation_.state().true_pose, simulation_.state().estimated_pose);
  estimates_.take(simulation_);
  kept_samples_.take_from(simulation_);
}

void DriveRun::remember() {
  SimulationState s = simulation_.state();
  estimates_.remember();
  s.estimated_pose = s.true_pose * gap_;
  history_.push_back(s);
  postures_.push_back(simulation_.posture());
  times_.push_back(s.time_s - start_s());
  gap_m_.push_back(length(gap_.position()));
  gap_heading_.push_back(wrapped(gap_.heading_rad));
  kept_.add();
}

void DriveRun::thin() {
  const std::vector<bool> stays = kept_.thin();
  if (stays.empty()) return;
  keep_only(stays, history_);
  keep_only(stays, postures_);
  keep_only(stays, times_);
  keep_only(stays, gap_m_);
  keep_only(stays, gap_heading_);
  estimates_.keep_pictures(stays);
}

void DriveRun::note_events(const VehiclePosture& before, const VehiclePosture& now) {
  const double time_s = simulation_.state().time_s - start_s();
  const auto note = [&](RunEvent::Kind kind, const std::string& words) {
    if (events_.size() >= kMostEvents) return;
    for (RunEvent& e : events_)
      if (e.kind == kind && time_s - e.time_s < kSameEvent) {
        if (e.words.find(words) == std::string::npos) e.words += ", " + words;
        return;
      }
    events_.push_back({kind, time_s, words});
  };
  for (std::size_t i = 0; i < now.wheels.size(); ++i) {
    const WheelState &was = before.wheels[i], &is = now.wheels[i];
    if (is.on_bump && !was.on_bump) note(RunEvent::Kind::bump, words_of(shape_.wheels[i]) + " on a cable");
    if (is.in_slip_zone && !was.in_slip_zone)
      note(RunEvent::Kind::slip_zone, words_of(shape_.wheels[i]) + " on a slippery patch");
  }
}

void DriveRun::simulate_picture() {
  if (finished()) return;
  for (int i = 0; i < steps_per_picture_ && !simulation_.state().finished; ++i) {
    simulation_.step();
    see_sample();
  }
  remember();
  note_events(postures_[postures_.size() - 2], postures_.back());
  thin();
}

void DriveRun::advance(double seconds, const std::function<bool()>& go_on) {
  const double wanted = shown_s_ + seconds;
  while (latest_s() < wanted && !finished() && go_on()) simulate_picture();
  shown_s_ = std::min(wanted, latest_s());
}

void DriveRun::step_forward() {
  const auto next = std::upper_bound(times_.begin(), times_.end(), shown_s_ + 1e-9);
  if (next == times_.end()) simulate_picture();
  const auto then = std::upper_bound(times_.begin(), times_.end(), shown_s_ + 1e-9);
  if (then != times_.end()) shown_s_ = *then;
}

void DriveRun::step_back() {
  const auto here = std::lower_bound(times_.begin(), times_.end(), shown_s_ - 1e-9);
  shown_s_ = here == times_.begin() ? times_.front() : *(here - 1);
}

void DriveRun::show(double time_s) { shown_s_ = std::clamp(time_s, times_.front(), latest_s()); }

void DriveRun::set_floor(const Floor& floor) {
  scenario_.floor = floor;
  simulation_.set_floor(floor);
  const double now = latest_s();
  if (now <= 0.0) return;
  if (!events_.empty() && events_.back().kind == RunEvent::Kind::floor_changed && now - events_.back().time_s < 1.0)
    return;
  if (events_.size() < kMostEvents) events_.push_back({RunEvent::Kind::floor_changed, now, "floor changed"});
}

void DriveRun::drive_by_hand(double speed_mps, double yaw_rate_radps, double sideways_mps) {
  simulation_.drive_by_hand(speed_mps, yaw_rate_radps, sideways_mps);
}

void DriveRun::push(Vec2 impulse_ns) {
  if (finished()) return;
  simulation_.push(impulse_ns);
  if (events_.size() < kMostEvents) events_.push_back({RunEvent::Kind::pushed, latest_s(), "pushed"});
}

double DriveRun::total_s() const {
  const double expected_s = std::max(simulation_.expected_duration_s(), latest_s());
  if (!std::holds_alternative<HandPath>(scenario_.path)) return expected_s;
  if (finished()) return latest_s();
  double window_s = 30.0;  // nobody knows how long a person will drive: the timeline grows
  while (window_s < latest_s() + 2.0) window_s *= 2.0;
  return std::min(window_s, expected_s);
}

DriveRun::Around DriveRun::around_shown() const {
  const std::size_t after =
      std::size_t(std::lower_bound(times_.begin(), times_.end(), shown_s_ - 1e-12) - times_.begin());
  if (after == 0) return {};
  if (after >= times_.size()) return {times_.size() - 1, times_.size() - 1};
  const double span = times_[after] - times_[after - 1];
  return {after - 1, after, span > 0.0 ? (shown_s_ - times_[after - 1]) / span : 1.0,
          kept_.numbers()[after] - kept_.numbers()[after - 1] > 1};
}

SimulationState DriveRun::shown() const {
  const Around at = around_shown();
  const SimulationState &a = history_[at.before], &b = history_[at.after];
  if (at.before == at.after) return a;
  SimulationState s = at.share < 0.5 ? a : b;
  s.time_s = start_s() + shown_s_;
  s.true_pose = mixed_pose(a.true_pose, b.true_pose, at.share);
  s.estimated_pose = mixed_pose(a.estimated_pose, b.estimated_pose, at.share);
  if (!at.thinned) return s;
  if (const std::optional<Pose> pose = pose_at(estimates_.truth(), s.time_s)) s.true_pose = *pose;
  if (const std::optional<Pose> pose = pose_at(estimates_.all()[estimates_.steering()].track, s.time_s))
    s.estimated_pose = *pose;
  return s;
}

VehiclePosture DriveRun::shown_posture() const {
  const Around at = around_shown();
  VehiclePosture posture = between(postures_[at.before], postures_[at.after], at.share);
  if (!at.thinned) return posture;
  const Pose now_T_between = shown().true_pose * inverse(posture.reference);
  posture.reference = now_T_between * posture.reference;
  for (Pose& body : posture.bodies) body = now_T_between * body;
  return posture;
}

}  // namespace odolab
