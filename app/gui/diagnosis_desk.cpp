#include "app/gui/diagnosis_desk.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/quantile.h"
#include "core/calibration/recording_fault.h"
#include "core/diagnosis/given_recordings.h"
#include "core/diagnosis/quality/quality.h"
#include "core/io/diagnosis_html.h"
#include "core/io/diagnosis_json.h"
#include "core/io/mismatch_csv.h"
#include "core/io/model_toml.h"
#include "core/io/number_text.h"
#include "core/recording/same_samples.h"
#include "physics/model_replay.h"

namespace odolab {

namespace {

constexpr std::size_t kMostDiagnosisUndo = 30;

std::string truth_words(const Recording& recording) {
  const std::vector<TruthSample> truth = truth_samples(recording);
  if (truth.empty()) return "no truth";
  std::string words = std::to_string(truth.size()) + " poses";
  if (truth.size() > 2) {
    std::vector<double> periods;
    for (std::size_t i = 1; i < truth.size(); ++i) periods.push_back(truth[i].time_s - truth[i - 1].time_s);
    const double period_s = median(std::move(periods));
    if (period_s > 0.0) words += number_text(", %.3g Hz", 1.0 / period_s);
  }
  if (!truth.front().heading_rad) words += ", no headings";
  return words;
}

}  // namespace

void DiagnosisDesk::remember() {
  undo_.push_back(given_);
  if (undo_.size() > kMostDiagnosisUndo) undo_.erase(undo_.begin());
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
    for (const Run& other : given_.runs) {
      if (&other == &run || !run.problem.empty()) break;
      if (same_samples(*other.recording, *run.recording)) run.problem = "the same run as " + other.name;
    }
    if (run.problem.empty())
      if (const std::optional<Error> fault = fault_in(*run.recording, *given_.vehicle))
        run.problem = fault->found + ", expected " + fault->expected;
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
  for (const Run& run : given_.runs)
    if (same_samples(*run.recording, imported.recording)) {
      if (run.path != path) return Done{};  // the other file of a pair that is dropped with it
      return Error{path, "the same run as " + run.name, "one that is not in the list"};
    }
  remember();
  append(path, std::move(imported));
  changed();
  return Done{};
}

void DiagnosisDesk::append(const std::string& path, ImportedRecording imported) {
  Recording& recording = imported.recording;
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
  if (const auto* show = std::get_if<ui::ShowUnit>(&action)) unit_ = show->unit;
  if (const auto* s = std::get_if<ui::SwitchFinding>(&action)) switch_finding(s->finding, s->on, jobs);
  if (const auto* draw = std::get_if<ui::DrawMystery>(&action)) draw_mystery(draw->seed, jobs);
  if (const auto* guess = std::get_if<ui::GuessMystery>(&action); guess && given_.mystery && !given_.revealed)
    given_.guess = guess->guess;
  if (std::holds_alternative<ui::RevealMystery>(action) && given_.mystery && given_.guess) given_.revealed = true;
  if (std::holds_alternative<ui::SimulateAdvice>(action)) simulate_advice(jobs);
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
        given_ = Given{};
        answer_.reset();
        given_.vehicle = (*drawn)->nominal;
        for (const Recording& recording : (*drawn)->recordings) append("", {recording, {}});
        given_.mystery = *drawn;
        changed();
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
  int last = 0;
  for (const Run& run : given_.runs)
    if (int number = 0; std::sscanf(run.recording->name.c_str(), "advised_%d", &number) == 1)
      last = std::max(last, number);
  const std::string name = "advised_" + std::to_string(last + 1) + ".csv";
  const auto seed = static_cast<std::uint64_t>(1001 + last);
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

const UnitMismatch* DiagnosisDesk::unit_of(std::size_t answered) const {
  const std::vector<UnitMismatch>& units = answer_->units[answered];
  for (const UnitMismatch& unit : units)
    if (unit.unit == unit_) return &unit;
  return units.empty() ? nullptr : &units.front();
}

Result<Done> DiagnosisDesk::write(const ui::ExportDiagnosis& what) const {
  if (!answer_) return Error{what.path, "no answer yet", "a diagnosis to write"};
  switch (what.what) {
    case ui::DiagnosisExport::report:
      return write_report(what.path, diagnosis_report(answer_->diagnosis));
    case ui::DiagnosisExport::model:
      return write_model(what.path, model_of(answer_->diagnosis, answer_->fitted()));
    case ui::DiagnosisExport::json:
      return write_json(what.path, diagnosis_json(answer_->diagnosis));
    case ui::DiagnosisExport::csv:
      break;
  }
  const std::optional<std::size_t> r =
      what.run < given_.runs.size() ? answered(given_.runs[what.run]) : std::optional<std::size_t>();
  if (!r) return Error{what.path, "a run that was not diagnosed", "one of the answer's"};
  const UnitMismatch* unit = unit_of(*r);
  return write_mismatch_csv(what.path, unit ? unit->mismatch : MismatchOverTime{}, answer_->truth[*r],
                            *r < shown_.size() ? shown_[*r] : Track{}, what.stretches);
}

}  // namespace odolab
