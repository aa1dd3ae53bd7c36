#include "core/diagnosis/quality/quality.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/formatted.h"
#include "core/base/quantile.h"
#include "core/calibration/carried_truth.h"
#include "core/calibration/evened_recording.h"
#include "core/calibration/frozen_truth.h"
#include "core/calibration/left_out.h"
#include "core/calibration/repeated_stamps.h"
#include "core/calibration/restamped.h"
#include "core/diagnosis/quality/drawn_truth.h"
#include "core/diagnosis/quality/encoder_jumps.h"
#include "core/diagnosis/quality/no_fix.h"
#include "core/diagnosis/quality/obeying_wheels.h"
#include "core/diagnosis/quality/standing_encoder.h"
#include "core/diagnosis/quality/unheard_commands.h"
#include "core/diagnosis/quality/unmeasured_heading.h"
#include "core/recording/truth_left_out.h"

namespace odolab {

namespace {

// "15.0 to 15.5 s", and how many more.
std::string times_text(const TimeStretches& times) {
  std::string all = formatted("from %.1f to %.1f s", times.front().first, times.front().second);
  if (times.size() > 1) all += " and " + std::to_string(times.size() - 1) + " time(s) more";
  return all;
}

// The rows within stretches, but for the first of each, and for the last where that is sound as well.
std::vector<char> rows_within(const TimeStretches& stretches, const std::vector<double>& time_s, bool last_is_sound) {
  std::vector<char> within;
  std::size_t k = 0;
  for (const double t : time_s) {
    while (k < stretches.size() && (t > stretches[k].second || (last_is_sound && t == stretches[k].second))) ++k;
    within.push_back(k < stretches.size() && t > stretches[k].first);
  }
  return within;
}

// Where a log begins with a base that is told to drive, what it was told before is not known, and a base that lags
// follows it for so long.
constexpr double kFollows_s = 1.0;
bool is_on_its_way(const CommandSample& first) { return first.speed_mps != 0.0 || first.yaw_rate_radps != 0.0; }

// For how long nobody looked while the vehicle drove, within the truth or at either end of it.
TimeStretches silent_truth(const std::vector<TruthSample>& truth, const std::vector<WheelSample>& wheels) {
  constexpr std::size_t kFewest = 20;
  constexpr double kLeast_s = 5.0, kTimesUsual = 20.0, kTurned_rad = 1.0;
  if (truth.size() < kFewest) return {};
  std::vector<double> apart_s;
  for (std::size_t i = 1; i < truth.size(); ++i) apart_s.push_back(truth[i].time_s - truth[i - 1].time_s);
  const double long_s = std::max(kLeast_s, kTimesUsual * median(apart_s));
  const auto at = [&](double time_s) {
    return std::lower_bound(wheels.begin(), wheels.end() - 1, time_s,
                            [](const WheelSample& w, double t) { return w.time_s < t; });
  };
  TimeStretches silent;
  const auto look_at = [&](double from_s, double to_s) {
    if (to_s - from_s < long_s) return;
    double turned_rad = 0.0;
    for (auto w = at(from_s); w != at(to_s); ++w)
      turned_rad += std::abs((w + 1)->left_rad - w->left_rad) + std::abs((w + 1)->right_rad - w->right_rad);
    if (turned_rad > kTurned_rad) silent.emplace_back(from_s, to_s);
  };
  look_at(wheels.front().time_s, truth.front().time_s);
  for (std::size_t i = 1; i < truth.size(); ++i) look_at(truth[i - 1].time_s, truth[i].time_s);
  look_at(truth.back().time_s, wheels.back().time_s);
  return silent;
}

// Where both encoders err at the same time: hardly each by a fault of its own.
TimeStretches both_at_once(const std::vector<DataFault>& faults) {
  constexpr double kMost = 0.5;
  const auto of = [&](const char* component) {
    return std::find_if(faults.begin(), faults.end(), [&](const DataFault& f) {
      return f.effect == "encoder_data_fault" && f.component == component;
    });
  };
  const auto left = of("left_wheel"), right = of("right_wheel");
  TimeStretches both;
  if (left == faults.end() || right == faults.end()) return both;
  for (const auto& a : left->time_s)
    for (const auto& b : right->time_s) {
      const std::pair<double, double> common{std::max(a.first, b.first), std::min(a.second, b.second)};
      if (common.second - common.first > kMost * std::max(a.second - a.first, b.second - b.first))
        both.push_back(common);
    }
  return both;
}

}  // namespace

std::string in_words(const DataFault& fault) {
  return fault.recording + " " + times_text(fault.time_s) + ": " + fault.sentence;
}

CheckedRecording checked(const Recording& as_logged, const Vehicle& vehicle, const std::optional<AlignedClock>& clock) {
  CheckedRecording out;
  const DifferentialDrive& drive = std::get<DifferentialDrive>(vehicle.kind);
  const std::optional<EvenedRecording> even = evened(as_logged, drive);
  if (even) out.warnings = even->said;
  const Recording& recording = even ? even->recording : as_logged;
  out.recording = recording;
  std::vector<WheelSample> wheels = without_repeated(wheel_samples(recording, drive));
  if (has_commands_alone(recording, wheels)) {
    out.from_commands = true;
    out.recording = with_obeying_wheels(recording, drive);
    wheels = without_repeated(obeying_wheels(command_samples(recording), drive));
  }
  const std::vector<char> without_fix = rows_without_fix(out.recording);
  if (const auto said = said_of_rows_without_fix(out.recording, without_fix)) {
    leave_truth_out(out.recording, without_fix);
    out.warnings.push_back(*said);
  }
  std::vector<TruthSample> truth = truth_samples(out.recording);
  constexpr std::size_t kFewest = 4;
  if (wheels.size() < kFewest) return out;
  if (const std::optional<std::string> said = unmeasured_heading(truth, wheels, drive)) {
    out.warnings.push_back(recording.name + ": " + *said);
    std::erase_if(out.recording.channels, [](const Channel& c) { return c.name == "truth_heading_rad"; });
    truth = truth_samples(out.recording);
  }

  std::vector<TruthSample> on_wheels_clock = truth;
  const AlignedClock known = clock.value_or(AlignedClock{vehicle.truth.time_offset_s});
  const TwoClocks clocks{truth.empty() ? 0.0 : truth.front().time_s, known.offset_s, known.rate};
  for (TruthSample& t : on_wheels_clock) t.time_s = clocks.wheels_stamp_s(t.time_s);
  if (const TimeStretches silent = silent_truth(on_wheels_clock, wheels); !silent.empty())
    out.warnings.push_back(recording.name + ": no truth " + times_text(silent) + ", while the wheels turn");
  const bool is_followed = truth.size() >= kFewest, is_measured = is_followed && !vehicle.truth.is_reckoned;
  if (const TimeStretches drawn = is_measured ? drawn_truth(truth) : TimeStretches{}; !drawn.empty()) {
    leave_truth_out(out.recording, rows_within(drawn, out.recording.time_s, true));
    out.warnings.push_back(recording.name + ": the truth goes in a straight line " + times_text(drawn) +
                           ", as where gaps are filled: left out");
  }
  DataFault frozen{"truth_frozen", "truth", recording.name,
                   is_measured ? frozen_truth(truth, wheels, drive, known.offset_s) : TimeStretches{}, ""};
  if (!frozen.time_s.empty()) {
    leave_truth_out(out.recording, rows_within(frozen.time_s, out.recording.time_s, false));
    frozen.sentence = in_words_of_frozen(frozen.time_s.size());
    out.faults.push_back(frozen);
  }
  if (is_measured)
    if (std::optional<MeasuredRecording> measured = without_carried_truth(out.recording)) {
      out.recording = std::move(measured->recording);
      out.warnings.push_back(std::move(measured->said));
    }
  if (out.from_commands && !is_followed) return out;
  if (out.from_commands) {
    const auto leave_out = [&](const TimeStretches& times, const std::string& what) {
      if (times.empty()) return;
      out.warnings.push_back(recording.name + ": " + what + " " + times_text(times) + ": left out");
      out.left_out_s.insert(out.left_out_s.end(), times.begin(), times.end());
    };
    leave_out(holes_in_commands(wheels, drive, on_wheels_clock), "no commands were logged");
    leave_out(unmoved_base(wheels, drive, on_wheels_clock), "the base hardly moved though it was told to drive");
    if (const std::vector<CommandSample> told = command_samples(recording); is_on_its_way(told.front()))
      out.left_out_s.emplace_back(recording.time_s.front(), told.front().time_s + kFollows_s);
    out.left_out_s = joined(std::move(out.left_out_s));
    return out;
  }

  if (const TimeStretches gaps = encoder_gaps(wheels); !gaps.empty()) {
    out.left_out_s = gaps;
    out.faults.push_back({kEncoderGap, "both_wheels", recording.name, gaps, "no encoder readings, left out"});
  }

  for (int wheel = 0; wheel < 2; ++wheel) {
    const double radius = wheel == 0 ? drive.wheel_radius_left_m : drive.wheel_radius_right_m;
    DataFault fault{"encoder_data_fault", wheel == 0 ? "left_wheel" : "right_wheel", recording.name, {}, ""};
    const Wheel which = wheel == 0 ? Wheel::left : Wheel::right;
    if (is_followed) fault.time_s = standing_encoder(wheels, which, on_wheels_clock, vehicle);
    for (const TimeStretches& more : {catching_up_encoder(wheels, which), halting_encoder(wheels, which, drive)})
      fault.time_s.insert(fault.time_s.end(), more.begin(), more.end());
    std::vector<double> time_s, angle_rad;
    for (std::size_t i = 0; i < wheels.size(); ++i) {
      time_s.push_back(wheels[i].time_s);
      angle_rad.push_back(rotation(wheels[i], which));
    }
    const TimeStretches jumps = encoder_jumps(time_s, angle_rad, radius, least_count_rad(wheels, which));
    for (const auto& jump : without_lost_rows(jumps, wheels)) fault.time_s.push_back(jump);
    std::string does = fault.time_s.empty() ? "" : "stands still or jumps while the vehicle drives on";
    if (const TimeStretches moved = moved_at_rest(wheels, which); !moved.empty()) {
      does += std::string(does.empty() ? "" : ", and ") + "moves while both wheels rest";
      fault.time_s.insert(fault.time_s.end(), moved.begin(), moved.end());
    }
    if (fault.time_s.empty()) continue;
    fault.time_s = joined(std::move(fault.time_s));
    for (const auto& t : fault.time_s) out.left_out_s.push_back(t);
    fault.sentence = std::string("the ") + (wheel == 0 ? "left" : "right") + " encoder " + does + ", " +
                     std::to_string(fault.time_s.size()) + " time(s); left out";
    out.faults.push_back(fault);
  }
  if (const TimeStretches both = both_at_once(out.faults); !both.empty())
    out.warnings.push_back(recording.name + ": both encoders err at once " + times_text(both) +
                           ": a vehicle that was carried or pushed, or a link that was silent");
  out.left_out_s = joined(std::move(out.left_out_s));
  return out;
}

}  // namespace odolab
