// The ways in which an effect shows (README, "Forms"), by number, as the planar world plays them too
// (physics/effects/README.md). The catalogue's own stands first.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace odolab::effects {

enum class KickCourse { evenly, fading, of_a_castor, shortly };
struct KickForm {
  const char* in_words;
  bool to_one_side;
  KickCourse course;
  double length_m = 0.0;  // over which it is even, or falls to a third; or a castor's trail
};
inline constexpr KickForm kKickForms[] = {
    {"always to the same side, within 5 cm of way", true, KickCourse::evenly, 0.05},
    {"to one side forwards and the other in reverse, within 5 cm", false, KickCourse::evenly, 0.05},
    {"always to the same side, within 20 cm", true, KickCourse::evenly, 0.2},
    {"to one side forwards and the other in reverse, within 20 cm", false, KickCourse::evenly, 0.2},
    {"always to the same side, at once", true, KickCourse::evenly, 0.001},
    {"to one side forwards and the other in reverse, at once", false, KickCourse::evenly, 0.001},
    {"always to the same side, as a castor of 2 cm trail swings", true, KickCourse::of_a_castor, 0.02},
    {"to one side forwards and the other in reverse, as a castor of 2 cm trail swings", false, KickCourse::of_a_castor,
     0.02},
    {"always to the same side, as a castor of 5 cm trail swings", true, KickCourse::of_a_castor, 0.05},
    {"to one side forwards and the other in reverse, as a castor of 5 cm trail swings", false, KickCourse::of_a_castor,
     0.05},
    {"always to the same side, as a castor of 3 cm trail swings", true, KickCourse::of_a_castor, 0.032},
    {"to one side forwards and the other in reverse, as a castor of 3 cm trail swings", false, KickCourse::of_a_castor,
     0.032},
    {"always to the same side, within 0.15 s, also of a stop that swings back", true, KickCourse::shortly},
    {"always to the same side, fading over 7 cm of way", true, KickCourse::fading, 0.07},
    {"to one side forwards and the other in reverse, fading over 7 cm", false, KickCourse::fading, 0.07},
    {"always to the same side, fading over 2 cm of way", true, KickCourse::fading, 0.02},
    {"to one side forwards and the other in reverse, fading over 2 cm", false, KickCourse::fading, 0.02},
};
// Of a castor that was turned about: the sine of what it is off half a turn, by which it is pushed off at all; and of
// half a turn, so near it is round.
inline constexpr double kCastorOff = 0.06, kCastorRound = 0.02;
inline constexpr double kShortKick_s = 0.15, kLeastSwing_mps = 0.01;  // a stop that swings back faster reverses

// What a wheel pushes with is its share of the vehicle's mass times the vehicle's acceleration, and the moment of
// inertia's part of it where the vehicle turns more quickly: `of_turning` is that part beside what it would be if the
// mass stood over the wheels, 4 I / (m b^2), some 0.6 for a body as long as it is wide and 0 for a mast. `of_bends`:
// a mass that stands ahead of the axle by d is held in a bend by wheels that push unlike each other, by m d v w in all
// about the axle's middle: 2 d / b of the lateral acceleration at either wheel. `gives_way_s_per_mps`: a vehicle whose
// wheels slip speeds up by less than they do, s' = k v (a - s'') of the way s that is lost, so that s' stays behind
// k v a by k v; and by what a tyre's relaxation length takes (Pacejka, Tyre and Vehicle Dynamics, section 1.1).
// That length sigma is some 0.3 to 1 of a wheel's radius. A tread that is deflected by u pushes m a = C u / sigma, and
// u' = s' - |v| u / sigma: so beside k |v| a the vehicle stays behind by k sigma a for as long as it is pushed
// (`yields_radii`: sigma). Where it is held back by that, s'' = a - u / (k sigma), and it swings.
// Where the slip is what a push makes it and only builds up over a way, as a brush does that is not pulled along, it is
// sigma dk / dx = k a - kappa (`builds_up_radii`).
struct TractionForm {
  const char* in_words;
  double of_turning, of_bends;
  std::optional<double> gives_way_s_per_mps = std::nullopt;
  double yields_radii = 0.0, builds_up_radii = 0.0;
};
inline constexpr double kTyreRelaxes_s = 0.03;
inline constexpr TractionForm kTractionForms[] = {
    {"each wheel by its own acceleration", 1.0, 0.0},
    {"the vehicle by its acceleration", 0.0, 0.0},
    {"each wheel by what it pushes of a body as long as it is wide", 0.6, 0.0},
    {"each wheel by its own acceleration, which it gives way to a little later", 1.0, 0.0, 0.0},
    {"each wheel by its own acceleration, which slip of 4 % per m/s2 holds back", 1.0, 0.0, 0.04},
    {"each wheel by its own acceleration, which slip of 8 % per m/s2 holds back", 1.0, 0.0, 0.08},
    {"each wheel by its own acceleration, which slip of 16 % per m/s2 holds back", 1.0, 0.0, 0.16},
    {"each wheel by what it pushes of a body whose mass stands ahead of the axle", 0.6, 0.3},
    {"each wheel by what it pushes of a body whose mass stands well ahead of the axle", 0.6, 0.6},
    {"each wheel by what it pushes of a body whose mass stands behind the axle", 0.6, -0.4},
    {"each wheel by what it pushes, on a tread that yields over 0.35 of its radius", 0.6, 0.0, {}, 0.35},
    {"each wheel by what it pushes, on a tread that yields over 0.7 of its radius", 0.6, 0.0, {}, 0.7},
    {"each wheel on treads that yield over 0.35 of its radius and swing as at 1.5 % per m/s2", 1.0, 0.0, 0.015, 0.35},
    {"each wheel on treads that yield over 0.35 of its radius and swing as at 3 % per m/s2", 1.0, 0.0, 0.03, 0.35},
    {"each wheel on treads that yield over 0.35 of its radius and swing as at 6 % per m/s2", 1.0, 0.0, 0.06, 0.35},
    {"each wheel on treads that yield over 0.35 of its radius and swing as at 12 % per m/s2", 1.0, 0.0, 0.12, 0.35},
    {"each wheel on treads that yield over 0.7 of its radius and swing as at 1.5 % per m/s2", 1.0, 0.0, 0.015, 0.7},
    {"each wheel on treads that yield over 0.7 of its radius and swing as at 3 % per m/s2", 1.0, 0.0, 0.03, 0.7},
    {"each wheel on treads that yield over 0.7 of its radius and swing as at 6 % per m/s2", 1.0, 0.0, 0.06, 0.7},
    {"each wheel on treads that yield over 0.7 of its radius and swing as at 12 % per m/s2", 1.0, 0.0, 0.12, 0.7},
    {"each wheel by its own acceleration, built up over 0.15 of its radius", 1.0, 0.0, {}, 0.0, 0.15},
    {"each wheel by its own acceleration, built up over 0.4 of its radius", 1.0, 0.0, {}, 0.0, 0.4},
    {"the vehicle by its acceleration, built up over 0.4 of a wheel's radius", 0.0, 0.0, {}, 0.0, 0.4},
};

// How a wheel runs while neither flank of the play touches, braked by so much until it stands; and over what turn at
// least the play is crossed by a drive that yields: a swing back at a stop by less crosses it in part.
inline constexpr double kAtOnce = 0.0, kStiff_rad = 1e-4;
struct PlayForm {
  const char* in_words;
  double drag_mps2 = kAtOnce, yields_rad = kStiff_rad;
};
inline constexpr PlayForm kPlayForms[] = {
    {"engaged at the start"},
    {"in the middle of the play at the start"},
    {"crossed too where it brakes harder than 0.05 m/s2", 0.05},
    {"crossed too where it brakes harder than 0.08 m/s2", 0.08},
    {"crossed too where it brakes harder than 0.12 m/s2", 0.12},
    {"crossed too where it brakes harder than 0.18 m/s2", 0.18},
    {"crossed too where it brakes harder than 0.25 m/s2", 0.25},
    {"crossed too where it brakes harder than 0.35 m/s2", 0.35},
    {"crossed too where it brakes harder than 0.5 m/s2", 0.5},
    {"crossed over a turn of 0.04 rad, as of a drive that yields", kAtOnce, 0.04},
    {"crossed over a turn of 0.12 rad, as of a drive that yields more", kAtOnce, 0.12},
};
inline constexpr std::size_t kMiddleAtTheStart = 1;

struct LateralSlipForm {
  const char* in_words;
  bool at_an_angle;
  double settles_s = 0.0;
};
inline constexpr LateralSlipForm kLateralSlipForms[] = {
    {"at a speed in proportion to the lateral acceleration", false},
    {"at an angle in proportion to it", true},
    {"at a speed in proportion to it, which it comes to within 0.06 s", false, 0.06},
    {"at a speed in proportion to it, which it comes to within 0.1 s", false, 0.1},
    {"at a speed in proportion to it, which it comes to within 0.17 s", false, 0.17},
    {"at a speed in proportion to it, which it comes to within 0.28 s", false, 0.28},
};

// What of its load the inner tyre gives away, as a share of what the outer one takes: none where it hardly bears any,
// all where tyres are springs that are squeezed already. And how long the body takes to roll over.
struct TyreForm {
  const char* in_words;
  double inner_relieved;
  double rolls_over_s = 0.0;
};
inline constexpr TyreForm kTyreForms[] = {
    {"the outer tyre alone", 0.0},
    {"the outer tyre is squeezed and the inner one relieved", 1.0},
    {"the outer tyre is squeezed and the inner one relieved by half of that", 0.5},
    {"the outer tyre alone, as the body rolls over within 0.12 s", 0.0, 0.12},
    {"the outer tyre is squeezed and the inner one relieved, as the body rolls over within 0.12 s", 1.0, 0.12},
    {"the inner tyre relieved by half, as the body rolls over within 0.12 s", 0.5, 0.12},
    {"the outer tyre alone, as the body rolls over within 0.25 s", 0.0, 0.25},
    {"the outer tyre is squeezed and the inner one relieved, as the body rolls over within 0.25 s", 1.0, 0.25},
    {"the inner tyre relieved by half, as the body rolls over within 0.25 s", 0.5, 0.25},
};

// What reads an encoder does not fall behind at one speed of a wheel: between so much below it and above it, as a share
// of it, the share that is lost rises from none to all.
struct MissedForm {
  const char* in_words;
  double within = 0.0;
  double share(double speed_radps, double limit_radps) const {
    if (within <= 0.0) return speed_radps > limit_radps ? 1.0 : 0.0;
    return std::min(1.0, std::max(0.0, 0.5 + 0.5 * (speed_radps / limit_radps - 1.0) / within));
  }
};
inline constexpr MissedForm kMissedForms[] = {
    {"at once above that speed"},
    {"the more the faster, from 5 % below that speed to 5 % above it", 0.05},
    {"the more the faster, from 12 % below that speed to 12 % above it", 0.12},
};

// What a drift that begins at one for each second, or metre, comes to after so many: less than these where it nears an
// end, with that constant; 0: for ever.
inline double drifted(double so_far, double constant) {
  return constant > 0.0 ? constant * -std::expm1(-so_far / constant) : so_far;
}

// By the time, or by the way that the wheel has rolled since the recording began.
struct DriftForm {
  const char* in_words;
  bool through_the_session;
  double time_constant_s;  // 0: for ever
  bool by_way = false;
  double way_constant_m = 0.0;  // 0: for ever
};
inline constexpr DriftForm kDriftForms[] = {
    {"anew in each recording", false, 0.0},
    {"on through all recordings, by their stamps", true, 0.0},
    {"anew in each recording, towards an end that is half reached after 40 s", false, 60.0},
    {"on through all recordings, by their stamps, towards an end that is half reached after 40 s", true, 60.0},
    {"on through all recordings, by their stamps, towards an end that is half reached after three minutes", true,
     240.0},
    {"with the way that a wheel rolls, anew in each recording", false, 0.0, true},
    {"with the way that a wheel rolls, anew in each recording, towards an end that is half reached after 2 m", false,
     0.0, true, 2.9},
    {"with the way that a wheel rolls, anew in each recording, towards an end that is half reached after 4 m", false,
     0.0, true, 5.8},
    {"with the way that a wheel rolls, anew in each recording, towards an end that is half reached after 8 m", false,
     0.0, true, 11.5},
    {"with the way that a wheel rolls, anew in each recording, towards an end that is half reached after 16 m", false,
     0.0, true, 23.0},
};

// The share by which a rolling radius grows, at a speed of so many metres a second.
struct SpeedForm {
  const char* in_words;
  bool of_the_vehicle;  // and not of each wheel
  bool squared = false;
  double share(double speed_mps) const { return squared ? speed_mps * speed_mps : std::abs(speed_mps); }
};
inline constexpr SpeedForm kSpeedForms[] = {
    {"with each wheel's own speed", false},
    {"with the vehicle's speed", true},
    {"with the square of each wheel's own speed", false, true},
};

// How the extra distance over a bump is rolled: evenly over so much of the way, or as a wheel of radius r climbs
// something that takes it e further: up and down at angles that are steepest where it meets it and leaves it.
struct Climb {
  double evenly_over_m = 0.0, e_m = 0.0;

  // A wheel that turns by the angle a to either side of something's top goes r sin a and rolls r a, so that e = 2 r (a
  // - sin a), which is r a^3 / 3, and its way 2 r a: the cube of that is 24 r^2 e.
  double length_m(double r_m) const { return e_m > 0.0 ? std::cbrt(24.0 * r_m * r_m * e_m) : evenly_over_m; }
  // Of the extra distance; of the length. At u from the top it rolls 1 / cos a - 1 further for each metre, with sin a =
  // u / r: that is u^2 / (2 r^2).
  double share_before(double share_of_way) const {
    if (e_m <= 0.0) return share_of_way;
    const double u = 2.0 * share_of_way - 1.0;
    return 0.5 * (1.0 + u * u * u);
  }
};
inline constexpr Climb kBumpsOnce[] = {{0.06}, {0.02}, {0.2}, {0.1}, {0.0, 0.004}, {0.0, 0.015}};
inline constexpr double kLongestBump_s = 1.0;  // to either side of its moment

// Something that both wheels climb, as a sill: the right one so much further on its way than the left one.
struct ClimbOfBoth {
  const char* in_words;
  Climb climb;
  double right_later_m = 0.0;
};
inline constexpr ClimbOfBoth kBumpsOfBoth[] = {
    {"by both at once, over 6 cm of way", {0.06}},    {"by both at once, over 20 cm", {0.2}},
    {"by the right wheel 4 cm later", {0.06}, 0.04},  {"by the left wheel 4 cm later", {0.06}, -0.04},
    {"by the right wheel 8 cm later", {0.06}, 0.08},  {"by the left wheel 8 cm later", {0.06}, -0.08},
    {"by the right wheel 14 cm later", {0.06}, 0.14}, {"by the left wheel 14 cm later", {0.06}, -0.14},
};

// What lies at a place: met within so far of it, and climbed so, in its middle or at its edge; no length: as long as it
// is met. Of a mound a wheel that crosses it beside its middle climbs less, as its way over it is shorter.
struct Lying {
  double reach_m;
  Climb climb;
  bool at_its_edge = false, is_mound = false;
};
inline constexpr Lying kBumpsLying[] = {
    {0.1, {0.06}},           {0.05, {0.06}},          {0.2, {0.06}},          {0.1, {0.1}},
    {0.1, {0.0, 0.004}},     {0.1, {0.0, 0.015}},     {0.1, {0.06}, true},    {0.1, {}},
    {0.04, {}, false, true}, {0.08, {}, false, true}, {0.14, {}, false, true}};
inline constexpr std::size_t kLyingAsLongAsWide = 7;

// What lies across the way, as a cable or a sill, is climbed so wherever a wheel crosses it.
inline constexpr Climb kCablesClimbed[] = {{0.06}, {0.2}, {0.0, 0.004}, {0.0, 0.015}};
// What reaches no further to either side, in radii of a wheel, is something that it climbs; and what does is a patch.
inline constexpr double kClimbedWithin = 1.5;

inline constexpr double kCollisionLasts_s[] = {0.0, 0.25, 0.5};
inline constexpr double kTurningWithin_s = 0.1;  // slow wheels do not count at each reading

}  // namespace odolab::effects
