#include "core/diagnosis/ready_recordings.h"

#include <algorithm>
#include <cmath>

#include "core/base/formatted.h"
#include "core/base/parallel.h"
#include "core/calibration/column_names.h"
#include "core/calibration/correlated_truth.h"
#include "core/calibration/left_out.h"
#include "core/calibration/recording_fault.h"
#include "core/calibration/restamped.h"
#include "core/calibration/unfiltered_truth.h"
#include "core/diagnosis/model/ready_run.h"
#include "core/diagnosis/naming/clocks_first.h"
#include "core/diagnosis/quality/alike_holds.h"
#include "core/diagnosis/quality/encoder_jumps.h"
#include "core/diagnosis/quality/lost_counts.h"
#include "core/diagnosis/quality/noiseless_truth.h"
#include "core/diagnosis/quality/truth_jumps.h"
#include "core/diagnosis/quality/wheels_at_one_time.h"
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
    const std::optional<KnownRun> known = known_run(ready, *each[r], r, nominal);
    if (!known) return;
    jumps[r] = truth_jumps(known->run, known->model);
    for (const TruthJump& jump : jumps[r].jumps) {
      // On the wheels' clock, from one reading to another.
      const auto by_time = [](const WheelSample& w, double t) { return w.time_s < t; };
      const auto begin = known->run.wheels.begin(), end = known->run.wheels.end() - 1;
      const double late_s = known->model.truth.time_offset_s;
      const auto from = std::lower_bound(begin, end, jump.time_s.first - late_s, by_time),
                 to = std::lower_bound(begin, end, jump.time_s.second - late_s, by_time);
      of_each[r].emplace_back((from == begin ? from : from - 1)->time_s, to->time_s);
    }
    of_each[r] = known->as_stamped(std::move(of_each[r]));
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
    const std::optional<KnownRun> known = known_run(ready, *each[r], r, nominal);
    if (known) of_each[r] = truth_elsewhere(known->run, known->model);
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
    if (each[r]->from_commands) return;
    const std::optional<KnownRun> known = known_run(ready, *each[r], r, nominal);
    if (!known) return;
    jumps[r] = jumps_against_truth(known->run, known->model);
    lost[r] = lost_counts(known->run, known->model);
    for (JumpsOfWheels* of : {&jumps[r], &lost[r]})
      for (TimeStretches* times : {&of->left, &of->right, &of->both}) *times = known->as_stamped(std::move(*times));
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

// What is read of the right wheel, moved to when the left one was read. Counts need not be whole from here on.
void read_at_one_time(const std::vector<CheckedRecording*>& each, const Vehicle& nominal, double right_older_s) {
  for (CheckedRecording* c : each)
    if (!c->from_commands)
      c->recording =
          with_right_wheel_newer({c->recording}, std::get<DifferentialDrive>(nominal.kind), right_older_s).front();
}

std::string jumps_in_words(const std::vector<TruthJump>& jumps) {
  double squares_m2 = 0.0;
  for (const TruthJump& j : jumps) squares_m2 += dot(j.by, j.by);
  return formatted(
      "the truth jumps at %d moments, by %.1f mm root mean square, sideways as much as ahead: they are left "
      "out, and no push or bump at one moment can be told from them",
      static_cast<int>(jumps.size()), 1e3 * std::sqrt(squares_m2 / static_cast<double>(jumps.size())));
}

// Whether a clock is so far from what the vehicle's file says that the truth drives on where wheels stand; less, where
// an encoder seemed to.
bool are_clocks_far_off(const LeastSquaresCalibration& calibration, const Vehicle& nominal, bool encoders_seem_to_err) {
  constexpr double kFar_s = 0.3, kNearer_s = 0.05;
  const double far_s = encoders_seem_to_err ? kNearer_s : kFar_s;
  return std::any_of(calibration.time_offset_s.begin(), calibration.time_offset_s.end(),
                     [&](double offset_s) { return std::abs(offset_s - nominal.truth.time_offset_s) > far_s; });
}

// As the moments say, where that is worth a try.
std::optional<std::vector<AlignedClock>> clocks_by_moments(const ReadyRecordings& ready, const Vehicle& nominal) {
  if (!ready.calibration.innovations_are_correlated && ready.calibration.truth_apart_s == 0.0) return std::nullopt;
  std::vector<InnovationRun> runs;
  for (const CheckedRecording& c : ready.train) {
    Result<InnovationRun> run = ready_run(c, nominal);
    if (!run) return std::nullopt;
    runs.push_back(*std::move(run));
  }
  return moved_clocks(runs, [&](int run) { return model_of(ready.calibration, static_cast<std::size_t>(run)); });
}

// As the likelihood has them, where they run apart beyond doubt.
std::optional<std::vector<AlignedClock>> clocks_that_run_apart(const ReadyRecordings& ready, const Vehicle& nominal) {
  Result<JointModel> joint = calibrated_model(ready, nominal);
  if (!joint) return std::nullopt;
  let_clocks_in(*joint);
  std::vector<AlignedClock> clocks;
  bool run_apart = false;
  for (std::size_t r = 0; r < joint->clock_s.size(); ++r) {
    clocks.push_back({joint->clock_s[r], joint->clock_rate(static_cast<int>(r))});
    run_apart = run_apart || clocks.back().rate != 0.0;
  }
  if (!run_apart) return std::nullopt;
  return clocks;
}

}  // namespace

LeastSquaresCalibration ReadyRecordings::told() const {
  if (!clocks_put_right) return calibration;
  LeastSquaresCalibration all = clocks_put_right->calibration;
  all.vehicle = calibration.vehicle;
  all.noise = calibration.noise;
  all.time_offset_s = calibration.time_offset_s;
  for (ParameterEstimate& p : all.parameters)
    for (const ParameterEstimate& as_it_is : calibration.parameters)
      if (p.name == as_it_is.name && column::of_key(p.name) == column::truth_clock) p = as_it_is;
  return all;
}

std::optional<KnownRun> known_run(const ReadyRecordings& ready, const CheckedRecording& recording, std::size_t r,
                                  const Vehicle& nominal) {
  Result<InnovationRun> run = ready_run(recording, nominal);
  if (!run) return std::nullopt;
  const ClocksPutRight* right = ready.clocks_put_right ? &*ready.clocks_put_right : nullptr;
  KnownRun known{*std::move(run), model_of(ready.by_right_clocks(), r), {}};
  const double first_s = known.run.truth.front().time_s;
  known.clocks = {first_s, known.model.truth.time_offset_s, 0.0};
  if (!right) return known;
  const std::optional<AlignedClock> own =
      r < right->clocks.size() ? right->clocks[r] : aligned_clock(known.run, known.model);
  if (!own) return known;
  known.clocks = {first_s, own->offset_s, own->rate};
  put_clock_right(known.run, known.model, *own);
  return known;
}

TimeStretches KnownRun::as_stamped(TimeStretches on_right_clock) const {
  for (auto& [from_s, to_s] : on_right_clock)
    for (double* t : {&from_s, &to_s}) *t = clocks.wheels_stamp_s(*t + clocks.offset_s);
  return on_right_clock;
}

Result<ReadyRecordings> ready_recordings(const std::vector<Recording>& train, const std::vector<Recording>& held_out,
                                         const Vehicle& nominal, const Progress& progress, bool truth_is_white,
                                         const std::vector<TimeStretches>& also_left_out_s, double right_older_s) {
  if (train.empty()) return Error{"recordings", "none", "one or more"};
  ReadyRecordings ready;
  ready.train.resize(train.size());
  ready.held_out.resize(held_out.size());
  std::vector<const Recording*> given;
  std::vector<Recording> unfiltered;  // what is given instead, where the truth was filtered
  std::vector<CheckedRecording*> each;
  for (const std::vector<Recording>* of : {&train, &held_out})
    for (const Recording& r : *of) given.push_back(&r);
  for (std::vector<CheckedRecording>* of : {&ready.train, &ready.held_out})
    for (CheckedRecording& c : *of) each.push_back(&c);
  for (const Recording* r : given)
    if (const std::vector<std::string> problems = problems_in(*r); !problems.empty())
      return Error{r->name.empty() ? "recording" : r->name, "", problems.front()};
  // `clocks`: where these are known.
  const auto check = [&](const std::vector<std::optional<AlignedClock>>& clocks) {
    parallel_for(static_cast<int>(each.size()), [&](int i) {
      const auto r = static_cast<std::size_t>(i);
      CheckedRecording& one = *each[r];
      one = checked(*given[r], nominal, clocks[r]);
      if (auto measured = as_if_measured(one.recording, nominal)) {
        one.recording = std::move(measured->recording);
        one.warnings.push_back(std::move(measured->said));
      }
      if (r >= also_left_out_s.size()) return;
      one.left_out_s.insert(one.left_out_s.end(), also_left_out_s[r].begin(), also_left_out_s[r].end());
      one.left_out_s = joined(std::move(one.left_out_s));
    });
  };
  check(std::vector<std::optional<AlignedClock>>(each.size()));
  std::vector<Recording> all;
  for (const CheckedRecording* c : each) all.push_back(c->recording);
  for (const std::optional<Error>& fault : faults_in(all, nominal))
    if (fault) return *fault;
  const PutRight put_right = mountings_put_right(all, nominal, [&](double) { return goes_on(progress, 0.0); });
  const auto put_mountings_right = [&] {
    for (const MovedMounting& m : put_right.moved) each[m.index]->recording = put_right.recordings[m.index];
  };
  put_mountings_right();
  ready.moved = put_right.moved;

  for (const CheckedRecording& c : ready.train) ready.from_commands = ready.from_commands || c.from_commands;
  const auto calibrate = [&]() -> Result<Done> {
    LeastSquaresOptions with_faults_left_out;
    with_faults_left_out.by_commands = ready.from_commands;
    with_faults_left_out.truth_is_white = truth_is_white;
    with_faults_left_out.truth_is_unfiltered = !unfiltered.empty();
    std::vector<Recording> fitted;
    for (const CheckedRecording& c : ready.train) {
      fitted.push_back(c.recording);
      with_faults_left_out.left_out.push_back(c.left_out_s);
    }
    Result<LeastSquaresCalibration> calibration = calibrate_least_squares(
        fitted, nominal, with_faults_left_out, [&](double share) { return goes_on(progress, share); });
    if (!calibration) return calibration.error();
    ready.calibration = *std::move(calibration);
    if (!ready.clocks_put_right) return Done{};
    with_faults_left_out.clocks = ready.clocks_put_right->clocks;
    calibration = calibrate_least_squares(fitted, nominal, with_faults_left_out,
                                          [&](double share) { return goes_on(progress, share); });
    if (calibration)
      ready.clocks_put_right->calibration = *std::move(calibration);
    else
      ready.clocks_put_right.reset();
    return Done{};
  };
  if (const Result<Done> done = calibrate(); !done) return done.error();
  if (const std::optional<TruthFilter> filter = ready.calibration.truth_filter) {
    ready.warnings.push_back(filter_in_words(*filter));
    for (const Recording* r : given) unfiltered.push_back(unfiltered_truth(*r, *filter));
    for (std::size_t i = 0; i < given.size(); ++i) given[i] = &unfiltered[i];
    check(std::vector<std::optional<AlignedClock>>(each.size()));
    put_mountings_right();
    if (const Result<Done> done = calibrate(); !done) return done.error();
  }
  const auto known_clocks = [&] {
    std::vector<std::optional<AlignedClock>> known(each.size());
    for (std::size_t i = 0; i < each.size(); ++i)
      if (const auto run = known_run(ready, *each[i], i, nominal))
        known[i] = AlignedClock{run->clocks.offset_s, run->clocks.rate};
    return known;
  };
  const bool encoders_seem_to_err = std::any_of(each.begin(), each.end(), [](const CheckedRecording* c) {
    return std::any_of(c->faults.begin(), c->faults.end(),
                       [](const DataFault& f) { return f.effect == "encoder_data_fault"; });
  });
  if (are_clocks_far_off(ready.calibration, nominal, encoders_seem_to_err)) {
    std::vector<CheckedRecording> as_told;
    for (const CheckedRecording* c : each) as_told.push_back(*c);
    check(known_clocks());
    put_mountings_right();
    if (!calibrate())  // all that is left contradicts the wheels, as stamped
      for (std::size_t i = 0; i < each.size(); ++i) *each[i] = std::move(as_told[i]);
  }
  if (std::optional<std::vector<AlignedClock>> moments = clocks_by_moments(ready, nominal)) {
    ready.clocks_put_right = ClocksPutRight{*std::move(moments), {}, ready.calibration};
    if (const Result<Done> done = calibrate(); !done) return done.error();
    std::optional<std::vector<AlignedClock>> clocks = clocks_that_run_apart(ready, nominal);
    if (clocks && ready.clocks_put_right)
      ready.clocks_put_right->clocks = *std::move(clocks);
    else
      ready.clocks_put_right.reset();
  }
  if (ready.clocks_put_right) {
    if (const Result<Done> done = calibrate(); !done) return done.error();
    // By clocks that ran apart the truth drove on where wheels stood.
    const std::vector<std::optional<AlignedClock>> known = known_clocks();
    for (std::size_t i = ready.train.size(); ready.clocks_put_right && i < each.size(); ++i)
      ready.clocks_put_right->held_out_clocks.push_back(known[i].value_or(AlignedClock{nominal.truth.time_offset_s}));
    check(known);
    put_mountings_right();
    if (const Result<Done> done = calibrate(); !done) return done.error();
  }
  const bool some_is_lost = leave_out_what_encoders_lose(ready, each, nominal);
  const bool some_are_alike = leave_out_alike_holds(each, nominal);
  if (right_older_s != 0.0) read_at_one_time(each, nominal, right_older_s);
  if (some_are_alike || some_is_lost || right_older_s != 0.0)
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
  const LeastSquaresCalibration told = ready.told();
  for (CheckedRecording* c : each) {
    ready.warnings.insert(ready.warnings.end(), c->warnings.begin(), c->warnings.end());
    if (told.truth_apart_s > 0.0) c->recording = with_truth_apart(c->recording, told.truth_apart_s);
  }
  ready.warnings.insert(ready.warnings.end(), told.warnings.begin(), told.warnings.end());
  return ready;
}

Result<JointModel> calibrated_model(const ReadyRecordings& ready, const Vehicle& nominal, bool truth_may_come_back) {
  const std::vector<AlignedClock> as_they_are;
  std::vector<InnovationRun> runs;
  std::vector<char> commands;
  for (Result<InnovationRun>& run :
       condensed_runs(ready.train, nominal, ready.by_right_clocks(), true,
                      ready.clocks_put_right ? ready.clocks_put_right->clocks : as_they_are)) {
    if (!run) return run.error();
    commands.push_back(ready.train[runs.size()].from_commands);
    runs.push_back(*std::move(run));
  }
  JointModel joint(std::move(runs), commands, ready.told(), nominal);
  joint.truth_may_come_back = truth_may_come_back;
  joint.truth_jumps = ready.truth_jumps;
  const LeastSquaresCalibration told = ready.told();
  joint.truth_smoothed_for_s = told.truth_smoothed_for_s;
  joint.truth_noise_lasts = told.truth_lasts();
  joint.linearise();
  joint.gate();
  joint.fit(3);
  joint.fit_noise_and_all();
  return joint;
}

}  // namespace odolab
