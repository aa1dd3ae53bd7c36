#include "core/diagnosis/ready_recordings.h"

#include <algorithm>
#include <cmath>

#include "core/base/formatted.h"
#include "core/base/parallel.h"
#include "core/calibration/correlated_truth.h"
#include "core/calibration/left_out.h"
#include "core/calibration/recording_fault.h"
#include "core/diagnosis/model/ready_run.h"
#include "core/diagnosis/quality/alike_holds.h"
#include "core/diagnosis/quality/encoder_jumps.h"
#include "core/diagnosis/quality/lost_counts.h"
#include "core/diagnosis/quality/noiseless_truth.h"
#include "core/diagnosis/quality/truth_jumps.h"
#include "core/diagnosis/truth_elsewhere.h"
#include "core/recording/truth_left_out.h"

namespace odolab {

namespace {

// Where the truth jumps time and again, these moments are left out of all recordings. Returns the jumps.
std::vector<TruthJump> leave_out_jumps(const ReadyRecordings& ready, const std::vector<CheckedRecording*>& each,
                                       const Vehicle& nominal) {
  std::vector<TruthJumps> jumps(each.size());
  std::vector<TimeStretches> of_each(each.size());
  parallel_for(static_cast<int>(each.size()), [&](int i) {
    const auto r = static_cast<std::size_t>(i);
    const InnovationModel model = model_of(ready.calibration, r);
    const Result<InnovationRun> run = ready_run(*each[r], nominal);
    if (!run) return;
    jumps[r] = truth_jumps(*run, model);
    for (const TruthJump& jump : jumps[r].jumps) {
      // On the wheels' clock, from one reading to another.
      const auto by_time = [](const WheelSample& w, double t) { return w.time_s < t; };
      const auto begin = run->wheels.begin(), end = run->wheels.end() - 1;
      const auto from = std::lower_bound(begin, end, jump.time_s.first - model.truth.time_offset_s, by_time),
                 to = std::lower_bound(begin, end, jump.time_s.second - model.truth.time_offset_s, by_time);
      of_each[r].emplace_back((from == begin ? from : from - 1)->time_s, to->time_s);
    }
  });
  std::vector<TruthJump> all;
  for (const TruthJumps& of : jumps) all.insert(all.end(), of.jumps.begin(), of.jumps.end());
  if (!ready.truth_jumps && (!are_of_the_truth(all) || !stand_out(jumps))) return {};
  for (std::size_t r = 0; r < each.size(); ++r) {
    TimeStretches& left_out_s = each[r]->left_out_s;
    left_out_s.insert(left_out_s.end(), of_each[r].begin(), of_each[r].end());
    left_out_s = joined(std::move(left_out_s));
  }
  return all;
}

// Where the truth was somewhere else for a while, its samples are left out. What happens so often that it is no mishap
// stays. Whether there is any.
bool leave_out_truth_elsewhere(const ReadyRecordings& ready, const std::vector<CheckedRecording*>& each,
                               const Vehicle& nominal) {
  constexpr std::size_t kMost = 6;
  std::vector<TimeStretches> of_each(each.size());
  parallel_for(static_cast<int>(each.size()), [&](int i) {
    const auto r = static_cast<std::size_t>(i);
    const Result<InnovationRun> run = ready_run(*each[r], nominal);
    if (run) of_each[r] = truth_elsewhere(*run, model_of(ready.calibration, r));
  });
  std::size_t times = 0;
  for (const TimeStretches& of : of_each) times += of.size();
  if (times == 0 || times > kMost) return false;
  for (std::size_t r = 0; r < each.size(); ++r)
    for (const auto& [from_s, to_s] : of_each[r]) {
      Recording& recording = each[r]->recording;
      std::vector<char> elsewhere;
      for (const double t : recording.time_s) elsewhere.push_back(t >= from_s && t <= to_s);
      leave_truth_out(recording, elsewhere);
      each[r]->warnings.push_back(
          recording.name +
          formatted(": from %.2f to %.2f s the truth is elsewhere, and then back where the wheels went; left out",
                    from_s, to_s));
    }
  return true;
}

// What overlaps nothing that was `known` is left out, too, and said. Whether there is any.
bool leave_out(CheckedRecording& checked, const TimeStretches& known, TimeStretches times, const char* component,
               const std::string& in_words) {
  std::erase_if(times, [&](const auto& time) {
    return std::any_of(known.begin(), known.end(),
                       [&](const auto& k) { return time.first < k.second && time.second > k.first; });
  });
  if (times.empty()) return false;
  checked.faults.push_back({"encoder_data_fault", component, checked.recording.name, times,
                            in_words + ", " + std::to_string(times.size()) + " time(s); left out"});
  checked.left_out_s.insert(checked.left_out_s.end(), times.begin(), times.end());
  checked.left_out_s = joined(std::move(checked.left_out_s));
  return true;
}

// Where a reading is off its wheel's pace and the truth knows nothing of it, or a wheel stands and the truth goes on,
// it is left out. Whether there is any.
bool leave_out_what_encoders_lose(const ReadyRecordings& ready, const std::vector<CheckedRecording*>& each,
                                  const Vehicle& nominal) {
  std::vector<JumpsOfWheels> jumps(each.size()), lost(each.size());
  parallel_for(static_cast<int>(each.size()), [&](int i) {
    const auto r = static_cast<std::size_t>(i);
    const Result<InnovationRun> run = ready_run(*each[r], nominal);
    if (!run || each[r]->from_commands) return;
    const InnovationModel model = model_of(ready.calibration, r);
    jumps[r] = jumps_against_truth(*run, model);
    lost[r] = lost_counts(*run, model);
  });
  bool any = false;
  struct Of {
    const std::vector<JumpsOfWheels>& found;
    TimeStretches JumpsOfWheels::*wheel;
    const char *component, *in_words;
  };
  const Of all[] = {{jumps, &JumpsOfWheels::left, "left_wheel", "the left encoder jumps"},
                    {jumps, &JumpsOfWheels::right, "right_wheel", "the right encoder jumps"},
                    {jumps, &JumpsOfWheels::both, "both_wheels", "both encoders jump at once"},
                    {lost, &JumpsOfWheels::left, "left_wheel", "the left encoder stands still"},
                    {lost, &JumpsOfWheels::right, "right_wheel", "the right encoder stands still"},
                    {lost, &JumpsOfWheels::both, "both_wheels", "both encoders stand still at once"}};
  for (std::size_t r = 0; r < each.size(); ++r) {
    const TimeStretches known = each[r]->left_out_s;
    for (const Of& of : all)
      any |= leave_out(*each[r], known, of.found[r].*of.wheel, of.component,
                       std::string(of.in_words) + ", and the truth goes on as before");
  }
  return any;
}

// Where an encoder stands as long as it is known to stand elsewhere, though its wheel goes too slowly to show it, that
// is left out. Whether there is any.
bool leave_out_alike_holds(const std::vector<CheckedRecording*>& each, const Vehicle& nominal) {
  const DifferentialDrive& drive = std::get<DifferentialDrive>(nominal.kind);
  bool any = false;
  for (const Wheel wheel : {Wheel::left, Wheel::right}) {
    KnownHolds known;
    for (const CheckedRecording* c : each)
      for (const DataFault& fault : c->faults)
        if (!c->from_commands && fault.effect == "encoder_data_fault" && fault.component == component_of(wheel))
          known.add(fault.time_s, wheel_samples(c->recording, drive), wheel);
    if (!known.are_alike()) continue;
    const std::string said = std::string("the ") + (wheel == Wheel::left ? "left" : "right") +
                             " encoder stands as long as it does elsewhere";
    for (CheckedRecording* c : each)
      if (!c->from_commands)
        any |= leave_out(*c, TimeStretches(c->left_out_s),
                         holds_alike(wheel_samples(c->recording, drive), wheel, known), component_of(wheel), said);
  }
  return any;
}

std::string jumps_in_words(const std::vector<TruthJump>& jumps) {
  double squares_m2 = 0.0;
  for (const TruthJump& j : jumps) squares_m2 += dot(j.by, j.by);
  return formatted(
      "the truth jumps at %d moments, by %.1f mm root mean square, sideways as much as ahead: they are left "
      "out, and no push or bump at one moment can be told from them",
      static_cast<int>(jumps.size()), 1e3 * std::sqrt(squares_m2 / static_cast<double>(jumps.size())));
}

}  // namespace

Result<ReadyRecordings> ready_recordings(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                                         const Vehicle& nominal, const Progress& progress, bool truth_is_white,
                                         const std::vector<TimeStretches>& also_left_out_s) {
  if (train.empty()) return Error{"recordings", "none", "one or more"};
  ReadyRecordings ready;
  std::uint64_t first_seed = 1;
  const auto check = [&](const std::vector<Recording>& given,
                         std::vector<CheckedRecording>& into) -> std::optional<Error> {
    for (const Recording& r : given)
      if (const std::vector<std::string> problems = problems_in(r); !problems.empty())
        return Error{r.name.empty() ? "recording" : r.name, "", problems.front()};
    into.resize(given.size());
    parallel_for(static_cast<int>(given.size()), [&](int r) {
      CheckedRecording& one = into[static_cast<std::size_t>(r)];
      one = checked(given[static_cast<std::size_t>(r)], nominal);
      if (auto measured = as_if_measured(one.recording, nominal, first_seed + static_cast<std::uint64_t>(r))) {
        one.recording = std::move(measured->recording);
        one.warnings.push_back(std::move(measured->said));
      }
    });
    first_seed += given.size();
    return {};
  };
  if (const std::optional<Error> problem = check(train, ready.train)) return *problem;
  if (const std::optional<Error> problem = check(held_out, ready.held_out)) return *problem;
  std::vector<CheckedRecording*> each;
  for (std::vector<CheckedRecording>* of : {&ready.train, &ready.held_out})
    for (CheckedRecording& c : *of) each.push_back(&c);
  for (std::size_t r = 0; r < std::min(also_left_out_s.size(), each.size()); ++r) {
    TimeStretches& left_out_s = each[r]->left_out_s;
    left_out_s.insert(left_out_s.end(), also_left_out_s[r].begin(), also_left_out_s[r].end());
    left_out_s = joined(std::move(left_out_s));
  }
  std::vector<Recording> all;
  for (const CheckedRecording* c : each) all.push_back(c->recording);
  for (const std::optional<Error>& fault : faults_in(all, nominal))
    if (fault) return *fault;
  const PutRight put_right = mountings_put_right(all, nominal, [&](double) { return goes_on(progress, 0.0); });
  for (const MovedMounting& m : put_right.moved) each[m.index]->recording = put_right.recordings[m.index];
  ready.moved = put_right.moved;

  for (const CheckedRecording& c : ready.train) ready.from_commands = ready.from_commands || c.from_commands;
  const auto calibrate = [&]() -> Result<Done> {
    LeastSquaresOptions with_faults_left_out;
    with_faults_left_out.by_commands = ready.from_commands;
    with_faults_left_out.truth_is_white = truth_is_white;
    std::vector<Recording> fitted;
    for (const CheckedRecording& c : ready.train) {
      fitted.push_back(c.recording);
      with_faults_left_out.left_out.push_back(c.left_out_s);
    }
    Result<LeastSquaresCalibration> calibration = calibrate_least_squares(
        fitted, nominal, with_faults_left_out, [&](double share) { return goes_on(progress, share); });
    if (!calibration) return calibration.error();
    ready.calibration = *std::move(calibration);
    return Done{};
  };
  if (const Result<Done> done = calibrate(); !done) return done.error();
  const bool some_is_lost = leave_out_what_encoders_lose(ready, each, nominal);
  if (leave_out_alike_holds(each, nominal) || some_is_lost)
    if (const Result<Done> done = calibrate(); !done) return done.error();
  if (leave_out_truth_elsewhere(ready, each, nominal))
    if (const Result<Done> done = calibrate(); !done) return done.error();
  constexpr int kMostRounds = 3;  // without the largest, smaller ones show
  for (int round = 0; round < kMostRounds; ++round) {
    const std::vector<TruthJump> jumps = leave_out_jumps(ready, each, nominal);
    if (jumps.empty()) break;
    ready.truth_jumps = true;
    if (const Result<Done> done = calibrate(); !done) return done.error();
    if (round == 0) ready.warnings.push_back(jumps_in_words(jumps));
  }
  for (CheckedRecording* c : each) {
    ready.warnings.insert(ready.warnings.end(), c->warnings.begin(), c->warnings.end());
    if (ready.calibration.truth_apart_s > 0.0)
      c->recording = with_truth_apart(c->recording, ready.calibration.truth_apart_s);
  }
  ready.warnings.insert(ready.warnings.end(), ready.calibration.warnings.begin(), ready.calibration.warnings.end());
  return ready;
}

Result<JointModel> calibrated_model(const ReadyRecordings& ready, const Vehicle& nominal, bool truth_may_come_back) {
  std::vector<InnovationRun> runs;
  std::vector<char> commands;
  for (Result<InnovationRun>& run : condensed_runs(ready.train, nominal, ready.calibration, true)) {
    if (!run) return run.error();
    commands.push_back(ready.train[runs.size()].from_commands);
    runs.push_back(*std::move(run));
  }
  JointModel joint(std::move(runs), commands, ready.calibration, nominal);
  joint.truth_may_come_back = truth_may_come_back;
  joint.truth_jumps = ready.truth_jumps;
  joint.truth_noise_lasts = ready.calibration.truth_apart_s > 0.0;
  joint.linearise();
  joint.gate();
  joint.fit(3);
  joint.fit_noise_and_all();
  return joint;
}

}  // namespace odolab
