// What an entry of the catalogue is to the diagnosis: the motion that it adds, its parameters, and what to say of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/calibration/innovations.h"
#include "core/diagnosis/active_effect.h"
#include "core/diagnosis/effects/motions.h"
#include "core/diagnosis/found_parameter.h"

namespace odolab {

// One wheel interval as an effect sees it. Places and headings are those of the truth where there is one.
struct EffectStep {
  double time_s = 0.0, duration_s = 0.0;
  double since_start_s = 0.0;
  double left_m = 0.0, right_m = 0.0, turn_rad = 0.0;                 // as the wheels say, or as a base goes that lags
  double late_left_m = 0.0, late_right_m = 0.0, late_turn_rad = 0.0;  // so much of that is not what it was told
  double left_rad = 0.0, right_rad = 0.0;                             // rotation since the start, at the middle
  double left_by_rad = 0.0, right_by_rad = 0.0;                       // rotation during the interval
  double left_read_rad = 0.0, right_read_rad = 0.0;                   // the same as it was read
  double speed_mps = 0.0, yaw_rate_radps = 0.0;                       // smoothed over a few intervals
  double left_radps = 0.0, right_radps = 0.0;                         // smoothed wheel speeds
  double acceleration_mps2 = 0.0, yaw_acceleration_radps2 = 0.0;      // over 0.8 s
  double left_mps2 = 0.0, right_mps2 = 0.0;                           // of each rim, as quick as readings show
  double heading_rad = 0.0;
  double cos_heading = 1.0, sin_heading = 0.0;
  Vec2 position;

  double forward_m() const { return 0.5 * (left_m + right_m); }
  double rolled_m() const { return 0.5 * (std::abs(left_m) + std::abs(right_m)); }  // of a wheel, on the mean
  // As the commands say; of encoders no other than the way.
  double told_left_m() const { return left_m - late_left_m; }
  double told_right_m() const { return right_m - late_right_m; }
  double told_forward_m() const { return 0.5 * (told_left_m() + told_right_m()); }
  double told_turn_rad() const { return turn_rad - late_turn_rad; }
};

struct DriveView {
  int number = 0;  // of the recording
  std::string recording;
  DifferentialDrive drive;
  bool from_commands = false;
  std::vector<EffectStep> steps;
  double longest_step_m = 1e-9;  // that the axle's middle moves from one step to the next

  // The first step whose middle is not before that time; steps.size() where there is none.
  std::size_t step_at(double time_s) const;
  // Of each step, whether a wheel turns there or within a tenth of a second: slow wheels do not count at each reading.
  std::vector<char> turning() const;
  // Calls `visit(i)` for each step whose place is within so far of another, in order. Looks at few of the others.
  template <typename Visit>
  void steps_near(Vec2 place, double within_m, Visit&& visit) const {
    for (std::size_t i = 0; i < steps.size();) {
      const Vec2 to = steps[i].position - place;
      const double away_m = std::sqrt(dot(to, to)) - within_m;
      if (away_m <= 0.0) visit(i);
      i += away_m <= longest_step_m ? 1 : static_cast<std::size_t>(away_m / longest_step_m);
    }
  }
};

// How far the wheels went in an interval: as they were read, to say where the vehicle goes; smoothed, for derivatives,
// which must not answer to what a reading was rounded by. Speeds and accelerations are of smoothed readings in both.
enum class Way { as_read, smoothed };
// `truth_poses`: the axle's poses at those times, from the filter; empty where the place is dead reckoned.
DriveView drive_view(int number, const InnovationRun& run, const DifferentialDrive& drive, bool from_commands,
                     const Track& truth_poses, Way way = Way::as_read);

// The same drive as it was read. Commands are read as they are.
DriveView as_read(DriveView smoothed, const InnovationRun& run);

// The drive of a base that lags behind its commands by these motions: it comes to a place, to a bend and to rest as
// late as it goes, and whatever depends on its way or its speed acts then.
DriveView as_it_lags(DriveView by_commands, const Motions& lag);

enum class Wheel { left, right, both };
const char* component_of(Wheel wheel);
// The motion of a body whose wheel goes `extra_m` further.
BodyMotion by_wheel(Wheel wheel, double extra_m, double wheelbase_m);

// How far one wheel rolls in a step, and where on the floor it stands.
inline double way_of(const EffectStep& step, Wheel wheel) { return wheel == Wheel::left ? step.left_m : step.right_m; }
Vec2 place_of_wheel(const EffectStep& step, double wheelbase_m, Wheel wheel);

// Moments {recording, at_s} of all recordings in which something may have happened, this far apart and more in long
// ones, where `may_happen`. The first centimetres are left out: they take up whatever play there is.
std::vector<std::vector<double>> moments(const std::vector<DriveView>& views, double apart_s,
                                         const std::function<bool(const EffectStep&)>& may_happen);

// A shape that is given and not estimated: when the session of all recordings began.
inline constexpr const char* kSessionStart = "session_start_s";
// Of what grows with the speed, or by the way instead of by the time: the speed at which it is so much.
inline constexpr const char* kStatedAt = "at_mps";

inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

struct Effect {
  std::string name, component;
  struct Amplitude {
    std::string name, unit;
    double medium = 0.0;                          // a size that matters in practice: what "not testable" is judged by
    double low = -kUnbounded, high = kUnbounded;  // physical bounds
  };
  std::vector<Amplitude> amplitudes;  // the motion is linear in these
  std::vector<Amplitude> shapes;      // and not in these
  // Ways in which the same physics shows on different machines, the catalogue's own first. Where there are two or more,
  // the number of one stands behind the shapes.
  std::vector<std::string> forms;
  bool forms_come_to_one = false;  // they differ in when it happens alone, and not in how far it takes the vehicle
  std::vector<int>
      simpler_form;  // of each form the one to be said where that is not plainly less likely; empty: itself
  bool forms_have_sides = false;             // what one form calls left another may call right
  std::vector<int> forms_of_the_scan = {0};  // where many shapes are scanned, not in every form
  std::string sentence;                      // what it is, in words
  std::string regime;                        // where it acts, in words
  std::vector<std::string> looks_like;       // effects that it is easily taken for
  std::string told_apart_by;                 // and the drive that decides
  // One for each amplitude: the motion for a value of 1 at this shape; empty where there is none in that drive.
  std::function<std::vector<Motions>(const DriveView&, const std::vector<double>& shape)> motions;
  // Whether such amplitudes are more than whole counts can feign, beside what holds for all that happens in one place
  // or at one moment: that it carries a wheel by a count or more. Empty: anything is.
  std::function<bool(const std::vector<double>& value, const std::vector<double>& shape, double count_rad,
                     const std::vector<DriveView>& views)>
      beyond_counts;
  // Whether a form is one of such amplitudes, and told from the catalogue's own by more than a count; empty: any is.
  std::function<bool(const std::vector<double>& value, const std::vector<double>& shape, double count_rad,
                     const std::vector<DriveView>& views)>
      form_goes_with;
  // The speed at which these drives show a form whose amplitudes are those at 1 m/s, and grow with it; 0 for another
  // form. Empty: none is such a one.
  std::function<double(const std::vector<double>& shape, const std::vector<DriveView>& views)> stated_at_mps;
  // How well a place can be known at best, by its form; empty: to a centimetre.
  std::function<double(const std::vector<double>& shape)> place_known_to_m;
  // The share of what it does that lies so near a limit of its shape that a wheel's own noise decides whether it is
  // there: better than that its amplitudes are not known. Empty: none.
  std::function<double(const std::vector<double>& shape, const std::vector<DriveView>& views)> near_its_limit;
  // Shapes to try; empty function: there is no shape.
  std::function<std::vector<std::vector<double>>(const std::vector<DriveView>&)> scan;
  // Shapes from which it is looked for about a place where something else was found; empty: that place itself.
  std::function<std::vector<std::vector<double>>(Vec2 place)> shapes_about;
  // So many independent ones a scanned shape of one form stands for, once it is refined: more where there is much
  // between them, fewer where they are alike (test/tools/chance_of_names.cpp).
  double tests_of_a_shape = 1.0;
  bool shape_follows_amplitude = false;  // the only shape is the first amplitude itself, iterated to agreement
  bool local = false;                    // acts at a moment or place: its evidence lies in few samples
  bool of_one_recording = false;         // shape[0] is the recording's number
  bool and_later_recordings = false;     // the same, but it lasts through those after it
  bool happens_at_rest = false;          // mostly; its shape that is estimated is that time
  bool clock_rate = false;               // acts on the wheels' clock instead of the motion
  bool of_the_truth = false;             // its own doing: the vehicle does as it is told without it
  bool of_each_recording = false;        // an amplitude, or a set of them, for each recording in turn
  bool acts_on_motion() const { return !clock_rate && !of_the_truth; }
  bool lags_behind_commands() const { return only_commands && shape_follows_amplitude; }
  // The amplitude that is the rate of a recording's clock.
  std::size_t clock_amplitude(int recording) const {
    return of_each_recording ? static_cast<std::size_t>(recording) : 0;
  }
  bool only_commands = false;  // needs a base that is driven from commands

  // How the amplitudes read as the catalogue's parameters, with standard errors, and back. Left empty where they are
  // the same.
  std::function<std::vector<FoundParameter>(const std::vector<double>& value, const std::vector<double>& stderr_value)>
      to_parameters;
  std::function<std::vector<double>(const ActiveEffect&)> from_parameters;
  // And the estimated shapes, as a multiple of what they are beside such amplitudes; empty: as they are.
  std::function<double(const std::vector<double>& value)> shapes_read_as;
};

// Whether a shape of that name is estimated: neither the number of a recording nor a time that is given.
inline bool is_estimated(const Effect::Amplitude& shape) {
  return shape.name != "recording" && shape.name != kSessionStart;
}

// Of how long a line is only the ways that cross it and those that pass it tell: no more than bounds.
inline bool is_only_bounded(const Effect::Amplitude& shape) { return shape.name == "length_m"; }

// How far it reaches, and not where it is.
inline bool is_extent(const Effect::Amplitude& shape) { return shape.name == "radius_m" || shape.name == "length_m"; }

// A bump that is straight, and met wherever its line is crossed.
inline bool lies_across(const Effect& e) { return std::any_of(e.shapes.begin(), e.shapes.end(), is_only_bounded); }

// Every entry, once for each component that it can act on.
const std::vector<Effect>& catalogue();
// The entry of that name and component, or of that name alone, whose shapes are among the parameters.
const Effect* catalogue_entry(const ActiveEffect& active);

// The entries, one file each.
namespace effects {
// Of a drift in that form: whether it goes on from one recording to the next, and how soon it nears its end; 0: never.
bool drifts_through_the_session(int form);
double drift_time_constant_s(int form);
// When a load was put on: at that time, or, of recordings whose stamps go on from another's, so long after each began.
double put_on_s(double at_s, double recording_starts_s);
std::vector<Effect> wheel_eccentricity();
// The same where the runs start at other angles of the wheel: a phase of its own in each. Lives as long as the program.
const std::vector<Effect>& wheel_eccentricity_of_each_run(int runs);
std::vector<Effect> encoder_missed_counts();
std::vector<Effect> drivetrain_backlash();
std::vector<Effect> wheel_toe();
std::vector<Effect> castor_reversal_kick();
std::vector<Effect> radius_drift();
std::vector<Effect> tyre_compression();
std::vector<Effect> speed_dependent_radius();
std::vector<Effect> payload_radius_change();
std::vector<Effect> lateral_slip();
std::vector<Effect> traction_slip();
std::vector<Effect> turn_scrub();
std::vector<Effect> one_sided_drag();
std::vector<Effect> bump();
std::vector<Effect> bump_across();  // the way, as a cable: an entry "bump", too
std::vector<Effect> slip_zone();
std::vector<Effect> floor_slope_creep();
std::vector<Effect> collision();
std::vector<Effect> turn_speed_loss();
std::vector<Effect> clock_rate();
// The same where each recording's clock has a rate of its own. Lives as long as the program.
const std::vector<Effect>& clock_rate_of_each_run(int runs);
std::vector<Effect> truth_smoothing();
// The same where it shows at rest that the truth is smoothed, and after how long its noise is another: as little as any
// filter smooths that does so, whatever wheels and counts do by themselves, and no more than any. Lives as long as the
// program.
const Effect& truth_smoothing_seen_at_rest(double for_s);
std::vector<Effect> actuator_lag();
}  // namespace effects

}  // namespace odolab
