#include "core/diagnosis/generic/generic_tests.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "core/base/chi_square.h"
#include "core/base/parallel.h"
#include "core/diagnosis/generic/after_changes.h"
#include "core/diagnosis/generic/bent_truth.h"
#include "core/diagnosis/generic/floor.h"
#include "core/diagnosis/generic/lagging.h"
#include "core/diagnosis/generic/late_truth.h"
#include "core/diagnosis/generic/step_response.h"
#include "core/diagnosis/generic/told_speeds.h"
#include "core/diagnosis/generic/truth_errors.h"
#include "core/diagnosis/generic/uneven_wheels.h"
#include "core/diagnosis/generic/waves.h"

namespace odolab {

namespace {

// Functions of one variable: hats on its quantiles, the last of which are left out where they add up to a constant that
// calibration has already.
struct Group {
  std::string variable;
  std::vector<double> at;
  std::function<void(const DriveView&, std::vector<std::vector<double>>&)> values;  // [function][step]
  std::vector<GenericWave> waves;
  bool is_memory = false;  // of what was done before
  bool of_turns = false;   // asked of the turn by itself too; not of what a turn's beginning and end are told by, where
                           // whole counts leave their trace
};

Group hats_of(const std::string& name, const std::vector<DriveView>& views,
              const std::function<double(const EffectStep&)>& variable, int count, double least) {
  std::vector<double> seen;
  for (const DriveView& v : views)
    for (std::size_t i = 0; i < v.steps.size(); i += 7)
      if (std::abs(v.steps[i].speed_mps) + 0.1 * std::abs(v.steps[i].yaw_rate_radps) > 0.005)
        seen.push_back(variable(v.steps[i]));
  Group g;
  g.variable = name;
  if (seen.size() < 50) return g;
  std::sort(seen.begin(), seen.end());
  const double low = seen[seen.size() / 100], high = seen[seen.size() - 1 - seen.size() / 100];
  if (high - low < 1e-6 || high - low < 2.0 * least) return g;
  // Half by quantile, half even: rare regimes are heard too.
  for (int k = 0; k < count; ++k) {
    const double share = static_cast<double>(k) / (count - 1);
    const double q = seen[static_cast<std::size_t>(share * static_cast<double>(seen.size() - 1))];
    const double x = 0.5 * std::clamp(q, low, high) + 0.5 * (low + share * (high - low));
    if (g.at.empty() || x > g.at.back() + std::max(0.02 * (high - low), least)) g.at.push_back(x);
  }
  const std::vector<double> at = g.at;
  g.values = [at, variable](const DriveView& view, std::vector<std::vector<double>>& out) {
    out.assign(at.size(), std::vector<double>(view.steps.size(), 0.0));
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const double x = std::clamp(variable(view.steps[i]), at.front(), at.back());
      std::size_t k = 0;
      while (k + 2 < at.size() && at[k + 1] < x) ++k;
      if (at.size() == 1) {
        out[0][i] = 1.0;
        continue;
      }
      const double share = (x - at[k]) / (at[k + 1] - at[k]);
      out[k][i] = 1.0 - share;
      out[k + 1][i] = share;
    }
  };
  return g;
}

}  // namespace

const char* name_of_channel(int channel) {
  static const char* const kNames[] = {"forward per metre [1]",    "sideways per metre [1]",
                                       "turn per metre [rad/m]",   "turn per turn [1]",
                                       "left wheel per metre [1]", "right wheel per metre [1]"};
  return kNames[channel];
}

BodyMotion unit_of_channel(const EffectStep& step, double wheelbase_m, int channel) {
  if (channel == kLeftWheelAlone) return by_wheel(Wheel::left, step.left_m, wheelbase_m);
  if (channel == kRightWheelAlone) return by_wheel(Wheel::right, step.right_m, wheelbase_m);
  // Turning on the spot counts as way too, by the way of the wheels.
  const double way = std::abs(step.forward_m()) + (channel == 0 ? 0.0 : 0.5 * wheelbase_m * std::abs(step.turn_rad));
  BodyMotion m;
  (channel == 0 ? m.forward_m : channel == 1 ? m.sideways_m : m.turn_rad) = way;
  return m;
}

double GenericTest::p_value_of(const CandidateTest& of) const {
  return std::min(1.0, tests * scaled_chi_square_tail(of.judged(), of.freedom, of.batches));
}

AskedModel::AskedModel(const JointModel& model) : joint(model), with_and_without{model.asked()} {
  if (!model.accepted.empty()) with_and_without.push_back(model.asked(JointModel::kAll));
}

void ask(GenericTest& t, const AskedModel& asked, std::shared_ptr<const Effect> term, double looked_at) {
  CandidateColumns columns = asked.joint.columns_of(*term, {});
  columns.how = kAskedOfGeneric;
  const std::vector<CandidateTest> tests = asked.joint.tests(columns, asked.with_and_without);
  t.test = tests.front();
  t.instead = tests.back();
  t.tests = looked_at;
  t.p_value = t.p_value_of(t.test);
  t.as_effect = std::move(term);
}

std::vector<GenericTest> generic_tests(const JointModel& joint) {
  const AskedModel asked_model(joint);
  const std::vector<DriveView>& views = joint.views();
  std::vector<Group> groups;
  // Counts and uneven wheels shake these variables as they shake the way itself, because a wheel that is held up turns
  // the slower: where hats are no wider than that, noise looks like a response to its own trace. So far apart they
  // stand at least: what one count is over a short time, and what unevenness of a percent makes at walking pace.
  double count_m = 0.0, base_m = 1e300;
  for (const DriveView& v : views) {
    const double radius_m = std::max(v.drive.wheel_radius_left_m, v.drive.wheel_radius_right_m);
    count_m = std::max(count_m, v.from_commands ? 0.0 : 2.0 * kPi * radius_m / v.drive.counts_per_wheel_turn());
    base_m = std::min(base_m, v.drive.wheelbase_m);
  }
  const double speed_mps = std::max(0.01, count_m / 0.06);
  groups.push_back(hats_of(
      "speed [m/s]", views, [](const EffectStep& s) { return s.speed_mps; }, 6, speed_mps));
  // Of what a driver steers with on a straight the same is true: what shakes the wheels is what it answers to.
  const double straight_radps = 2.0 * speed_mps / base_m;
  const auto unit_in = [straight_radps](const DriveView& view, const EffectStep& s, int channel) {
    if (channel != kTurnOfItself) return unit_of_channel(s, view.drive.wheelbase_m, channel);
    const double share = 1.0 - straight_radps / std::max(std::abs(s.yaw_rate_radps), straight_radps);
    return BodyMotion{0.0, 0.0, share * s.turn_rad};
  };
  groups.push_back(hats_of(
      "yaw rate [rad/s]", views,
      [straight_radps](const EffectStep& s) {
        return s.yaw_rate_radps - std::clamp(s.yaw_rate_radps, -straight_radps, straight_radps);
      },
      7, straight_radps));
  groups.push_back(hats_of(
      "lateral acceleration [m/s2]", views, [](const EffectStep& s) { return s.speed_mps * s.yaw_rate_radps; }, 6,
      speed_mps / base_m));
  groups.push_back(hats_of(
      "acceleration [m/s2]", views, [](const EffectStep& s) { return s.acceleration_mps2; }, 6, speed_mps / 0.1));
  groups.push_back(hats_of(
      "time since the start [s]", views, [](const EffectStep& s) { return s.since_start_s; }, 8, 0.0));
  groups.back().of_turns = true;
  Group heading;
  heading.variable = "heading [rad]";
  heading.of_turns = true;
  heading.values = [](const DriveView& view, std::vector<std::vector<double>>& out) {
    out.assign(4, std::vector<double>(view.steps.size()));
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const double h = view.steps[i].heading_rad;
      out[0][i] = std::cos(h), out[1][i] = std::sin(h), out[2][i] = std::cos(2 * h), out[3][i] = std::sin(2 * h);
    }
  };
  heading.waves = {{"heading [rad]", {0, 2}, {1, 3}}};
  groups.push_back(heading);
  // Place: low polynomials of where it is, and of where it is against where it looks.
  const Floor floor = floor_of(views);
  const auto unit = [](double v, double low, double high) {
    return high > low ? 2.0 * (v - low) / (high - low) - 1.0 : 0.0;
  };
  Group place;
  place.variable = "place on the floor [m]";
  place.of_turns = true;
  place.values = [=](const DriveView& view, std::vector<std::vector<double>>& out) {
    out.assign(9, std::vector<double>(view.steps.size()));
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const EffectStep& s = view.steps[i];
      const double x = unit(s.position.x_m, floor.low.x_m, floor.high.x_m),
                   y = unit(s.position.y_m, floor.low.y_m, floor.high.y_m);
      const double c = std::cos(s.heading_rad), sn = std::sin(s.heading_rad);
      const double f[9] = {x, y, x * x, x * y, y * y, x * c, x * sn, y * c, y * sn};
      for (int k = 0; k < 9; ++k) out[k][i] = f[k];
    }
  };
  groups.push_back(place);
  if (views.size() > 1) {
    Group recording;
    recording.variable = "recording";
    recording.of_turns = true;
    const std::size_t count = views.size();
    recording.values = [count](const DriveView& view, std::vector<std::vector<double>>& out) {
      // A run that was not fitted is like the first.
      const std::size_t number =
          static_cast<std::size_t>(view.number) < count ? static_cast<std::size_t>(view.number) : 0;
      out.assign(count, std::vector<double>(view.steps.size(), 0.0));
      std::fill(out[number].begin(), out[number].end(), 1.0);
    };
    groups.push_back(recording);
  }
  Group memory;
  memory.variable = "turn before, forgotten over metres";
  memory.is_memory = true;
  memory.values = [](const DriveView& view, std::vector<std::vector<double>>& out) {
    out.assign(2, std::vector<double>(view.steps.size()));
    for (int k = 0; k < 2; ++k) {
      const double length_m = k == 0 ? 0.1 : 0.5;
      double m = 0.0;
      for (std::size_t i = 0; i < view.steps.size(); ++i) {
        m = m * std::exp(-std::abs(view.steps[i].forward_m()) / length_m) + view.steps[i].turn_rad;
        m = std::clamp(m, -2.0, 2.0);
        out[k][i] = m;
      }
    }
  };
  groups.push_back(memory);
  // What heats, or empties, as the vehicle works, and recovers.
  const auto forgotten_over_seconds = [&groups](const char* name, double (*work)(const EffectStep&)) {
    Group g;
    g.variable = name;
    g.is_memory = true;
    g.values = [work](const DriveView& view, std::vector<std::vector<double>>& out) {
      out.assign(2, std::vector<double>(view.steps.size()));
      for (int k = 0; k < 2; ++k) {
        const double lasts_s = k == 0 ? 5.0 : 30.0;
        double m = 0.0;
        for (std::size_t i = 0; i < view.steps.size(); ++i) {
          m = m * std::exp(-view.steps[i].duration_s / lasts_s) + work(view.steps[i]);
          out[k][i] = m;
        }
      }
    };
    groups.push_back(g);
  };
  forgotten_over_seconds("turning before, forgotten over seconds",
                         [](const EffectStep& s) { return std::abs(s.turn_rad); });
  forgotten_over_seconds("way before, forgotten over seconds",
                         [](const EffectStep& s) { return 0.5 * (std::abs(s.left_m) + std::abs(s.right_m)); });
  Group rest;
  rest.variable = "way since it stood [m]";
  rest.is_memory = true;
  rest.values = [](const DriveView& view, std::vector<std::vector<double>>& out) {
    constexpr double kForgotten_m[] = {0.1, 0.5, 2.0};
    constexpr double kStands_s = 1.0;
    out.assign(std::size(kForgotten_m), std::vector<double>(view.steps.size()));
    double way_m = 1e3, stood_s = 0.0;  // what was before the run is not known
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const EffectStep& s = view.steps[i];
      const bool stands = s.left_read_rad == 0.0 && s.right_read_rad == 0.0;
      stood_s = stands ? stood_s + s.duration_s : 0.0;
      way_m = stood_s > kStands_s ? 0.0 : way_m + std::abs(s.left_m) * 0.5 + std::abs(s.right_m) * 0.5;
      for (std::size_t k = 0; k < std::size(kForgotten_m); ++k) out[k][i] = std::exp(-way_m / kForgotten_m[k]);
    }
  };
  groups.push_back(rest);
  Group reversed;
  reversed.variable = "way since it reversed [m]";
  reversed.is_memory = true;
  reversed.values = [](const DriveView& view, std::vector<std::vector<double>>& out) {
    constexpr double kForgotten_m[] = {0.1, 0.5, 2.0};
    constexpr double kGoes_m = 0.01;  // the other way, that is no rocking
    out.assign(std::size(kForgotten_m), std::vector<double>(view.steps.size()));
    double at_m = 0.0, furthest_m = 0.0, way_m = 1e3, sign = 0.0;  // what was before the run is not known
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const double forward_m = view.steps[i].forward_m();
      at_m += forward_m;
      way_m += std::abs(forward_m);
      if (sign == 0.0 && std::abs(at_m) > kGoes_m) sign = at_m > 0.0 ? 1.0 : -1.0, furthest_m = at_m;
      if (sign * (at_m - furthest_m) > 0.0) furthest_m = at_m;
      if (sign != 0.0 && sign * (furthest_m - at_m) > kGoes_m) {
        sign = -sign;
        way_m = std::abs(furthest_m - at_m);
        furthest_m = at_m;
      }
      for (std::size_t k = 0; k < std::size(kForgotten_m); ++k) out[k][i] = std::exp(-way_m / kForgotten_m[k]);
    }
  };
  groups.push_back(reversed);
  Group phases;
  phases.variable = "wheel rotation [rad]";
  phases.values = [](const DriveView& view, std::vector<std::vector<double>>& out) {
    out.assign(4, std::vector<double>(view.steps.size()));
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const EffectStep& s = view.steps[i];
      out[0][i] = std::cos(s.left_rad), out[1][i] = std::sin(s.left_rad), out[2][i] = std::cos(s.right_rad),
      out[3][i] = std::sin(s.right_rad);
    }
  };
  phases.waves = {{"left wheel angle [rad]", {0}, {1}}, {"right wheel angle [rad]", {2}, {3}}};
  groups.push_back(phases);
  groups.erase(std::remove_if(groups.begin(), groups.end(), [](const Group& g) { return !g.values; }), groups.end());

  // Each in each channel alone; what is remembered, which may show in all of them at once or at one
  // wheel, in all together and in each wheel too.
  struct Asked {
    const Group* group;
    std::vector<int> channels;
  };
  std::vector<Asked> asked;
  for (const Group& g : groups) {
    for (int channel = 0; channel < (g.of_turns ? kGenericChannels : kTurnOfItself); ++channel)
      asked.push_back({&g, {channel}});
    if (!g.is_memory) continue;
    asked.push_back({&g, {0, 1, 2}});
    for (const int wheel : {kLeftWheelAlone, kRightWheelAlone}) asked.push_back({&g, {wheel}});
  }
  const auto count = static_cast<int>(asked.size());
  const double of_the_truth = joint.truth_errors ? static_cast<double>(joint.truth_errors->size()) : 0.0;
  const double n = count + kUnevenWheelTests + kLaggingTests + kBentTruthTests + kStepResponseTests +
                   std::max(kToldSpeedTests, kAfterChangeTests) + kLateTruthTests + of_the_truth;
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
    tests[i].channel = channels.size() == 1 ? name_of_channel(channels[0]) : "forward, sideways and turn, per metre";
    if (channels.size() == 1) {
      tests[i].at = g.at;
      tests[i].waves = g.waves;
    }
    term->name = tests[i].variable;
    term->component = tests[i].channel;
    ask(tests[i], asked_model, std::move(term), n);
  });
  for (const std::vector<GenericTest>& more :
       {uneven_wheel_tests(asked_model, n), lagging_tests(asked_model, n), bent_truth_tests(asked_model, n),
        step_response_tests(asked_model, n), told_speed_tests(asked_model, n), after_change_tests(asked_model, n),
        late_truth_tests(asked_model, n), truth_error_tests(asked_model, n), wave_tests(asked_model, n)})
    tests.insert(tests.end(), more.begin(), more.end());
  std::sort(tests.begin(), tests.end(), [](const GenericTest& a, const GenericTest& b) {
    return a.p_value != b.p_value ? a.p_value < b.p_value : a.test.judged() > b.test.judged();
  });
  return tests;
}

}  // namespace odolab
