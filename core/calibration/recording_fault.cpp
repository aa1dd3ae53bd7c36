#include "core/calibration/recording_fault.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <string>
#include <tuple>

#include "core/base/parallel.h"
#include "core/base/quantile.h"
#include "core/calibration/raw_columns.h"
#include "core/calibration/run_fit.h"

namespace odolab {

namespace {

// Contradiction and agreement are far apart: no vehicle file is wrong by a factor of five, and half of the motion left
// unexplained is more than any floor does.
constexpr double kContradicted = 0.7, kAgreed = 0.9;
constexpr double kLeastWay = 0.2, kMostWay = 5.0, kLeastTurn = 0.1;
constexpr double kSigmasOfWay = 3.0;  // beyond which a way is not that long
constexpr double kAgreedWay = 2.0, kAgreedTurn = 2.5;

void scale(Recording& r, std::initializer_list<const char*> names, double by) {
  for (Channel& c : r.channels)
    for (const char* name : names)
      if (c.name == name)
        for (double& v : c.values) v *= by;
}

void exchange(Recording& r, const char* a, const char* b) {
  for (Channel& c : r.channels) {
    if (c.name == a)
      c.name = b;
    else if (c.name == b)
      c.name = a;
  }
}

void left_reversed(Recording& r) { scale(r, {"left_wheel_rad", "left_ticks"}, -1.0); }
void right_reversed(Recording& r) { scale(r, {"right_wheel_rad", "right_ticks"}, -1.0); }
void heading_scaled(Recording& r, double by) { scale(r, {"truth_heading_rad"}, by); }
void position_scaled(Recording& r, double by) { scale(r, {"truth_x_m", "truth_y_m"}, by); }

struct Mend {
  void (*apply)(Recording& r);
  const char* found;
  const char* expected;
  bool of_lengths = false;  // shows without turns and headings
};

const Mend kMends[] = {
    {[](Recording& r) { heading_scaled(r, kPi / 180.0); }, "truth_heading_rad that looks like degrees", "radians"},
    {[](Recording& r) { position_scaled(r, 1e-3); }, "truth_x_m and truth_y_m that look like millimetres", "metres",
     true},
    {[](Recording& r) { position_scaled(r, 1e-2); }, "truth_x_m and truth_y_m that look like centimetres", "metres",
     true},
    {[](Recording& r) { position_scaled(r, 1e-3), heading_scaled(r, kPi / 180.0); },
     "a truth that looks like millimetres and degrees", "metres and radians"},
    {[](Recording& r) {
       scale(r, {"left_wheel_rad", "right_wheel_rad"}, kPi / 180.0);
     },
     "left_wheel_rad and right_wheel_rad that look like degrees", "radians", true},
    {[](Recording& r) {
       scale(r, {"left_wheel_rad", "right_wheel_rad"}, 2.0 * kPi);
     },
     "left_wheel_rad and right_wheel_rad that look like whole turns", "radians", true},
    {[](Recording& r) { exchange(r, "left_wheel_rad", "right_wheel_rad"), exchange(r, "left_ticks", "right_ticks"); },
     "wheels that turn the robot the other way than the truth: left and right look exchanged, or the truth mirrored",
     "each wheel in its own column, and headings counter-clockwise"},
    {left_reversed, "a left wheel that rolls backward where the truth goes forward: its sign looks wrong",
     "rotation that grows forward"},
    {right_reversed, "a right wheel that rolls backward where the truth goes forward: its sign looks wrong",
     "rotation that grows forward"},
    {[](Recording& r) { left_reversed(r), right_reversed(r); },
     "wheels that roll backward where the truth goes forward: the sign of both looks wrong",
     "rotation that grows forward"},
    {[](Recording& r) { scale(r, {"truth_y_m"}, -1.0); },
     "positions that look mirrored against the headings (y, or x, with its sign reversed, or x and y exchanged)",
     "x forward, y left, headings counter-clockwise"},
    {[](Recording& r) { heading_scaled(r, -1.0); }, "truth_heading_rad that looks clockwise",
     "counter-clockwise headings"},
};

// Far from any agreement.
bool contradicts(const RunFit& f) {
  const double may_be_off = kSigmasOfWay * f.way_stderr;
  if (f.drives &&
      (f.way_explained < kContradicted || f.way_ratio + may_be_off < kLeastWay || f.way_ratio - may_be_off > kMostWay))
    return true;
  return f.turns && (f.turn_explained < kContradicted || f.turn_ratio < kLeastTurn);
}

bool agrees(const RunFit& f, bool lengths_suffice) {
  if (!f.drives || f.way_explained < kAgreed || std::abs(std::log(f.way_ratio)) > std::log(kAgreedWay)) return false;
  if (!f.turns) return lengths_suffice;
  return f.turn_explained > kAgreed && f.turn_ratio > 1.0 / kAgreedTurn && f.turn_ratio < kAgreedTurn;
}

// Wheels both reversed look like wheels exchanged on a robot whose truth points backward: the mounting decides.
double misfit_of_run(const RunFit& f, const Vehicle& nominal) {
  const double turned_rad = wrapped(f.axle_T_tracked.heading_rad - nominal.truth.axle_T_tracked.heading_rad);
  return 2.0 - f.way_explained - f.turn_explained + std::abs(std::log(f.way_ratio)) + std::abs(std::log(f.turn_ratio)) +
         std::abs(turned_rad);
}

// The one that mends it best; null where nothing is wrong or nothing mends it.
const Mend* mend_of(const Recording& recording, const Vehicle& nominal) {
  const std::optional<RunFit> as_it_is = run_fit(recording, nominal);
  if (!as_it_is || !contradicts(*as_it_is)) return nullptr;
  const Mend* best = nullptr;
  double least = 0.0;
  for (const Mend& mend : kMends) {
    Recording mended = recording;
    mend.apply(mended);
    const std::optional<RunFit> fit = run_fit(mended, nominal);
    if (!fit || !agrees(*fit, mend.of_lengths)) continue;
    if (best && misfit_of_run(*fit, nominal) >= least) continue;
    best = &mend;
    least = misfit_of_run(*fit, nominal);
  }
  return best;
}

std::string name_of_recording(const Recording& r) { return r.name.empty() ? "recording" : r.name; }

// A wheel that never turns though the truth carries it away from where it stood: no pivot does that.
std::optional<Error> dead_encoder(const Recording& recording, const Vehicle& nominal) {
  constexpr double kCarried_m = 0.5, kAllButOutliers = 0.9;
  constexpr std::size_t kFirst = 5;  // their median is where it stood, though one of them be an outlier
  const auto& drive = std::get<DifferentialDrive>(nominal.kind);
  const std::vector<WheelSample> wheels = wheel_samples(recording, drive);
  const std::vector<TruthSample> truth = truth_samples(recording);
  if (wheels.size() < 2 || truth.size() < 2) return std::nullopt;
  const auto stands = [&](double WheelSample::*rad) {
    return std::all_of(wheels.begin(), wheels.end(), [&](const WheelSample& w) { return w.*rad == wheels[0].*rad; });
  };
  const auto carried_m = [&](double to_the_left_m) {
    const Pose tracked_T_axle = inverse(nominal.truth.axle_T_tracked);
    std::vector<double> x_m, y_m, away_m;
    for (const TruthSample& t : truth) {
      if (!t.heading_rad) continue;
      const Pose tracked{t.position.x_m, t.position.y_m, *t.heading_rad};
      const Vec2 at = tracked * tracked_T_axle * Vec2{0.0, to_the_left_m};
      x_m.push_back(at.x_m), y_m.push_back(at.y_m);
    }
    if (x_m.empty()) return 0.0;
    const auto first = [](const std::vector<double>& of) {
      if (of.size() < kFirst) return of.front();
      return median(std::vector<double>(of.begin(), of.begin() + kFirst));
    };
    const Vec2 stood{first(x_m), first(y_m)};
    for (std::size_t i = 0; i < x_m.size(); ++i) away_m.push_back(length(Vec2{x_m[i], y_m[i]} - stood));
    return quantile(away_m, kAllButOutliers);
  };
  const double half_m = 0.5 * drive.wheelbase_m;
  for (const auto& [rad, to_the_left_m, name] :
       {std::tuple{&WheelSample::left_rad, half_m, "left"}, std::tuple{&WheelSample::right_rad, -half_m, "right"}})
    if (stands(rad) && carried_m(to_the_left_m) > kCarried_m)
      return Error{name_of_recording(recording),
                   std::string("a ") + name + " wheel that never turns where the truth carries it away",
                   "its rotation: the encoder is dead, or its column another one"};
  return std::nullopt;
}

// What shows of a recording alone.
std::optional<Error> own_fault(const Recording& recording, const Vehicle& nominal) {
  std::optional<Error> of_column = stamps_in_no_seconds(recording);
  if (!of_column) of_column = unknown_wrap(recording, std::get<DifferentialDrive>(nominal.kind));
  if (!of_column) return dead_encoder(recording, nominal);
  of_column->where = name_of_recording(recording) + ": " + of_column->where;
  return of_column;
}

Error error_to_mend(const Mend& mend, const std::string& where) { return {where, mend.found, mend.expected}; }

bool can_be_judged(const Recording& r, const Vehicle& nominal) {
  return std::holds_alternative<DifferentialDrive>(nominal.kind) && problems_in(r).empty();
}

}  // namespace

std::optional<Error> fault_in(const Recording& recording, const Vehicle& nominal) {
  if (!can_be_judged(recording, nominal)) return std::nullopt;
  if (std::optional<Error> own = own_fault(recording, nominal)) return own;
  const Mend* mend = mend_of(recording, nominal);
  if (!mend) return std::nullopt;
  return error_to_mend(*mend, name_of_recording(recording));
}

std::vector<std::optional<Error>> faults_in(const std::vector<Recording>& recordings, const Vehicle& nominal) {
  std::vector<const Mend*> mends(recordings.size(), nullptr);
  parallel_for(static_cast<int>(recordings.size()), [&](int i) {
    const auto r = static_cast<std::size_t>(i);
    if (can_be_judged(recordings[r], nominal)) mends[r] = mend_of(recordings[r], nominal);
  });
  const bool all_alike = mends.size() > 1 && std::count(mends.begin(), mends.end(), mends.front()) ==
                                                 static_cast<std::ptrdiff_t>(mends.size());
  std::vector<std::optional<Error>> faults;
  for (std::size_t i = 0; i < mends.size(); ++i) {
    faults.emplace_back();
    if (can_be_judged(recordings[i], nominal)) faults.back() = own_fault(recordings[i], nominal);
    if (mends[i] && !faults.back())
      faults.back() = error_to_mend(*mends[i], all_alike ? kEveryRecording : name_of_recording(recordings[i]));
  }
  return faults;
}

}  // namespace odolab
