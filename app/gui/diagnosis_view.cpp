#include "app/gui/diagnosis_view.h"

#include <algorithm>
#include <cmath>

#include "app/gui/diagnosis_desk.h"
#include "core/diagnosis/chosen_model.h"
#include "core/diagnosis/units/vehicle_units.h"
#include "core/io/diagnosis_text.h"
#include "core/io/number_text.h"
#include "core/io/verdict_sentence.h"
#include "core/io/window_words.h"
#include "core/vehicle/key_words.h"

namespace odolab {

namespace {

std::string capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = char(text[0] - 'a' + 'A');
  return text;
}

std::string guess_words(const std::string& guess) {
  return guess.empty() ? "nothing is missing" : guess == kOutsideGuess ? "something in no list" : effect_words(guess);
}

// A log-likelihood gain: what is large needs no digits behind the point.
std::string gain_text(double gain) { return number_text(gain < 100.0 ? "%.3g" : "%.0f", gain); }

std::string evidence_words(const Finding& f) {
  std::string words;
  if (f.log_likelihood_gain > 0.0)
    words = "log-likelihood gain " + gain_text(f.log_likelihood_gain) + ", " +
            (f.p_value < 1e-15 ? "by chance below 1e-15" : number_text("by chance %.1g", f.p_value));
  if (f.share_of_mismatch > 0.0 && f.effect != "unknown")
    words += (words.empty() ? "" : "; ") + number_text("%.0f %% of the mismatch", 100.0 * f.share_of_mismatch);
  if (f.moves) words += (words.empty() ? "" : "; ") + ("moves a metre or radian by " + moved_text(*f.moves));
  return words;
}

ui::FindingCard card_of(const Finding& f, bool on) {
  ui::FindingCard card;
  card.title = capital(f.effect == "unknown" ? "something without a name" : effect_text(f.effect, f.component));
  card.sentence = capital(f.sentence);
  card.where = f.effect == "unknown" ? "" : where_text(f.where);  // an unknown's sentence says it
  if (!f.form_in_words.empty()) card.where += (card.where.empty() ? "its form: " : "; its form: ") + f.form_in_words;
  card.evidence = evidence_words(f);
  for (const FoundParameter& p : f.parameters)
    card.parameters.emplace_back(parameter_words(p.name), quantity_text(p.value, p.stderr_value, p.unit));
  for (const Alternative& a : f.alternatives) {
    card.alternatives.emplace_back((f.effect == "unknown" ? "resembles " : "or ") + effect_text(a.effect, a.component) +
                                       " (gain " + gain_text(a.log_likelihood_gain) + ")",
                                   a.told_apart_by);
  }
  card.can_be_switched = can_be_switched_on(f);
  card.on = on;
  return card;
}

ui::AskedRow asked_row(const AskedEffect& a) {
  constexpr double kCertain = 1e-12;
  ui::AskedRow row;
  row.effect = capital(effect_text(a.effect, a.component));
  row.named = a.named;
  row.answer = a.named                ? "named"
               : a.p_value >= 1.0     ? "no sign of it"
               : a.p_value < kCertain ? "beyond chance"
                                      : number_text("chance %.2g", a.p_value);
  row.grounds = "Gain in log-likelihood beside the calibration " + gain_text(a.log_likelihood_gain);
  if (a.gain_beside_findings) row.grounds += ", beside what was found " + gain_text(*a.gain_beside_findings);
  row.grounds += ".";
  if (a.survives)
    row.grounds += number_text(" Of what it does, calibration leaves %.2g %% to be seen", 100.0 * *a.survives) +
                   (a.bends ? "; most of the rest would go into the " + parameter_words(a.bends->name) : "") + ".";
  if (a.least_seen)
    row.grounds +=
        " " + size_text(a.least_seen->value, a.least_seen->unit) + " would have been seen nine times in ten.";
  else if (!a.named)
    row.grounds += " No size of it would show on these drives.";
  return row;
}

void add_proof(ui::DiagnosisView& view, const Diagnosis& d) {
  const bool held_out = d.held_out.calibrated.has_value();
  const FitTable& fit = held_out ? d.held_out : d.train;
  view.over_which_way = over_which_way((held_out ? d.held_out_over : d.train_over).value_or(WindowSize{}));
  view.proof_title = !held_out            ? "On the runs that were fitted"
                     : d.left_out_in_turn ? "Each run predicted from the others"
                                          : "On the runs that were held out";
  const auto add = [&](const char* label, const std::optional<FitFigures>& f, ui::ProofBar::Kind kind) {
    if (f && f->gathered()) view.proof.push_back({label, f->position_rms_m, f->heading_rms_rad, kind});
  };
  add("calibrated only", fit.calibrated, ui::ProofBar::Kind::calibrated);
  if (any_is_put_in(d)) add("with what was found", fit.with_findings, ui::ProofBar::Kind::with_findings);
  add("noise alone", fit.noise_floor, ui::ProofBar::Kind::noise);
}

ui::MysteryView mystery_view(const DrawnMystery& mystery, const std::optional<std::string>& guess, bool revealed,
                             const Diagnosis* diagnosis) {
  ui::MysteryView m;
  m.seed = mystery.seed;
  for (const std::string& g : mystery_guesses()) m.guesses.emplace_back(g, capital(guess_words(g)));
  m.guess = guess;
  m.revealed = revealed;
  if (!revealed) return m;
  const std::string right = right_guess(mystery);
  m.guessed_right = guess && *guess == right;
  m.answer = mystery.kind == concealed::Kind::nothing ? "Nothing was concealed."
             : mystery.kind == concealed::Kind::outside
                 ? capital(effect_words(mystery.effect.effect)) + ": it stands in no list."
                 : capital(effect_text(mystery.effect.effect, mystery.effect.component)) + ".";
  if (!diagnosis) return m;
  m.tool_asked = true;
  m.tool_right = mystery.kind == concealed::Kind::nothing ? diagnosis->verdict == Verdict::nothing_missing
                 : mystery.kind == concealed::Kind::outside
                     ? diagnosis->verdict == Verdict::unknown_effect
                     : !diagnosis->findings.empty() && diagnosis->findings.front().effect == mystery.effect.effect;
  return m;
}

}  // namespace

ui::DiagnosisView DiagnosisDesk::view(const Jobs& jobs) const {
  ui::DiagnosisView v;
  v.busy = jobs.running();
  v.job = jobs.name();
  v.share_done = jobs.share_done();
  v.problem = problem_;
  if (given_.vehicle) v.vehicle_name = given_.vehicle->name;
  const Diagnosis* d = diagnosis();
  bool any = false;
  double worst = 0.0;
  for (const Run& run : given_.runs) {
    ui::DiagnosedRun r;
    r.name = run.name;
    r.provenance = run.recording->provenance;
    r.truth = run.problem.empty() ? run.truth_words : "";
    r.problem = run.problem;
    r.faults = run.faults;
    r.notes = run.notes;
    r.duration_s = run.recording->duration_s();
    r.held_out = run.held_out;
    r.simulated = run.simulated;
    r.way = run.way.get();
    any = any || (run.problem.empty() && !run.held_out);
    if (const std::optional<std::size_t> at = answered(run)) {
      const std::size_t k = *at;
      if (const UnitMismatch* unit = unit_of(k)) {
        r.mismatch = &unit->mismatch;
        r.mismatch_trail = &unit->trail;
        r.unit = unit->unit;
      }
      for (const UnitMismatch& unit : answer_->units[k]) {
        r.units.push_back(unit.unit);
        if (unit.mean_square > worst) {
          worst = unit.mean_square;
          v.worst_run = v.runs.size();
        }
      }
      r.located = answer_->located[k];
      r.truth_track = &answer_->truth[k];
      if (k < shown_.size() && !shown_[k].empty()) r.simulated_track = &shown_[k];
    }
    v.runs.push_back(std::move(r));
  }
  v.can_diagnose = given_.vehicle && any && !v.busy;
  v.why_not = v.busy                ? "Busy " + v.job + "."
              : given_.runs.empty() ? "Drop recordings first."
              : !given_.vehicle     ? "Open the vehicle's file first."
                                    : "Every run is held out or cannot be used.";
  if (given_.mystery) v.mystery = mystery_view(*given_.mystery, given_.guess, given_.revealed, d);
  if (!d) return v;
  v.diagnosis = d;
  v.responses = &answer_->responses;
  v.answers = answers_;
  v.stale = revision_ != answered_revision_;
  v.verdict = verdict_sentence(*d);
  for (std::size_t k = 0; k < d->findings.size(); ++k) v.findings.push_back(card_of(d->findings[k], on_[k]));
  const Choice none(d->findings.size(), false);
  if (const auto at = simulations_.find(none); at != simulations_.end()) v.simulated_before = at->second.error;
  if (const auto at = simulations_.find(on_); at != simulations_.end()) v.simulated_now = at->second.error;
  add_proof(v, *d);
  for (const NotTestable& n : d->not_testable)
    v.not_testable.emplace_back(capital(effect_words(n.effect)),
                                capital(n.because) + ". " + capital(n.drive_this) + ".");
  for (const AskedEffect& a : d->asked) v.asked.push_back(asked_row(a));
  if (!d->next_drive.empty()) v.next_drive = capital(d->next_drive) + ".";
  const auto* drive = std::get_if<DifferentialDrive>(&answer_->nominal.kind);
  if (drive && !d->next_legs.empty()) v.advised_way = advised_way_;
  v.can_simulate_advice = drive && !d->next_legs.empty() && !v.busy;
  v.why_no_advice = v.busy   ? "Busy " + v.job + "."
                    : !drive ? "Only a differential drive is driven so by a button; this one drives it in Drive, or on "
                               "the floor."
                             : "This advice is in words: it has no way that could be drawn.";
  return v;
}

ui::FloorScene diagnosis_scene(const ui::DiagnosisView& view, const ui::DiagnosisState& state, const ui::Theme& theme) {
  ui::FloorScene scene;
  scene.reference_name = "recorded";
  scene.deviating_name = "simulated";
  scene.brushable = true;
  scene.empty_text = "Nothing to draw: this run holds no outside truth";
  if (view.runs.empty()) return scene;
  const std::size_t shown = std::min(state.run, view.runs.size() - 1);
  for (std::size_t r = 0; r < view.runs.size(); ++r)
    if (r != shown && view.runs[r].way && !view.runs[r].way->empty())
      scene.trails.push_back({view.runs[r].way, false, ui::faded(ui::run_colour(r, theme), 0.28f), {}, true});
  const ui::DiagnosedRun& run = view.runs[shown];
  // What is simulated is the truth's point, which another unit's axle is not.
  const bool is_of_a_unit = run.mismatch_trail && run.units.size() > 1;
  if (is_of_a_unit) {
    scene.reference_name = "recorded, " + (run.unit.empty() ? "towing" : part_words(run.unit));
    if (run.way && !run.way->empty())
      scene.trails.push_back({run.way, false, ui::faded(ui::run_colour(shown, theme), 0.5f), {}, true});
  }
  if (run.mismatch_trail)
    scene.trails.push_back({run.mismatch_trail, true, 0, state.brush, false});
  else if (run.way && !run.way->empty())
    scene.trails.push_back({run.way, false, ui::run_colour(shown, theme), {}, false});
  if (run.simulated_track) {
    ui::TrackLine line;
    line.label = is_of_a_unit ? "simulated, the truth's point" : "simulated";
    line.track = run.simulated_track;
    line.reference = run.truth_track;
    line.colour = view.simulated_now && view.findings_on() ? theme.blue : theme.orange;
    line.dash = ui::Dash::dashes;
    scene.tracks.push_back(line);
  }
  if (view.diagnosis)
    for (const Finding& f : view.diagnosis->findings)
      if (f.where.zone)
        scene.discs.push_back({{f.where.zone->x_m, f.where.zone->y_m}, f.where.zone->radius_m, effect_words(f.effect)});
  scene.planned_name = "advised";
  if (state.show_advice) scene.planned = view.advised_way;
  return scene;
}

}  // namespace odolab
