#include "core/diagnosis/generic/generic_tests.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/base/chi_square.h"
#include "core/base/parallel.h"
#include "core/diagnosis/generic/after_changes.h"
#include "core/diagnosis/generic/at_rest.h"
#include "core/diagnosis/generic/bands.h"
#include "core/diagnosis/generic/bent_truth.h"
#include "core/diagnosis/generic/counted.h"
#include "core/diagnosis/generic/groups.h"
#include "core/diagnosis/generic/lagging.h"
#include "core/diagnosis/generic/late_truth.h"
#include "core/diagnosis/generic/lines_on_floor.h"
#include "core/diagnosis/generic/moving_frame.h"
#include "core/diagnosis/generic/on_a_patch.h"
#include "core/diagnosis/generic/on_the_spot.h"
#include "core/diagnosis/generic/one_way.h"
#include "core/diagnosis/generic/step_response.h"
#include "core/diagnosis/generic/swinging.h"
#include "core/diagnosis/generic/told_speeds.h"
#include "core/diagnosis/generic/tracked_point.h"
#include "core/diagnosis/generic/truth_by_place.h"
#include "core/diagnosis/generic/truth_errors.h"
#include "core/diagnosis/generic/uneven_floor.h"
#include "core/diagnosis/generic/uneven_wheels.h"
#include "core/diagnosis/generic/waves.h"
#include "core/diagnosis/generic/wobbling_wheels.h"
#include "core/diagnosis/model/coarse_counts.h"
#include "core/diagnosis/model/driven_again.h"

namespace odolab {

const char* name_of_channel(int channel) {
  static const char* const kNames[] = {
      "forward per metre [1]",    "sideways per metre [1]",    "turn per metre [rad/m]",          "turn per turn [1]",
      "left wheel per metre [1]", "right wheel per metre [1]", "turn per metre forwards [rad/m]", "way per metre [1]"};
  return kNames[channel];
}

std::string part_of_channel(const std::string& channel) {
  if (channel.rfind("truth", 0) == 0 || channel.find("the truth's frame") != std::string::npos) return "truth";
  const bool left = channel.find("left wheel") != std::string::npos,
             right = channel.find("right wheel") != std::string::npos;
  if (channel.find("left and the right") != std::string::npos || left == right) return "vehicle";
  return component_of(left ? Wheel::left : Wheel::right);
}

BodyMotion unit_of_channel(const EffectStep& step, double wheelbase_m, int channel) {
  if (channel == kLeftWheelAlone) return by_wheel(Wheel::left, step.left_m, wheelbase_m);
  if (channel == kRightWheelAlone) return by_wheel(Wheel::right, step.right_m, wheelbase_m);
  if (channel == kTurnForwards) return {0.0, 0.0, step.forward_m()};
  if (channel == kWayItself) return {step.forward_m(), 0.0, 0.0};
  // Turning on the spot counts as way too, by the way of the wheels.
  const double way = std::abs(step.forward_m()) + (channel == 0 ? 0.0 : 0.5 * wheelbase_m * std::abs(step.turn_rad));
  BodyMotion m;
  (channel == 0 ? m.forward_m : channel == 1 ? m.sideways_m : m.turn_rad) = way;
  return m;
}

double GenericTest::p_value_of(const CandidateTest& of) const {
  return std::min(1.0, tests * scaled_chi_square_tail(of.judged(), of.freedom, of.batches));
}

AskedModel::AskedModel(const JointModel& model)
    : joint(model),
      with_and_without{model.asked()},
      counts_are_coarse(odolab::counts_are_coarse(model)),
      scores(model.views().size()) {
  parallel_for(static_cast<int>(scores.size()),
               [&](int r) { scores[static_cast<std::size_t>(r)] = joint.score_of_motions(r); });
  if (!model.accepted.empty()) with_and_without.push_back(model.asked(JointModel::kAll));
}

void ask(GenericTest& t, const AskedModel& asked, std::shared_ptr<const Effect> term, double looked_at,
         const AskedHow& how) {
  CandidateColumns columns = asked.joint.columns_of(*term, {});
  columns.how = how;
  const std::vector<CandidateTest> tests = asked.joint.tests(columns, asked.with_and_without);
  if (t.component == "vehicle") t.component = part_of_channel(t.channel);
  t.test = tests.front();
  t.instead = tests.back();
  t.tests = looked_at;
  t.p_value = t.p_value_of(t.test);
  t.as_effect = std::move(term);
  if (asked.counts_are_coarse) leave_displaced_to_counting(t, asked.joint);
}

namespace {

void hold_tests_against_readings(const JointModel& joint, std::vector<GenericTest>& tests) {
  constexpr double kWorthAsking = 0.05;
  std::vector<GenericTest*> worth;
  for (GenericTest& t : tests)
    if (std::min(t.p_value, t.sway ? t.sway->p_value : 1.0) < kWorthAsking) worth.push_back(&t);
  if (!joint.driven_again || worth.empty()) return;
  joint.driven_again->drive();
  parallel_for(static_cast<int>(worth.size()), [&](int i) {
    GenericTest& t = *worth[static_cast<std::size_t>(i)];
    const Feigned by_readings = joint.driven_again->feigned(*t.as_effect, {}, joint.model.noise, kAskedOfGeneric);
    for (CandidateTest* of : {&t.test, &t.instead}) of->widen(by_readings);
    t.p_value = t.p_value_of(t.test);
    if (!t.sway) return;
    t.sway->test.widen(by_readings);
    t.sway->p_value = t.p_value_of(t.sway->test);
  });
}

// Whether so much is driven in reverse that the way itself is another channel than forward.
bool are_driven_both_ways(const std::vector<DriveView>& views) {
  constexpr double kLeast = 0.05;  // of the way
  double forwards_m = 0.0, back_m = 0.0;
  for (const DriveView& view : views)
    for (const EffectStep& s : view.steps) (s.forward_m() > 0.0 ? forwards_m : back_m) += std::abs(s.forward_m());
  return std::min(forwards_m, back_m) > kLeast * (forwards_m + back_m);
}

// What is asked beside groups of values. `count`: of how many tests each is one; none of those that count their own, or
// of which the row before is the other.
struct MoreTests {
  std::vector<GenericTest> (*ask)(const AskedModel& asked, double looked_at);
  int count;
};
constexpr MoreTests kMoreTests[] = {
    {uneven_wheel_tests, kUnevenWheelTests},
    {wobbling_wheel_tests, kWobblingWheelTests},
    {lagging_tests, kLaggingTests},
    {bent_truth_tests, kBentTruthTests},
    {step_response_tests, kStepResponseTests},
    {told_speed_tests, std::max(kToldSpeedTests, kAfterChangeTests)},  // of commands
    {after_change_tests, 0},                                           // of wheels that are read
    {late_truth_tests, kLateTruthTests},
    {tracked_point_tests, kTrackedPointTests},
    {truth_by_place_tests, kTruthByPlaceTests},
    {moving_frame_tests, kMovingFrameTests},
    {uneven_floor_tests, kUnevenFloorTests},
    {on_the_spot_tests, kOnTheSpotTests},
    {one_way_tests, kOneWayTests},
    {at_rest_tests, kAtRestTests},
    {swinging_tests, kSwingingTestsApart},
    {on_a_patch_tests, 0},
    {line_tests, 0},
    {truth_error_tests, 0},
    {wave_tests, 0},
};

// What goes with the heading alone is no matter of places.
void leave_to_headings(std::vector<GenericTest>& tests, double error) {
  constexpr double kNearlyAll = 0.7;
  double by_heading = 0.0;
  const auto is_of_truths_heading = [](const GenericTest& t) { return t.channel == "truth's heading"; };
  for (const GenericTest& t : tests)
    if (is_of_truths_heading(t) && t.variable == "heading" && t.p_value < error) by_heading = t.test.judged();
  for (GenericTest& t : tests)
    if (by_heading > 0.0 && is_of_truths_heading(t) && t.variable.rfind("place on the floor", 0) == 0 &&
        by_heading > kNearlyAll * t.test.judged())
      t.p_value = 1.0, t.test.statistic = t.instead.statistic = 0.0;
}

}  // namespace

GenericTest asked_of(const AskedModel& asked, const std::string& variable, const std::string& channel,
                     std::size_t amplitudes, MotionsOfTerm motions, double looked_at, const AskedHow& how) {
  GenericTest t;
  auto term = std::make_shared<Effect>();
  term->name = t.variable = variable;
  term->component = t.channel = channel;
  term->amplitudes.resize(amplitudes);
  term->motions = std::move(motions);
  ask(t, asked, std::move(term), looked_at, how);
  return t;
}

std::vector<GenericTest> generic_tests(const JointModel& joint) {
  const AskedModel asked_model(joint);
  const std::vector<DriveView>& views = joint.views();
  const Shaken shaken = shaken_by_wheels(views);
  const std::vector<Group> groups = groups_of(views, shaken);
  const auto unit_in = [straight_radps = shaken.straight_radps](const DriveView& view, const EffectStep& s,
                                                                int channel) {
    if (channel != kTurnOfItself) return unit_of_channel(s, view.drive.wheelbase_m, channel);
    const double share = 1.0 - straight_radps / std::max(std::abs(s.yaw_rate_radps), straight_radps);
    return BodyMotion{0.0, 0.0, share * s.turn_rad};
  };

  // Each in each channel alone; what is remembered, which may show in all of them at once or at one
  // wheel, in all together and in each wheel too.
  struct Asked {
    const Group* group;
    std::vector<int> channels;
  };
  std::vector<Asked> asked;
  const bool both_ways = are_driven_both_ways(views);
  for (const Group& g : groups) {
    if (g.of_wheel != 0) {
      asked.push_back({&g, {g.of_wheel}});
      continue;
    }
    for (int channel = 0; channel < (g.of_turns ? kGenericChannels : kTurnOfItself); ++channel)
      asked.push_back({&g, {channel}});
    if (g.of_turns && both_ways) asked.push_back({&g, {kWayItself}});
    if (!g.is_memory) continue;
    asked.push_back({&g, {0, 1, 2}});
    for (const int channel : {kLeftWheelAlone, kRightWheelAlone, kTurnForwards}) asked.push_back({&g, {channel}});
  }
  const auto count = static_cast<int>(asked.size());
  const double of_the_truth = joint.truth_errors ? static_cast<double>(joint.truth_errors->size()) : 0.0;
  double n = count + count_of_patch_tests(joint) + of_the_truth;
  for (const MoreTests& more : kMoreTests) n += more.count;
  std::vector<GenericTest> tests(asked.size());
  parallel_for(count, [&](int i) {
    const Group& g = *asked[i].group;
    const std::vector<int>& channels = asked[i].channels;
    std::vector<std::vector<double>> one;
    g.values(DriveView{}, one);
    auto term = std::make_shared<Effect>();
    term->amplitudes.resize(one.size() * channels.size());
    term->motions = [values_of = g.values, channels, unit_in](const DriveView& view, const std::vector<double>&) {
      std::vector<std::vector<double>> values;
      values_of(view, values);
      std::vector<Motions> out;
      for (int channel : channels)
        for (const std::vector<double>& of_function : values) {
          Motions motions(view.steps.size());
          for (std::size_t j = 0; j < of_function.size(); ++j) {
            const BodyMotion m = unit_in(view, view.steps[j], channel);
            const double value = of_function[j];
            motions[j] = {value * m.forward_m, value * m.sideways_m, value * m.turn_rad};
          }
          out.push_back(std::move(motions));
        }
      return out;
    };
    tests[i].variable = g.variable;
    tests[i].of_when_or_where = g.of_turns;
    tests[i].channel = channels.size() == 1 ? name_of_channel(channels[0]) : "forward, sideways and turn, per metre";
    // A castor's kick at each reversal is its simplest form.
    constexpr double kLeftByAKick = 0.3;
    if (channels.front() == kTurnForwards) tests[i].most_left = kLeftByAKick;
    if (channels.size() == 1) {
      tests[i].at = g.at;
      tests[i].waves = g.waves;
    }
    term->name = tests[i].variable;
    term->component = tests[i].channel;
    ask(tests[i], asked_model, std::move(term), n);
  });
  const auto append = [&](const std::vector<GenericTest>& more) {
    tests.insert(tests.end(), more.begin(), more.end());
  };
  for (const MoreTests& more : kMoreTests) append(more.ask(asked_model, n));
  append(band_tests(asked_model, shaken, n));
  hold_tests_against_readings(joint, tests);
  constexpr double kWorthAName = 0.005;
  leave_to_headings(tests, kWorthAName);
  std::sort(tests.begin(), tests.end(), [](const GenericTest& a, const GenericTest& b) {
    return a.p_value != b.p_value ? a.p_value < b.p_value : a.test.judged() > b.test.judged();
  });
  return tests;
}

}  // namespace odolab
