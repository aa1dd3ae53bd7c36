#include "core/diagnosis/generic/adequacy.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "core/base/chi_square.h"
#include "core/base/parallel.h"
#include "core/diagnosis/generic/unnamed_group.h"
#include "core/diagnosis/model/driven_again.h"
#include "core/diagnosis/naming/lag_and_delay.h"
#include "core/diagnosis/naming/material.h"
#include "core/diagnosis/naming/own_noise.h"

namespace odolab {

namespace {

// Whether dead reckoning is no better with a group that was let in.
bool is_no_better(const JointModel& without, const JointModel& with, const GenericTest& g) {
  return !is_material(1.0, without.truth_noise_lasts, without.gathered_error(), with.gathered_error(),
                      g.test.value.size());
}

// Whether it goes with the turns of a wheel that is named out of round: gears come with it, and in its place say no
// more of where the vehicle goes.
bool is_ripple_of_a_named_wheel(const GenericTest& g, const std::vector<ScoredCandidate>& evidence) {
  return g.times_a_turn > 0.0 && std::any_of(evidence.begin(), evidence.end(), [&](const ScoredCandidate& e) {
           return e.effect->name == "wheel_eccentricity" && e.effect->component == g.component;
         });
}

// Of the error of dead reckoning, what may stay without a name where innovations are correlated.
constexpr double kMostLeftOfError = 0.3;
// A group of which the name is one form bends to what the name only nearly says: by so much more it must say.
constexpr double kFormOfAName = 0.5;
constexpr double kTwoExplain = 0.85;  // share of the evidence that the two strongest of three names must have
constexpr double kAsMuchAsNames = 0.5;
constexpr std::size_t kMostTried = 4;
constexpr double kEvenly = 0.05;  // turns of a wheel: as often a turn

// Lets a group of generic terms in; twice what the log-likelihood gains by it.
double let_in(JointModel& joint, const GenericTest& group) {
  joint.accepted.push_back({.effect = group.as_effect.get(),
                            .shape = {},
                            .value = std::vector<double>(group.test.value.size(), 0.0),
                            .is_damped = true});
  return joint.fit(2);
}

// What comes nearest to being said is asked once more under the noise that it leaves: of what chance would make one of
// all that is asked, anyway, that never made a name.
void look_again(const JointModel& joint, std::vector<GenericTest>& generic, double error) {
  constexpr std::size_t kMost = 2;
  constexpr double kWorthALook = 1.0;  // standard errors of the statistic, beyond chance
  const auto beyond = [](const GenericTest* g) {
    const double f = g->test.freedom;
    return (g->test.judged() - f) / std::sqrt(2.0 * std::max(1.0, f));
  };
  std::vector<GenericTest*> nearest;
  for (GenericTest& g : generic)
    if (g.test.freedom > 0 && g.p_value >= error && g.p_value < 1.0 && beyond(&g) > kWorthALook) nearest.push_back(&g);
  std::stable_sort(nearest.begin(), nearest.end(), [&](const auto* a, const auto* b) { return beyond(a) > beyond(b); });
  if (nearest.size() > kMost) nearest.resize(kMost);
  if (joint.driven_again && !nearest.empty()) joint.driven_again->drive();
  parallel_for(static_cast<int>(nearest.size()), [&](int i) {
    GenericTest& g = *nearest[static_cast<std::size_t>(i)];
    JointModel with = joint;
    let_in(with, g);
    CandidateTest again = tested_under_own_noise(joint, with, true, kAskedOfGeneric);
    if (again.freedom != g.test.freedom) return;
    if (joint.driven_again)
      again.widen(joint.driven_again->feigned(*g.as_effect, {}, with.model.noise, kAskedOfGeneric));
    if (again.judged() < g.test.judged()) return;
    g.under_own_noise = again.statistic / g.test.statistic;
    g.test = again;
    g.p_value = g.p_value_of(g.test);
  });
}

std::vector<const GenericTest*> strongest_first(const std::vector<GenericTest>& generic, double error) {
  std::vector<const GenericTest*> strong;
  for (const GenericTest& g : generic)
    if (g.p_value < error && g.test.cross_validated > 0.0) strong.push_back(&g);
  std::stable_sort(strong.begin(), strong.end(),
                   [](const GenericTest* a, const GenericTest* b) { return a->test.judged() > b->test.judged(); });
  if (strong.size() > kMostTried) strong.resize(kMostTried);
  return strong;
}

struct Left {
  const GenericTest* group = nullptr;
  std::optional<JointModel> with;  // that group, too
  std::vector<Response> shape;
};

// A base that is driven by its commands follows them in its own way, whatever else is missing: that may stay where
// names go.
enum class Base { stays, goes };
bool is_of_the_base(const Effect& effect) { return effect.only_commands; }
bool is_held_against(const AcceptedEffect& a, Base base) {
  return a.acts_on_motion() && (base == Base::goes || !is_of_the_base(*a.effect));
}

std::ptrdiff_t names_held_against(const JointModel& joint, Base base) {
  return std::count_if(joint.accepted.begin(), joint.accepted.end(),
                       [&](const AcceptedEffect& a) { return is_held_against(a, base); });
}

JointModel without_names(JointModel joint, Base base) {
  std::erase_if(joint.accepted, [&](const AcceptedEffect& a) { return is_held_against(a, base); });
  joint.fit(3);
  return joint;
}

// The strongest group that is significant and keeps, once it is fitted, what its score promised: near what calibration
// does anyway a score can promise without end.
Left what_is_left(const JointModel& joint, const std::vector<GenericTest>& generic, double error) {
  for (const GenericTest* g : strongest_first(generic, error)) {
    JointModel with = joint;
    const double kept = let_in(with, *g) * g->under_own_noise;
    const double p = scaled_chi_square_tail(kept / g->test.inflation, g->test.freedom, g->test.batches) * g->tests;
    if (p >= error) continue;
    if (g->curves.empty()) return {g, std::move(with), {}};
    // Beside names it would be drawn without what these have taken of it.
    JointModel alone = without_names(joint, Base::stays);
    let_in(alone, *g);
    alone.fit_noise_and_all();
    return {g, std::move(with), shape_of(*g, alone)};
  }
  return {};
}

// Significant is not enough: where the innovations are correlated dead reckoning must be the better for it, and nowhere
// may it be so good already that no floor or camera could tell.
bool is_worth_saying(const JointModel& joint, const JointModel& calibrated, const GenericTest& left) {
  const double distrust = joint.distrust();
  if (distrust == 0.0) return !is_nothing(joint.gathered_error());
  JointModel with = joint;
  let_in(with, left);
  // What whitens the innovations, or nearly, was what correlated them: a soft mast that leans moves no metre of dead
  // reckoning.
  constexpr double kNearly = 0.25;
  JointModel whitened = with;
  whitened.fit_noise_and_all();
  if (whitened.distrust() <= kNearly * distrust) return !is_nothing(joint.gathered_error());
  const JointModel::GatheredError at_first = calibrated.gathered_error(), named_only = joint.gathered_error(),
                                  with_more = with.gathered_error();
  if (!is_material(joint, named_only, with_more)) return false;
  // And it counts against the names only by its share of what dead reckoning gains.
  if (at_first.windows == 0 || at_first.position_m2 <= 0.0 || at_first.heading_rad2 <= 0.0) return true;
  const auto share = [&](const JointModel::GatheredError& e) {
    return 0.5 * (e.position_m2 / at_first.position_m2 + e.heading_rad2 / at_first.heading_rad2);
  };
  const double more = share(named_only) - share(with_more), in_all = 1.0 - share(with_more);
  return in_all <= 0.0 || more >= distrust * kMostLeftOfError * in_all;
}

// Whether dead reckoning by the names errs by more than twice what noise makes of it, and with the group by less than
// 0.7 of that: however much the names say, an expert who looks at it does not stop there. Of the sets of four seeds of
// two programs in which one effect was rightly named one left as much.
bool leaves_more_than_noise(const JointModel& joint, const JointModel& with) {
  constexpr double kTwice = 4.0, kMended = 0.5;  // of squares
  const JointModel::GatheredError left = joint.gathered_error(), mended = with.gathered_error();
  const auto is_left = [](double square, double of_noise, double of_mended) {
    return square > kTwice * of_noise && of_mended < kMended * square;
  };
  return left.windows > 0 && (is_left(left.position_m2, left.noise_position_m2, mended.position_m2) ||
                              is_left(left.heading_rad2, left.noise_heading_rad2, mended.heading_rad2));
}

// Several causes that explain it only together are more likely one that has no name here.
bool is_in_pieces(const std::vector<ScoredCandidate>& evidence) {
  std::vector<double> share;
  double all = 0.0;
  for (const ScoredCandidate& e : evidence) share.push_back(e.test.statistic), all += e.test.statistic;
  std::sort(share.rbegin(), share.rend());
  return share.size() > 2 && share[0] + share[1] < kTwoExplain * all;
}

// By how much chance alone makes terms seem to explain that were chosen from so many.
double by_chance(double freedom, double log_tests) { return freedom + 2.0 * log_tests; }

// What names explain beyond what so many tries, places and times do by chance.
double beyond_chance(const std::vector<ScoredCandidate>& evidence) {
  double sum = 0.0;
  for (const ScoredCandidate& e : evidence) sum += e.test.judged() - by_chance(e.test.freedom, e.log_tests);
  return sum;
}

double said_by(const std::vector<ScoredCandidate>& evidence) {
  double sum = 0.0;
  for (const ScoredCandidate& e : evidence) sum += e.test.statistic;
  return sum;
}

// Whether the strongest name is but one form of a group: with the group let in little of it is left to be seen.
bool names_its_form(const JointModel& bare, const JointModel& with_group,
                    const std::vector<ScoredCandidate>& evidence) {
  constexpr double kLeft = 0.3;
  const auto& name = *std::max_element(evidence.begin(), evidence.end(), [](const auto& a, const auto& b) {
    return a.test.statistic < b.test.statistic;
  });
  const auto survives = [&](const JointModel& j) {
    return j.test(j.columns_of(*name.effect, name.test.shape)).survives;
  };
  return survives(with_group) < kLeft * survives(bare);
}

struct InPlaceOfNames {
  std::optional<Unnamed> says_more, as_much;
};

// What groups without a name say in the place of all names, of which those of the base may stay. One says more than
// they, chance and a name's imperfect form allowed for; or so nearly as much that neither beats the other, and is not
// the same in other words.
InPlaceOfNames in_place_of_names(const JointModel& joint, std::vector<ScoredCandidate> evidence, Base base,
                                 double error) {
  const JointModel bare = without_names(joint, base);
  JointModel named = bare;
  double by_form_of_base = 0.0;
  if (base == Base::stays)
    std::erase_if(evidence, [&](const ScoredCandidate& e) {
      if (!is_of_the_base(*e.effect)) return false;
      by_form_of_base += kMostLeft * e.test.statistic;
      return true;
    });
  double said = 0.0, looked_for = 0.0;
  if (std::any_of(joint.accepted.begin(), joint.accepted.end(),
                  [&](const AcceptedEffect& a) { return a.is_held && is_held_against(a, base); })) {
    named = joint;  // fits from nothing do not find it
    said = likelier_by(joint, bare);
  } else {
    for (const AcceptedEffect& a : joint.accepted)
      if (is_held_against(a, base))
        named.accepted.push_back({a.effect, a.shape, std::vector<double>(a.value.size(), 0.0)});
    said = named.fit(3);
  }
  for (const ScoredCandidate& e : evidence) looked_for += 2.0 * e.log_tests;
  const double by_names = std::max(0.0, said - looked_for);
  double fair = beyond_chance(evidence);
  // Near where it stands a lag looks like a clock, and its test says little of what goes with it.
  if (names_held_against(joint, base) > names_held_against(joint, Base::stays)) fair = std::max(fair, by_names);
  std::vector<GenericTest> generic = generic_tests(bare);
  // Several pushes may be one thing that lies across the floor.
  const bool are_moments = evidence.size() > 1 && std::all_of(evidence.begin(), evidence.end(), [](const auto& e) {
                             return e.effect->local && e.effect->of_one_recording;
                           });
  std::erase_if(generic,
                [&](const GenericTest& g) { return g.carries_nowhere || (g.is_no_rival_of_names && !are_moments); });
  const auto by_form = [&](const GenericTest& g) { return g.of_when_or_where ? 0.0 : by_form_of_base; };
  const auto beyond = [&](const GenericTest& g, double gain, double margin) {
    return gain - by_form(g) - (1.0 + margin) * by_names;
  };
  const auto is_more = [&](const GenericTest& g, double gain, double margin = kMostLeft) {
    return scaled_chi_square_tail(beyond(g, gain, margin) / g.test.inflation, g.test.freedom, g.test.batches) *
               g.tests <
           error;
  };
  const auto is_as_much = [&](const GenericTest& g, double gain) {
    return (gain - by_form(g)) / g.test.inflation - by_chance(g.test.freedom, std::log(g.tests)) >
           fair - kClearlyBeaten;
  };
  const bool correlated = bare.distrust() > 0.0;
  InPlaceOfNames out;
  for (const GenericTest* g : strongest_first(generic, error)) {
    if (!is_more(*g, g->test.statistic) && !is_as_much(*g, g->test.statistic)) continue;
    JointModel with = bare;
    const double kept = let_in(with, *g);
    if (correlated && !is_material(joint, named.gathered_error(), with.gathered_error())) continue;
    if (is_ripple_of_a_named_wheel(*g, evidence) && is_no_better(bare, with, *g)) continue;
    const bool says_more = is_more(*g, kept);
    if (!says_more && !is_as_much(*g, kept)) continue;
    // One number in the place of several names bends to nothing.
    const double clearly = evidence.size() > 1 ? 0.0 : kClearlyBeaten * g->test.inflation;
    const bool is_simplest = g->test.freedom == 1 && kept > by_names + clearly;
    if (!is_simplest && !is_more(*g, kept, kFormOfAName) && names_its_form(bare, with, evidence)) continue;
    std::optional<Unnamed>& which = says_more ? out.says_more : out.as_much;
    const double more = says_more ? beyond(*g, kept, kMostLeft) : kept;
    if (!which || more > which->gain) which = unnamed_by(*g, with, bare, shape_of(*g, with), more);
  }
  return out;
}

const GenericTest* clearest_sway(const std::vector<GenericTest>& generic, double error) {
  const GenericTest* clearest = nullptr;
  for (const GenericTest& g : generic)
    if (g.sway && g.sway->p_value < (clearest ? clearest->sway->p_value : error)) clearest = &g;
  return clearest;
}

// In no list it is, be it the vehicle or the truth that sways.
Unnamed unnamed_sway(const JointModel& joint, GenericTest group) {
  group.test = group.sway->test;
  group.p_value = group.sway->p_value;
  JointModel with = joint;
  let_in(with, group);
  Unnamed u = unnamed_by(group, with, joint, {},
                         std::max(0.0, group.test.statistic - group.test.freedom * group.test.inflation));
  u.where.regime += ", unless the truth sways so by itself";
  return u;
}

// Of the way, where values are sines and cosines.
double amplitude_of(const std::vector<double>& value) {
  double square = 0.0;
  for (double v : value) square += 2.0 * v * v / static_cast<double>(value.size());
  return std::sqrt(square);
}

// A wheel that is found out of round, and is uneven nearly as much twice or three times a turn, is not out of round but
// has a flat or a dent, which no name describes. Gears before it come evenly often a turn only by chance.
bool is_shape_of_a_named_wheel(const JointModel& joint, const GenericTest& g) {
  constexpr double kNearlyAsMuch = 0.5;
  const double times = std::round(g.times_a_turn);
  if (times < 2.0 || std::abs(g.times_a_turn - times) > kEvenly) return false;
  return std::any_of(joint.accepted.begin(), joint.accepted.end(), [&](const AcceptedEffect& a) {
    if (a.effect->name != "wheel_eccentricity") return false;
    const char* wheel = a.effect->component == component_of(Wheel::left) ? "left wheel" : "right wheel";
    return g.channel.find(wheel) != std::string::npos &&
           amplitude_of(g.test.value) > kNearlyAsMuch * amplitude_of(a.value);
  });
}

// Takes out what comes and goes too soon to carry the vehicle anywhere, and what goes with a wheel's turns and makes
// dead reckoning no better.
std::vector<Adequacy::Ripple> ripples_taken_out(const JointModel& joint, std::vector<GenericTest>& generic,
                                                double error) {
  std::vector<Adequacy::Ripple> ripples;
  std::erase_if(generic, [&](const GenericTest& g) {
    if (g.carries_nowhere) return true;
    if (g.times_a_turn == 0.0 || g.p_value >= error) return false;
    JointModel with = joint;
    let_in(with, g);
    if (!is_no_better(joint, with, g)) return false;
    if (is_shape_of_a_named_wheel(joint, g)) return false;
    // One of a group of lobes and one of a wave are the same.
    if (std::none_of(ripples.begin(), ripples.end(), [&](const Adequacy::Ripple& r) {
          return r.channel == g.channel && std::abs(r.times_a_turn - g.times_a_turn) < kEvenly;
        }))
      ripples.push_back({g.channel, g.times_a_turn, amplitude_of(g.test.value)});
    return true;
  });
  return ripples;
}

// One cause is simpler than several, of which none says nearly all by itself.
InPlaceOfNames simpler_first(InPlaceOfNames instead, const std::vector<ScoredCandidate>& evidence, Base base) {
  constexpr double kNearlyAll = 0.85;
  double most = 0.0, all = 0.0;
  for (const ScoredCandidate& e : evidence)
    if (base == Base::goes || !is_of_the_base(*e.effect))
      most = std::max(most, e.test.statistic), all += e.test.statistic;
  if (!instead.says_more && most < kNearlyAll * all) instead.says_more = std::exchange(instead.as_much, std::nullopt);
  return instead;
}

}  // namespace

Adequacy adequacy_of(const JointModel& joint, const JointModel& calibrated,
                     const std::vector<ScoredCandidate>& evidence, double error) {
  // Groups share most of what they ask, and the bound over all of them is wide: of 116 sets of four programs in which
  // nothing was missing the least p was below a tenth in two. Beside names less of that is taken, so that none is
  // wronged (beside the right names of 70 sets of another the least was 0.03); and nothing of it of a base that is
  // driven by its commands, whose lag may be too small to be let in; where there are few innovations, which groups of
  // so many terms fit by chance; and where counts are coarse, of whose feigning only so much is known.
  constexpr double kShared = 6.0, kSharedBesideNames = 2.0;
  const std::ptrdiff_t names = names_held_against(joint, Base::goes);
  const bool commands = std::any_of(joint.views().begin(), joint.views().end(), std::mem_fn(&DriveView::from_commands));
  int stretches = joint.gathered_error().windows;
  if (stretches == 0) stretches = joint.path_error().windows;
  const bool many = 3 * stretches > kFewestInnovations;
  const bool counts_feign = joint.driven_again && joint.driven_again->is_counted();
  const double shared = commands || !many || counts_feign ? 1.0 : names == 0 ? kShared : kSharedBesideNames;
  const double of_what_is_left = shared * error;
  Adequacy out;
  out.generic = generic_tests(joint);
  if (joint.scalars() > kFewestToTellNoise) look_again(joint, out.generic, of_what_is_left);
  // Of a truth that errs by nothing a last digit sways.
  const GenericTest* sway = is_nothing(joint.gathered_error()) ? nullptr : clearest_sway(out.generic, error);
  if (sway) out.sway = {sway->variable, sway->sway->to_either_side_m};
  double explained = 0.0;
  std::vector<ScoredCandidate> of_vehicle;
  for (const ScoredCandidate& e : evidence) {
    explained += counted_for_the_unnamed(*e.effect, e.test.statistic);
    if (e.effect->acts_on_motion()) of_vehicle.push_back(e);
  }
  std::vector<GenericTest> left_by_names = out.generic;
  if (names > 0) out.ripples = ripples_taken_out(joint, left_by_names, error);
  if (const Left left = what_is_left(joint, left_by_names, of_what_is_left); left.group) {
    const CandidateTest& test = left.group->test;
    const double gain = std::max(0.0, test.statistic - test.freedom * test.inflation);
    // Names that leave more than half of what they say are as small as that.
    const bool names_leave_as_much = names > 0 && gain > kAsMuchAsNames * explained;
    if (!names_leave_as_much && !is_worth_saying(joint, calibrated, *left.group))
      out.something_small_is_left = joint.distrust() > 0.0 && !joint.accepted.empty();
    else if (gain > left.group->most_left * explained || is_in_pieces(of_vehicle) ||
             leaves_more_than_noise(joint, *left.with))
      out.unnamed = unnamed_by(*left.group, *left.with, without_names(joint, Base::stays), left.shape, gain);
  }
  const double fair = beyond_chance(of_vehicle);
  const bool worth_asking = std::any_of(out.generic.begin(), out.generic.end(), [&](const GenericTest& g) {
    return g.test.statistic > kMostLeft * explained ||
           g.instead.judged() - by_chance(g.instead.freedom, std::log(g.tests)) > fair - kClearlyBeaten;
  });
  // First beside the base's own, where there is such; then in the place of that too.
  const std::ptrdiff_t others = names_held_against(joint, Base::stays);
  if (!out.unnamed && others > 0 && others < names)
    out.unnamed =
        simpler_first(in_place_of_names(joint, of_vehicle, Base::stays, error), of_vehicle, Base::stays).says_more;
  if (!out.unnamed && worth_asking && names > 0) {
    InPlaceOfNames instead =
        simpler_first(in_place_of_names(joint, of_vehicle, Base::goes, error), of_vehicle, Base::goes);
    out.unnamed = std::move(instead.says_more);
    out.as_likely = std::move(instead.as_much);
    if (!out.unnamed && out.as_likely && out.as_likely->gain > said_by(of_vehicle) + kClearlyBeaten)
      out.unnamed = std::exchange(out.as_likely, std::nullopt);
  }
  if (sway && names == 0)
    if (Unnamed u = unnamed_sway(joint, *sway); !out.unnamed || u.gain > out.unnamed->gain) out.unnamed = std::move(u);
  return out;
}

}  // namespace odolab
