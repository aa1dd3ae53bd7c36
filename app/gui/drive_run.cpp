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
    : scenario_(scenario), replayed_(std::move(replayed)), simulation_(scenario, scenario.seed, replayed_) {
  steps_per_picture_ = std::max(1, int(std::lround(kPicture / scenario.step_s)));
  remember();
}

void DriveRun::restart() {
  simulation_ = Simulation(scenario_, scenario_.seed, replayed_);
  history_.clear();
  times_.clear();
  gap_m_.clear();
  gap_heading_.clear();
  events_.clear();
  shown_s_ = 0.0;
  remember();
}

void DriveRun::remember() {
  const SimulationState& s = simulation_.state();
  const Pose gap = between(s.true_pose, s.estimated_pose);
  history_.push_back(s);
  times_.push_back(s.time_s - start_s());
  gap_m_.push_back(length(gap.position()));
  gap_heading_.push_back(wrapped(gap.heading_rad));
}

void DriveRun::note_events(const SimulationState& before, const SimulationState& now) {
  const auto note = [&](RunEvent::Kind kind, const std::string& words) {
    if (events_.size() >= kMostEvents) return;
    for (RunEvent& e : events_)
      if (e.kind == kind && now.time_s - start_s() - e.time_s < kSameEvent) {
        if (e.words.find(words) == std::string::npos) e.words += ", " + words;
        return;
      }
    events_.push_back({kind, now.time_s - start_s(), words});
  };
  if (now.left.on_bump && !before.left.on_bump) note(RunEvent::Kind::bump, "left wheel on a cable");
  if (now.right.on_bump && !before.right.on_bump) note(RunEvent::Kind::bump, "right wheel on a cable");
  if (now.left.in_slip_zone && !before.left.in_slip_zone)
    note(RunEvent::Kind::slip_zone, "left wheel on a slippery patch");
  if (now.right.in_slip_zone && !before.right.in_slip_zone)
    note(RunEvent::Kind::slip_zone, "right wheel on a slippery patch");
}

void DriveRun::simulate_picture() {
  if (finished()) return;
  for (int i = 0; i < steps_per_picture_ && !simulation_.state().finished; ++i) {
    const SimulationState before = simulation_.state();
    simulation_.step();
    note_events(before, simulation_.state());
  }
  remember();
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

void DriveRun::drive_by_hand(double speed_mps, double yaw_rate_radps) {
  simulation_.drive_by_hand(speed_mps, yaw_rate_radps);
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

SimulationState DriveRun::shown() const {
  const std::size_t after =
      std::size_t(std::lower_bound(times_.begin(), times_.end(), shown_s_ - 1e-12) - times_.begin());
  if (after == 0) return history_.front();
  if (after >= history_.size()) return history_.back();
  const SimulationState &a = history_[after - 1], &b = history_[after];
  const double span = b.time_s - a.time_s, u = span > 0.0 ? (start_s() + shown_s_ - a.time_s) / span : 1.0;
  SimulationState s = u < 0.5 ? a : b;
  s.time_s = start_s() + shown_s_;
  s.true_pose = mixed_pose(a.true_pose, b.true_pose, u);
  s.estimated_pose = mixed_pose(a.estimated_pose, b.estimated_pose, u);
  s.left.rotation_rad = mixed_value(a.left.rotation_rad, b.left.rotation_rad, u);
  s.right.rotation_rad = mixed_value(a.right.rotation_rad, b.right.rotation_rad, u);
  return s;
}

}  // namespace odolab
