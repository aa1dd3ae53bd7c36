#include "physics/experiments/concealed/drawn_case.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "physics/experiments/concealed/oracle.h"
#include "physics/experiments/concealed/own_effects.h"

namespace odolab::concealed {

namespace {

constexpr int kMostDraws = 12;
constexpr double kPoorShare = 0.15;

// Of every dozen cases.
constexpr Kind kKinds[12] = {Kind::one, Kind::nothing, Kind::one, Kind::two, Kind::one,     Kind::outside,
                             Kind::one, Kind::nothing, Kind::one, Kind::two, Kind::nothing, Kind::outside};

template <typename T>
const T& one_of(Random& random, const std::vector<T>& list) {
  const auto k = static_cast<std::size_t>(random.uniform() * static_cast<double>(list.size()));
  return list[std::min(k, list.size() - 1)];
}

bool reads_encoders(const std::string& name) {
  return name == "encoder_missed_counts" || name == "drivetrain_backlash" || name == "clock_rate";
}

bool acts_at_a_place(const std::string& name) {
  const OutsideEffect* outside = outside_effect(name);
  return outside ? outside->at_a_place : name == "bump" || name == "slip_zone";
}

std::vector<std::string> drawn_names(Random& random, Kind kind, const Wish& wish) {
  if (kind == Kind::nothing) return {};
  if (!wish.effects.empty()) return wish.effects;
  if (kind == Kind::outside) return {one_of(random, outside_effects()).name};
  std::vector<std::string> names = {one_of(random, drawable_effects())};
  while (kind == Kind::two && names.size() < 2) {
    const std::string& other = one_of(random, drawable_effects());
    // What acts at a place is told from the noise by two runs that err alike, and wheels that count otherwise do not.
    const bool alike =
        !(acts_at_a_place(other) || acts_at_a_place(names[0])) || !(reads_encoders(other) || reads_encoders(names[0]));
    if (other != names[0] && alike && !(acts_at_a_place(other) && acts_at_a_place(names[0]))) names.push_back(other);
  }
  return names;
}

RunPlan plan_of(const DrawnCase& c, const DrawnDrive& drive, int number) {
  RunPlan plan;
  plan.robot = c.robot;
  plan.drive = drive;
  plan.seed = seed_of_stream(c.seed, 1000 + static_cast<std::uint64_t>(number)) >> 1;  // as large as a file can say
  for (const DrawnEffect& e : c.effects)
    if (e.only_in_run < 0 || e.only_in_run == number) plan.effects.push_back(e);
  return plan;
}

// Recordings are begun and ended by hand.
void stand_at_both_ends(std::uint64_t seed, DrawnDrives& drives) {
  constexpr std::uint64_t kStream = 13;
  Random random(seed_of_stream(seed, kStream));
  for (std::vector<DrawnDrive>* of : {&drives.given, &drives.held_out})
    for (DrawnDrive& d : *of) d.driving.stands_s = random.uniform(2.0, 6.0);
}

// Place and moment where they are still open, on the way of a run that is driven without the effect.
void place_in_runs(Random& random, DrawnCase& c, const DrawnDrives& drives) {
  for (DrawnEffect& e : c.effects) {
    const bool a_place = e.active.effect == "bump" || e.active.effect == "slip_zone";
    if (e.only_in_run < 0 && !a_place) continue;
    const int r = e.only_in_run >= 0
                      ? e.only_in_run
                      : std::min(static_cast<int>(drives.given.size()) - 1,
                                 static_cast<int>(random.uniform() * static_cast<double>(drives.given.size())));
    RunPlan plan = plan_of(c, drives.given[static_cast<std::size_t>(r)], r);
    plan.effects.clear();
    const DrivenRun run = driven(plan);
    const double span_s = run.true_axle.back().time_s;
    if (!a_place) {
      e.active.parameters.push_back({"at_s", span_s * random.uniform(0.25, 0.75)});
      continue;
    }
    std::size_t at = 0;
    double way_m = 0.0;
    for (int tries = 0; tries < 20 && way_m < 0.05; ++tries) {  // where it drives, not where it turns or rests
      at = static_cast<std::size_t>(random.uniform(0.15, 0.85) * static_cast<double>(run.true_axle.size()));
      way_m = length(run.true_axle[std::min(at + 500, run.true_axle.size() - 1)].pose.position() -
                     run.true_axle[at].pose.position());
    }
    const double half = 0.5 * c.robot.scenario.actual.wheelbase_m;
    const double side_m = e.active.component == "left_wheel"    ? half
                          : e.active.component == "right_wheel" ? -half
                                                                : random.uniform(-half, half);
    const Vec2 place = run.true_axle[at].pose * Vec2{0.0, side_m};
    e.active.parameters.push_back({"x_m", place.x_m});
    e.active.parameters.push_back({"y_m", place.y_m});
  }
}

// The motion of each effect of the case in a run, at its true size; zero where it does not act.
void know(const DrawnCase& c, Run& run) {
  Vehicle vehicle = c.robot.scenario.vehicle;
  vehicle.kind = c.robot.actual();
  Result<InnovationRun> made = innovation_run(run.driven.recording, vehicle);
  run.known = std::move(*made);
  for (const DrawnEffect& e : c.effects) {
    ExtraColumn column{e.active.effect, 1.0, std::vector<BodyMotion>(run.known.wheels.size() - 1)};
    // What acts at a place is met on the very way that was driven, noise and all; the rest needs neither noise nor
    // places.
    RunPlan world = run.plan;
    if (!e.at_a_place) {
      world.noise = false;
      std::erase_if(world.effects, [](const DrawnEffect& other) { return other.at_a_place; });
    }
    RunPlan without = world;
    std::erase_if(without.effects, [&](const DrawnEffect& other) { return other.active.effect == e.active.effect; });
    if (without.effects.size() < world.effects.size()) {
      // Both by the same counts: what a floor does between two of them is its own each time.
      const Track with = driven_again(world, run.driven.counted), track = driven_again(without, run.driven.counted);
      const double rate = run.plan.clock_rate();
      column.per_step =
          difference(run.known.wheels, {with, e.active.effect == "clock_rate" ? 0.0 : rate}, {track, rate});
    }
    run.known.extra.push_back(std::move(column));
  }
}

std::vector<Run> runs_of(const DrawnCase& c, const std::vector<DrawnDrive>& drives, int first, bool noise) {
  std::vector<Run> runs(drives.size());
  parallel_for(static_cast<int>(runs.size()), [&](int r) {
    Run& run = runs[static_cast<std::size_t>(r)];
    const DrawnDrive& drive = drives[static_cast<std::size_t>(r)];
    run.plan = plan_of(c, drive, first + r);
    run.plan.noise = noise;
    run.driven = driven(run.plan);
    run.driven.recording.name = drive.name + ".csv";
    know(c, run);
  });
  return runs;
}

std::vector<double> significance_in(const DrawnCase& c) {
  std::vector<InnovationRun> runs;
  for (const Run& run : c.given) runs.push_back(run.known);
  return significance(runs, c.truth());
}

// Scales the effects until the fit that knows their form would find them at this level. False where that takes sizes
// that the effects do not have.
bool scaled_to(DrawnCase& c, const DrawnDrives& drives, double wanted, const Progress& progress) {
  const bool a_place =
      std::any_of(c.effects.begin(), c.effects.end(), [](const DrawnEffect& e) { return e.at_a_place; });
  for (int pass = 0; pass < 4; ++pass) {
    if (!goes_on(progress, 0.2 * (1 + pass))) return false;
    c.given = runs_of(c, drives.given, 0, a_place);
    c.significance = significance_in(c);
    bool near = true;
    for (std::size_t k = 0; k < c.effects.size(); ++k) {
      const double factor = wanted / std::max(c.significance[k], 1e-6);
      if (factor > c.effects[k].largest) return false;
      near = near && std::abs(std::log(factor)) < 0.1;
    }
    if (near) return true;
    for (std::size_t k = 0; k < c.effects.size(); ++k) c.effects[k] = c.effects[k].scaled(wanted / c.significance[k]);
  }
  for (double s : c.significance)
    if (std::abs(std::log(wanted / s)) > 0.3) return false;
  return true;
}

bool drawn_once(Random& random, DrawnCase& c, const Wish& wish, const Progress& progress) {
  const std::vector<std::string> names = drawn_names(random, c.kind, wish);
  const bool a_place = std::any_of(names.begin(), names.end(), acts_at_a_place);
  c.robot = drawn_robot(random, a_place);
  DrawnDrives drives = drawn_drives(random, c.poor);
  stand_at_both_ends(c.seed, drives);
  c.effects.clear();
  for (const std::string& name : names)
    c.effects.push_back(drawn_effect(random, name, static_cast<int>(drives.given.size())));
  place_in_runs(random, c, drives);
  const double wanted = significance_of(c.level);
  if (!c.effects.empty() && !scaled_to(c, drives, wanted, progress)) return false;
  c.given = runs_of(c, drives.given, 0, true);
  if (!c.effects.empty()) {
    c.significance = significance_in(c);
    for (double s : c.significance)
      if (std::abs(std::log(wanted / s)) > 0.4) return false;
  }
  c.held_out = runs_of(c, drives.held_out, 100, true);
  return true;
}

}  // namespace

double significance_of(Level level) { return level == Level::strong ? 40.0 : level == Level::medium ? 15.0 : 6.0; }

const char* name_of(Level level) {
  return level == Level::strong ? "strong" : level == Level::medium ? "medium" : "weak";
}

InnovationModel DrawnCase::truth() const {
  InnovationModel model;
  model.drive = robot.actual();
  model.truth = robot.scenario.vehicle.truth;
  model.noise = {robot.wheel_noise_m_per_sqrt_m(), robot.scenario.sensors.truth_position_noise_m,
                 robot.scenario.sensors.truth_heading_noise_rad};
  return model;
}

DrawnCase drawn_case(std::uint64_t seed, int number, const Wish& wish, const Progress& progress) {
  DrawnCase c;
  c.number = number;
  const std::uint64_t own = seed_of_stream(seed, static_cast<std::uint64_t>(number));
  Random random(own);
  c.kind = wish.kind.value_or(kKinds[number % 12]);
  c.poor = random.uniform() < kPoorShare;
  const auto level = static_cast<Level>(std::min(2, static_cast<int>(random.uniform() * 3.0)));
  c.level = wish.level.value_or(c.kind == Kind::one || level != Level::weak ? level : Level::medium);
  if (wish.poor) c.poor = *wish.poor;
  for (c.thrown_away = 0; c.thrown_away < kMostDraws; ++c.thrown_away) {
    c.seed = seed_of_stream(own, static_cast<std::uint64_t>(c.thrown_away));
    if (!goes_on(progress, 0.1)) return c;
    if (drawn_once(random, c, wish, progress)) return c;
  }
  c.effects.clear();  // nothing that these drives can show
  c.significance.clear();
  c.kind = Kind::nothing;
  if (goes_on(progress, 0.1)) drawn_once(random, c, Wish{}, progress);
  return c;
}

}  // namespace odolab::concealed
