// The answer to what is missing, and the simulation with what was found switched on and off.
#include <algorithm>

#include "app/gui/diagnosis_desk.h"
#include "core/base/parallel.h"
#include "core/diagnosis/chosen_model.h"
#include "core/diagnosis/place_response.h"
#include "core/diagnosis/units/vehicle_units.h"
#include "physics/confirmed_diagnosis.h"
#include "physics/model_replay.h"

namespace odolab {

namespace {

constexpr double kMove_s = 0.7;        // that a simulated track takes to where a switch puts it
constexpr double kOfDiagnosis = 0.75;  // of the time; the rest drives the tracks that are shown

// Of the axle, where what was recorded is drawn too.
Track axle_of(Track tracked, const TruthMounting& mounting) {
  for (TimedPose& p : tracked) p.pose = p.pose * inverse(mounting.axle_T_tracked);
  return tracked;
}

// Poses at both ends, or once in a while, draw no way.
bool draws_a_way(const std::vector<TruthSample>& truth) {
  constexpr double kEvery_s = 0.5;
  return truth.size() > 2 && truth.back().time_s - truth.front().time_s < kEvery_s * static_cast<double>(truth.size());
}

// Where a track is at the times of another; it walks along both.
Track at_times_of(const Track& track, const std::vector<TruthSample>& times) {
  if (!draws_a_way(times)) return track;
  Track out;
  std::size_t k = 0;
  for (const TruthSample& t : times) {
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

Recording named_recording(const DiagnosisDesk::Run& run) {
  Recording recording = *run.recording;
  recording.name = run.name;
  return recording;
}

}  // namespace

std::vector<Recording> DiagnosisDesk::Answer::fitted() const {
  std::vector<Recording> all;
  for (std::size_t r = 0; r < fitted_on; ++r) all.push_back(named_recording(runs[r]));
  return all;
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
          held_out.push_back(named_recording(answer->runs[r]));
        Result<Diagnosis> found = confirmed_diagnosis(answer->fitted(), held_out, answer->nominal, [&](double share) {
          return goes_on(progress, kOfDiagnosis * share);
        });
        if (!found) {
          *problem = found.error().message();
          return;
        }
        answer->diagnosis = std::move(*found);
        const Diagnosis drawn = with_held_out_units(answer->diagnosis, answer->fitted(), held_out, answer->nominal);
        for (const Run& run : answer->runs) {
          answer->units.push_back(unit_mismatches(drawn, run.name, answer->nominal));
          answer->located.push_back(located_stretches(drawn, run.name));
          answer->truth.push_back(has_units(answer->nominal)
                                      ? *run.truth
                                      : axle_of(*run.truth, answer->diagnosis.calibration.vehicle.truth));
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
        if (answer->units.empty()) return complain(*problem);
        problem_ = *problem;
        answer_ = answer;
        answered_revision_ = revision;
        ++answers_;
        double worst = -1.0;
        for (const std::vector<UnitMismatch>& units : answer_->units)
          for (const UnitMismatch& unit : units)
            if (unit.mean_square > worst) {
              worst = unit.mean_square;
              unit_ = unit.unit;
            }
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
        Recording recording = named_recording(answer.runs[r]);
        const std::vector<TruthSample> recorded = truth_samples(recording);
        const std::string name = recording.name;
        const WaysUnknown unknown = ways_unknown({recording}, answer.diagnosis, *model);
        recording = with_truth_that_was_used(std::move(recording), answer.diagnosis);
        const Result<Replay> replayed =
            replay_with(*model, answer.nominal, std::make_shared<const Recording>(std::move(recording)),
                        [&](double) { return !stopped; });
        if (!replayed) {
          problems[r] = replayed.error().message();
          return;
        }
        out.tracks[r] = at_times_of(replayed->simulated, recorded);
        if (!has_units(answer.nominal)) out.tracks[r] = axle_of(std::move(out.tracks[r]), model->vehicle.truth);
        errors[r] = error_where_known(*replayed, unknown, name);
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

}  // namespace odolab
