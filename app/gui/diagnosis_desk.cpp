#include "app/gui/diagnosis_desk.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/diagnosis/chosen_model.h"
#include "core/diagnosis/given_recordings.h"
#include "core/diagnosis/place_response.h"
#include "core/diagnosis/predicted_mismatch.h"
#include "core/diagnosis/quality.h"
#include "core/diagnosis/units/vehicle_units.h"
#include "core/io/diagnosis_html.h"
#include "core/io/diagnosis_json.h"
#include "core/io/mismatch_csv.h"
#include "core/io/model_toml.h"
#include "core/io/number_text.h"
#include "physics/confirmed_diagnosis.h"
#include "physics/model_replay.h"

namespace odolab {

namespace {

constexpr double kMove_s = 0.7;        // that a simulated track takes to where a switch puts it
constexpr double kOfDiagnosis = 0.75;  // of the time; the rest drives the tracks that are shown
constexpr std::size_t kMostUndo = 30;

// Where a track is at the times of another; it walks along both.
Track at_times_of(const Track& track, const Track& times) {
  Track out;
  std::size_t k = 0;
  for (const TimedPose& t : times) {
    if (track.empty()) break;
    while (k + 2 < track.size() && track[k + 1].time_s < t.time_s) ++k;
    const TimedPose &a = track[k], &b = track[std::min(k + 1, track.size() - 1)];
    const double span_s = b.time_s - a.time_s;
    const double u = span_s > 0.0 ? std::clamp((t.time_s - a.time_s) / span_s, 0.0, 1.0) : 0.0;
    out.push_back({t.time_s,
                   {a.pose.x_m + u * (b.pose.x_m - a.pose.x_m), a.pose.y_m + u * (b.pose.y_m - a.pose.y_m),
                    a.pose.heading_rad + u * (b.pose.heading_rad - a.pose.heading_rad)}});
  }
  return out;
}

std::string truth_words(const Recording& recording) {
  const std::vector<TruthSample> truth = truth_samples(recording);
  if (truth.empty()) return "no truth";
  std::string words = std::to_string(truth.size()) + " poses";
  if (truth.size() > 2) {
    std::vector<double> periods;
    for (std::size_t i = 1; i < truth.size(); ++i) periods.push_back(truth[i].time_s - truth[i - 1].time_s);
    std::nth_element(periods.begin(), periods.begin() + long(periods.size() / 2), periods.end());
    const double period_s = periods[periods.size() / 2];
    if (period_s > 0.0) words += number_text(", %.3g Hz", 1.0 / period_s);
  }
  if (!truth.front().heading_rad) words += ", no headings";
  return words;
}

bool is_same_run(const Recording& a, const Recording& b) {
  if (a.time_s != b.time_s || a.channels.size() != b.channels.size()) return false;
  for (std::size_t c = 0; c < a.channels.size(); ++c) {
    const std::vector<double>&u = a.channels[c].values, &v = b.channels[c].values;
    if (a.channels[c].name != b.channels[c].name || u.size() != v.size()) return false;
    for (std::size_t i = 0; i < u.size(); ++i)
      if (!(u[i] == v[i] || (std::isnan(u[i]) && std::isnan(v[i])))) return false;
  }
  return true;
}

Recording named(const DiagnosisDesk::Run& run) {
  Recording recording = *run.recording;
  recording.name = run.name;
  return recording;
}

}  // namespace

std::vector<Recording> DiagnosisDesk::Answer::fitted() const {
  std::vector<Recording> all;
  for (std::size_t r = 0; r < fitted_on; ++r) all.push_back(named(runs[r]));
  return all;
}

void DiagnosisDesk::remember() {
  undo_.push_back(given_);
  if (undo_.size() > kMostUndo) undo_.erase(undo_.begin());
  redo_.clear();
  if (!opening_) problem_.clear();
}

void DiagnosisDesk::changed() {
  ++revision_;
  rename_runs();
  judge_runs();
}

void DiagnosisDesk::undo() {
  if (undo_.empty()) return;
  redo_.push_back(given_);
  given_ = undo_.back();
  undo_.pop_back();
  changed();
}

void DiagnosisDesk::redo() {
  if (redo_.empty()) return;
  undo_.push_back(given_);
  given_ = redo_.back();
  redo_.pop_back();
  changed();
}

void DiagnosisDesk::rename_runs() {
  std::vector<Recording> names;
  std::vector<std::string> paths;
  for (const Run& run : given_.runs) {
    Recording only_name;
    only_name.name = run.recording->name;
    names.push_back(only_name);
    paths.push_back(run.path);
  }
  make_names_differ(names, paths);
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string name = names[i].name;
    for (int k = 2;
         std::any_of(given_.runs.begin(), given_.runs.begin() + long(i), [&](const Run& r) { return r.name == name; });
         ++k)
      name = names[i].name + " (" + std::to_string(k) + ")";
    given_.runs[i].name = name;
  }
}

// What is wrong with each run, now that the vehicle is another.
void DiagnosisDesk::judge_runs() {
  for (Run& run : given_.runs) {
    run.problem.clear();
    run.faults.clear();
    if (const std::vector<std::string> problems = problems_in(*run.recording); !problems.empty())
      run.problem = problems.front();
    if (!given_.vehicle || !run.problem.empty()) continue;
    if (const std::optional<Error> error = unusable(*run.recording, *given_.vehicle, run.name))
      run.problem = error->message();
    if (run.problem.empty() && std::holds_alternative<DifferentialDrive>(given_.vehicle->kind))
      for (const DataFault& fault : checked(*run.recording, *given_.vehicle).faults)
        run.faults.push_back(fault.sentence);
  }
}

void DiagnosisDesk::set_vehicle(const Vehicle& vehicle) {
  remember();
  given_.vehicle = vehicle;
  given_.mystery.reset();
  given_.guess.reset();
  given_.revealed = false;
  changed();
}

Result<Done> DiagnosisDesk::add(const std::string& path, ImportedRecording imported) {
  Recording& recording = imported.recording;
  for (const Run& run : given_.runs)
    if (is_same_run(*run.recording, recording)) {
      if (run.path != path) return Done{};  // the other file of a pair that is dropped with it
      return Error{path, "the same run as " + run.name, "one that is not in the list"};
    }
  remember();
  Run run;
  run.path = path;
  run.notes = std::move(imported.warnings);
  Track truth = truth_track(recording);
  std::vector<double> time_s, x_m, y_m;
  for (const TruthSample& t : truth_samples(recording)) {
    time_s.push_back(t.time_s);
    x_m.push_back(t.position.x_m);
    y_m.push_back(t.position.y_m);
  }
  run.truth_words = truth_words(recording);
  run.way = std::make_shared<const ui::Trail>(time_s, x_m, y_m);
  run.truth = std::make_shared<const Track>(std::move(truth));
  run.recording = std::make_shared<const Recording>(std::move(recording));
  given_.runs.push_back(std::move(run));
  changed();
  return Done{};
}

void DiagnosisDesk::carry_out(const ui::DiagnosisAction& action, Jobs& jobs) {
  if (const auto* hold = std::get_if<ui::HoldOut>(&action); hold && hold->run < given_.runs.size()) {
    remember();
    given_.runs[hold->run].held_out = hold->on;
    ++revision_;
  }
  if (const auto* remove = std::get_if<ui::RemoveRun>(&action); remove && remove->run < given_.runs.size()) {
    remember();
    given_.runs.erase(given_.runs.begin() + long(remove->run));
    changed();
  }
  if (std::holds_alternative<ui::ClearRuns>(action)) {
    remember();
    given_.runs.clear();
    if (given_.mystery) given_.vehicle.reset();
    given_.mystery.reset();
    given_.guess.reset();
    answer_.reset();
    changed();
  }
  if (std::holds_alternative<ui::FindMissing>(action)) find_missing(jobs);
  if (const auto* s = std::get_if<ui::SwitchFinding>(&action)) switch_finding(s->finding, s->on, jobs);
  if (const auto* draw = std::get_if<ui::DrawMystery>(&action)) draw_mystery(draw->seed, jobs);
  if (const auto* guess = std::get_if<ui::GuessMystery>(&action); guess && given_.mystery && !given_.revealed)
    given_.guess = guess->guess;
  if (std::holds_alternative<ui::RevealMystery>(action) && given_.mystery && given_.guess) given_.revealed = true;
  if (std::holds_alternative<ui::SimulateAdvice>(action)) simulate_advice(jobs);
}

void DiagnosisDesk::find_missing(Jobs& jobs) {
  problem_.clear();
  if (!given_.vehicle) return complain("No vehicle: open the vehicle's file, as it is believed to be.");
  if (const std::optional<Error> other = undiagnosed_kind(*given_.vehicle)) return complain(other->message());
  auto answer = std::make_shared<Answer>();
  answer->nominal = *given_.vehicle;
  for (const bool held_out : {false, true}) {
    for (const Run& run : given_.runs)
      if (run.held_out == held_out && run.problem.empty()) answer->runs.push_back(run);
    if (!held_out) answer->fitted_on = answer->runs.size();
  }
  if (answer->fitted_on == 0)
    return complain(given_.runs.empty() ? "Nothing to fit: drop recordings first."
                                        : "Nothing to fit: every run is held out or cannot be used.");
  const int revision = revision_;
  const auto problem = std::make_shared<std::string>();
  const auto simulations = std::make_shared<std::map<Choice, SimulatedRuns>>();
  jobs.start(
      "looking for missing physics",
      [answer, problem, simulations](const Progress& progress, const Jobs::Deliver&) {
        std::vector<Recording> held_out;
        for (std::size_t r = answer->fitted_on; r < answer->runs.size(); ++r)
          held_out.push_back(named(answer->runs[r]));
        Result<Diagnosis> found = confirmed_diagnosis(answer->fitted(), held_out, answer->nominal, [&](double share) {
          return goes_on(progress, kOfDiagnosis * share);
        });
        if (!found) {
          *problem = found.error().message();
          return;
        }
        answer->diagnosis = std::move(*found);
        const Diagnosis drawn = with_held_out_residuals(answer->diagnosis, held_out, answer->nominal);
        for (const Run& run : answer->runs) {
          answer->mismatch.push_back(mismatch_over_time(drawn, run.name));
          const MismatchOverTime& m = answer->mismatch.back();
          answer->trails.emplace_back(m.time_s, m.x_m, m.y_m, m.before);
          const Residuals* left = of_recording(drawn.residuals_before, run.name);
          answer->mean_square.push_back(left ? mean_square(*left) : 0.0);
          answer->located.push_back(located_stretches(drawn, run.name));
        }
        answer->responses = answer->diagnosis.responses;
        for (Response& r : place_responses(answer->diagnosis.residuals_before, answer->diagnosis.residuals_after,
                                           !answer->diagnosis.findings.empty()))
          answer->responses.push_back(std::move(r));
        Choice none(answer->diagnosis.findings.size(), false), all;
        for (const Finding& f : answer->diagnosis.findings) all.push_back(can_be_switched_on(f));
        const double part = 0.5 * (1.0 - kOfDiagnosis);
        (*simulations)[none] = simulated(
            *answer, none, [&](double share) { return goes_on(progress, kOfDiagnosis + part * share); }, *problem);
        if (all != none)
          (*simulations)[all] = simulated(
              *answer, all, [&](double share) { return goes_on(progress, kOfDiagnosis + part * (1.0 + share)); },
              *problem);
      },
      [this, answer, problem, simulations, revision](bool cancelled) {
        if (cancelled) return complain("Cancelled. What was answered before still stands.");
        if (answer->mismatch.empty()) return complain(*problem);
        problem_ = *problem;
        answer_ = answer;
        answered_revision_ = revision;
        ++answers_;
        simulations_ = std::move(*simulations);
        on_.assign(answer_->diagnosis.findings.size(), false);
        shown_ = simulations_.count(on_) > 0 ? simulations_[on_].tracks : std::vector<Track>{};
        from_ = shown_;
        share_ = 1.0;
        advised_way_.clear();
        if (const auto* drive = std::get_if<DifferentialDrive>(&answer_->nominal.kind))
          advised_way_ = advised_path(*drive, answer_->diagnosis.next_legs, advice_start());
      });
}

SimulatedRuns DiagnosisDesk::simulated(const Answer& answer, const Choice& choice, const Progress& progress,
                                       std::string& problem) {
  SimulatedRuns out;
  const Result<FittedModel> model = model_with(answer.diagnosis, choice, answer.fitted(), answer.nominal);
  if (!model) {
    problem = model.error().message();
    return out;
  }
  const std::size_t count = answer.runs.size();
  out.tracks.resize(count);
  std::vector<std::optional<TrackError>> errors(count);
  std::vector<std::string> problems(count);
  parallel_for(
      static_cast<int>(count),
      [&](int job, const std::atomic<bool>& stopped) {
        const auto r = static_cast<std::size_t>(job);
        const Result<Replay> replayed = replay_with(*model, std::make_shared<const Recording>(named(answer.runs[r])),
                                                    [&](double) { return !stopped; });
        if (!replayed) {
          problems[r] = replayed.error().message();
          return;
        }
        out.tracks[r] = at_times_of(replayed->simulated, replayed->truth);
        if (replayed->truth_has_headings) errors[r] = replayed->simulated_error;
      },
      {}, progress);
  for (const std::string& words : problems)
    if (problem.empty()) problem = words;
  out.error = joined_figures(errors);
  return out;
}

void DiagnosisDesk::switch_finding(std::size_t finding, bool on, Jobs& jobs) {
  if (!answer_ || finding >= on_.size() || !can_be_switched_on(answer_->diagnosis.findings[finding])) return;
  problem_.clear();
  Choice choice = on_;
  choice[finding] = on;
  if (simulations_.count(choice) > 0)
    move_to(choice);
  else
    simulate(choice, jobs);
}

void DiagnosisDesk::simulate(const Choice& choice, Jobs& jobs) {
  const std::shared_ptr<const Answer> answer = answer_;
  const auto made = std::make_shared<SimulatedRuns>();
  const auto problem = std::make_shared<std::string>();
  const bool started = jobs.start(
      "driving the simulation",
      [answer, choice, made, problem](const Progress& progress, const Jobs::Deliver&) {
        *made = simulated(*answer, choice, progress, *problem);
      },
      [this, answer, choice, made, problem](bool cancelled) {
        if (cancelled || answer != answer_) return;
        problem_ = *problem;
        simulations_[choice] = std::move(*made);
        move_to(choice);
      });
  if (!started) complain("Busy " + jobs.name() + ": switch findings when it is done.");
}

void DiagnosisDesk::move_to(const Choice& choice) {
  on_ = choice;
  from_ = shown_;
  share_ = 0.0;
}

void DiagnosisDesk::advance(double wall_s) {
  opening_ = false;
  if (share_ >= 1.0 || wall_s <= 0.0) return;
  share_ = std::min(1.0, share_ + wall_s / kMove_s);
  const auto to = simulations_.find(on_);
  if (to == simulations_.end() || share_ >= 1.0 || from_.size() != to->second.tracks.size()) {
    share_ = 1.0;
    if (to != simulations_.end()) shown_ = to->second.tracks;
    return;
  }
  const double u = share_ * share_ * (3.0 - 2.0 * share_);
  for (std::size_t r = 0; r < shown_.size(); ++r) {
    const Track &a = from_[r], &b = to->second.tracks[r];
    shown_[r] = b;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
      Pose& p = shown_[r][i].pose;
      p = {a[i].pose.x_m + u * (p.x_m - a[i].pose.x_m), a[i].pose.y_m + u * (p.y_m - a[i].pose.y_m),
           a[i].pose.heading_rad + u * (p.heading_rad - a[i].pose.heading_rad)};
    }
  }
}

void DiagnosisDesk::draw_mystery(std::uint64_t seed, Jobs& jobs) {
  problem_.clear();
  const auto drawn = std::make_shared<std::shared_ptr<const DrawnMystery>>();
  const bool started = jobs.start(
      "drawing a mystery robot and driving it",
      [drawn, seed](const Progress& progress, const Jobs::Deliver&) {
        if (std::optional<DrawnMystery> mystery = drawn_mystery(seed, progress))
          *drawn = std::make_shared<const DrawnMystery>(std::move(*mystery));
      },
      [this, drawn](bool cancelled) {
        if (cancelled || !*drawn) return;
        remember();
        const std::size_t kept = undo_.size();
        given_ = Given{};
        answer_.reset();
        given_.vehicle = (*drawn)->nominal;
        for (const Recording& recording : (*drawn)->recordings) (void)add("", {recording, {}});
        undo_.resize(kept);  // one step
        given_.mystery = *drawn;
      });
  if (!started) complain("Busy " + jobs.name() + ": draw a robot when it is done.");
}

Pose DiagnosisDesk::advice_start() const {
  if (!answer_) return {};
  const Track& truth = *answer_->runs.front().truth;
  if (truth.empty()) return {};
  return truth.front().pose * inverse(answer_->diagnosis.calibration.vehicle.truth.axle_T_tracked);
}

void DiagnosisDesk::simulate_advice(Jobs& jobs) {
  problem_.clear();
  if (!answer_ || answer_->diagnosis.next_legs.empty()) return;
  if (!std::holds_alternative<DifferentialDrive>(answer_->nominal.kind)) return;
  const std::shared_ptr<const Answer> answer = answer_;
  const std::shared_ptr<const DrawnMystery> mystery = given_.mystery;
  const auto made = std::make_shared<Recording>();
  const Pose start = advice_start();
  int before = 0;
  for (const Run& run : given_.runs) before += run.recording->name.rfind("advised", 0) == 0;
  const std::string name = "advised_" + std::to_string(before + 1) + ".csv";
  const auto seed = static_cast<std::uint64_t>(1001 + before);
  const bool started = jobs.start(
      "driving what was advised",
      [answer, mystery, made, start, name, seed](const Progress&, const Jobs::Deliver&) {
        const concealed::RunPlan robot =
            mystery ? mystery->robot : robot_of(model_of(answer->diagnosis), answer->diagnosis.calibration.noise);
        *made = advised_run(robot, answer->diagnosis.next_legs, start, name, seed);
      },
      [this, made, mystery](bool cancelled) {
        if (cancelled) return;
        if (const Result<Done> added = add("", {std::move(*made), {}}); !added)
          return complain(added.error().message());
        given_.runs.back().simulated = mystery == nullptr;
      });
  if (!started) complain("Busy " + jobs.name() + ": drive the advice when it is done.");
}

std::optional<std::size_t> DiagnosisDesk::answered(const Run& run) const {
  for (std::size_t r = 0; answer_ && r < answer_->runs.size(); ++r)
    if (answer_->runs[r].recording == run.recording) return r;
  return std::nullopt;
}

Result<Done> DiagnosisDesk::write(const ui::ExportDiagnosis& what) const {
  if (!answer_) return Error{what.path, "no answer yet", "a diagnosis to write"};
  switch (what.what) {
    case ui::DiagnosisExport::report:
      return write_report(what.path, diagnosis_report(answer_->diagnosis));
    case ui::DiagnosisExport::model:
      return write_model(what.path, model_of(answer_->diagnosis));
    case ui::DiagnosisExport::json:
      return write_json(what.path, diagnosis_json(answer_->diagnosis));
    case ui::DiagnosisExport::csv:
      break;
  }
  const std::optional<std::size_t> r =
      what.run < given_.runs.size() ? answered(given_.runs[what.run]) : std::optional<std::size_t>();
  if (!r) return Error{what.path, "a run that was not diagnosed", "one of the answer's"};
  return write_mismatch_csv(what.path, answer_->mismatch[*r], *answer_->runs[*r].truth,
                            *r < shown_.size() ? shown_[*r] : Track{}, what.stretches);
}

}  // namespace odolab
