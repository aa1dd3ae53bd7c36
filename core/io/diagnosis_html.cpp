#include "core/io/diagnosis_html.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "core/diagnosis/chosen_model.h"
#include "core/diagnosis/mismatch.h"
#include "core/diagnosis/place_response.h"
#include "core/geometry/angles.h"
#include "core/io/diagnosis_text.h"
#include "core/io/number_text.h"
#include "core/io/picture/bar_picture.h"
#include "core/io/picture/coloured_track_picture.h"
#include "core/io/picture/line_picture.h"
#include "core/io/verdict_sentence.h"
#include "core/io/window_words.h"
#include "core/vehicle/key_words.h"

namespace odolab {

namespace {

constexpr std::size_t kMostRecordings = 4;  // drawn; more make a page that nobody reads
constexpr std::size_t kMostResponses = 3;   // the strongest

// Where the mismatch is largest comes first.
std::vector<const Residuals*> drawn_first(const std::vector<Residuals>& all) {
  std::vector<const Residuals*> order;
  for (const Residuals& r : all)
    if (!r.time_s.empty()) order.push_back(&r);
  std::stable_sort(order.begin(), order.end(),
                   [](const Residuals* a, const Residuals* b) { return mean_square(*a) > mean_square(*b); });
  if (order.size() > kMostRecordings) order.resize(kMostRecordings);
  return order;
}

std::string track_of(const Diagnosis& d, const Residuals& r, const ResidualSizes& noise, const std::string& title,
                     bool with_discs) {
  ColouredTrackPicture picture;
  picture.title = title;
  picture.track = {r.x_m, r.y_m, times_noise(r, noise)};
  const auto came_to = [&](const WhereFound& where) {
    const std::vector<std::string>& others = where.other_recordings;
    return where.recording.empty() || where.recording == r.recording ||
           std::find(others.begin(), others.end(), r.recording) != others.end();
  };
  for (const Finding& f : d.findings)
    if (with_discs && f.where.zone && came_to(f.where))
      picture.discs.push_back({f.where.zone->x_m, f.where.zone->y_m, f.where.zone->radius_m, effect_words(f.effect)});
  return coloured_track_picture(picture);
}

void add_findings(HtmlReport& report, const Diagnosis& d) {
  if (d.findings.empty()) return;
  report.heading("What was found");
  int count = 0;
  for (const Finding& f : faults_together(d.findings)) {
    const std::string name = number_text("%.0f. ", ++count) + effect_text(f.effect, f.component);
    report.sentence(f.sentence.empty() ? name : name + ": " + f.sentence);
    std::vector<std::vector<std::string>> rows;
    for (const FoundParameter& p : f.parameters)
      rows.push_back({parameter_words(p.name), quantity_text(p.value, p.stderr_value, p.unit)});
    const std::string where = where_text(f.where);
    if (!where.empty()) rows.push_back({"where", where});
    if (!f.form_in_words.empty()) rows.push_back({"its form", f.form_in_words});
    if (f.share_of_mismatch > 0.0 && f.effect != "unknown")
      rows.push_back(
          {"share of the mismatch that calibration leaves", number_text("%.0f %%", 100.0 * f.share_of_mismatch)});
    if (f.moves) rows.push_back({"moves each metre or radian in which it acts by", moved_text(*f.moves)});
    if (f.log_likelihood_gain > 0.0)
      rows.push_back({"chance of such evidence if nothing were there",
                      f.p_value < 1e-15 ? "below 1e-15" : number_text("%.1g", f.p_value)});
    if (!rows.empty()) report.table({"", f.parameters.empty() ? "" : "estimate and standard error"}, rows);
    for (const Alternative& a : f.alternatives) {
      const std::string gains = number_text("a log-likelihood gain of %.1f", a.log_likelihood_gain) +
                                number_text(" where this one has %.1f", f.log_likelihood_gain);
      std::string text =
          f.effect == "unknown"
              ? "It resembles " + effect_text(a.effect, a.component) + ", which does not suffice: " + gains + "."
              : "Instead of it, " + effect_text(a.effect, a.component) + " would explain the data with " + gains + ".";
      if (!a.told_apart_by.empty()) text += " The two are told apart by " + a.told_apart_by + ".";
      report.paragraph(text);
    }
  }
}

std::string gathered_picture(const GatheredEvidence& g, const std::string& name) {
  LinePicture picture;
  picture.title = name + ": the evidence as it gathers";
  picture.x_label = g.begins.size() > 1 ? "time driven, " + number_text("%.0f", static_cast<double>(g.begins.size())) +
                                              " recordings end to end [s]"
                                        : "time driven [s]";
  picture.y_label = "gain in log-likelihood";
  picture.bands.push_back({"95 % of drives, if that is what was missing", g.driven_s, g.low, g.high, Look::second});
  picture.lines.push_back({"these drives", g.driven_s, g.gain, Look::second});
  picture.height_px = 320.0;
  for (std::size_t k = 1; k < g.begins.size(); k += 2) {  // every other recording
    const double to_s = k + 1 < g.begins.size() ? g.begins[k + 1].second : g.driven_s.back();
    picture.marked.emplace_back(g.begins[k].second, to_s);
  }
  picture.marked_label = "every second recording";
  picture.marked_ink = ink::kShaded;
  return line_picture(picture);
}

void add_gathered(HtmlReport& report, const Diagnosis& d) {
  if (std::all_of(d.findings.begin(), d.findings.end(), [](const Finding& f) { return f.gathered.gain.empty(); }))
    return;
  report.heading("How the evidence gathers");
  for (const Finding& f : d.findings)
    if (!f.gathered.gain.empty())
      report.picture(gathered_picture(f.gathered, effect_text(f.effect, f.component)),
                     "How much better the recordings fit with it than without, all that was driven until then. Where "
                     "it acts the line climbs, however far it lies below the noise of any moment; elsewhere it is "
                     "level. What acts at other times, or grows otherwise, than this says would leave the band.");
}

void add_place_and_time(HtmlReport& report, const Diagnosis& d) {
  const std::vector<const Residuals*> drawn = drawn_first(d.residuals_before);
  if (drawn.empty()) return;
  report.heading("Where the model and the recordings differ");
  if (d.residuals_before.size() > drawn.size())
    report.paragraph(number_text("The %.0f recordings with the largest mismatch", static_cast<double>(drawn.size())) +
                     number_text(" of %.0f are drawn.", static_cast<double>(d.residuals_before.size())));
  for (const Residuals* before : drawn) {
    const Residuals* after = of_recording(d.residuals_after, before->recording);
    const ResidualSizes noise = sizes_of(after ? *after : *before);
    std::vector<std::string> tracks{track_of(d, *before, noise, before->recording + ": calibrated only", true)};
    if (after && !d.findings.empty())
      tracks.push_back(track_of(d, *after, noise, before->recording + ": with what was found", false));
    report.pictures(
        tracks,
        "The way driven, seen from above; the circle is its start. Colours say how many times larger than noise "
        "would leave it the error of the prediction is, gathered over up to a second.");
    const double from_s = axis_origin_s(before->time_s.front());
    const auto since = [&](std::vector<double> time_s) {
      for (double& t : time_s) t -= from_s;
      return time_s;
    };
    LinePicture line;
    if (from_s > 0.0) line.x_label = "time since " + number_text("%.0f", from_s) + " [s]";
    line.title = before->recording + ": error of the prediction, gathered over up to a second";
    line.y_label = "times the noise";
    line.lines.push_back(
        {"noise alone", since({before->time_s.front(), before->time_s.back()}), {1.0, 1.0}, Look::truth});
    line.lines.push_back({"calibrated only", since(before->time_s), times_noise(*before, noise), Look::estimate});
    if (after && !d.findings.empty())
      line.lines.push_back({"with what was found", since(after->time_s), times_noise(*after, noise), Look::second});
    for (const LocatedStretch& s : located_stretches(d, before->recording))
      line.marked.emplace_back(s.from_s - from_s, s.to_s - from_s);
    line.marked_label = "located";
    line.height_px = 300.0;
    report.picture(line_picture(line));
  }
}

void add_responses(HtmlReport& report, const Diagnosis& d) {
  if (d.responses.empty()) return;
  report.heading("What the mismatch depends on");
  for (std::size_t k = 0; k < std::min(d.responses.size(), kMostResponses); ++k) {
    const Response& r = d.responses[k];
    LinePicture picture;
    picture.title = "Mismatch left by calibration against " + r.variable;
    picture.x_label = r.variable;
    picture.y_label = r.channel;
    picture.bands.push_back({"95 % band", r.at, r.low, r.high, Look::estimate});
    picture.lines.push_back({"mismatch", r.at, r.value, Look::estimate});
    if (!r.after.empty()) picture.lines.push_back({"with what was found", r.at, r.after, Look::second});
    picture.height_px = 320.0;
    report.picture(line_picture(picture), r.channel == kMismatchAboutPlace
                                              ? "Noise alone is 1: where the band leaves it, something is there."
                                              : "Where the band leaves zero, the mismatch follows this variable.");
  }
}

void add_evidence(HtmlReport& report, const Diagnosis& d) {
  BarPicture picture;
  double largest = 0.0, least = 1e300;
  for (const Finding& f : d.findings) {
    if (!(f.log_likelihood_gain > 0.0)) continue;
    BarGroup group;
    group.bars.push_back({effect_text(f.effect, f.component), f.log_likelihood_gain,
                          number_text("%.1f", f.log_likelihood_gain), ink::kBlue});
    for (const Alternative& a : f.alternatives)
      group.bars.push_back({"or " + effect_text(a.effect, a.component), std::max(0.0, a.log_likelihood_gain),
                            number_text("%.1f", a.log_likelihood_gain), ink::kSky});
    for (const DrawnBar& bar : group.bars) {
      largest = std::max(largest, bar.value);
      if (bar.value > 0.0) least = std::min(least, bar.value);
    }
    picture.groups.push_back(group);
  }
  if (picture.groups.empty()) return;
  report.heading("The evidence");
  picture.logarithmic = largest > 100.0 * least;
  picture.title = "How much better each effect makes the recordings fit";
  picture.x_label =
      picture.logarithmic ? "gain in log-likelihood, each line ten times the one before" : "gain in log-likelihood";
  report.picture(bar_picture(picture),
                 "Dark: what is named. Light: what would explain the same in its stead. Where what is left is noise a "
                 "gain of 10 is decisive, and of what happens once or in one place 20; two that differ by less than "
                 "about 3 are not told apart.");
}

// Why an effect that was asked for stands in no finding.
std::string why_not_named(const AskedEffect& a, double named_gain, bool beside_unknown) {
  constexpr double kChance = 0.02, kTold = 10.0, kTrace = 0.15;
  if (a.named) return "";
  if (a.p_value > kChance) return "no more than chance";
  if (beside_unknown) return "does not suffice: what is there has no name";
  if (!a.gain_beside_findings || named_gain <= 0.0) return "";
  if (*a.gain_beside_findings < kTold) return "what was found says it, too";
  if (*a.gain_beside_findings < kTrace * named_gain)
    return "a trace beside it: " + number_text("%.2g %%", 100.0 * *a.gain_beside_findings / named_gain);
  return "not borne out";
}

void add_asked(HtmlReport& report, const Diagnosis& d) {
  if (d.asked.empty()) return;
  constexpr double kCertain = 1e-15;
  report.heading("Every effect that was asked for");
  report.paragraph(
      "Gain: in log-likelihood, beside the calibration and beside what was found. Chance: of such a gain where nothing "
      "is "
      "missing, all that was tried allowed for. Left to be seen: of what the effect does to the recordings, what "
      "calibration would not take up on these drives; most of the rest would go into the parameter named. Least size: "
      "what "
      "would have been seen nine times in ten. No form is quite that of the world: what says little beside what was "
      "found is its trace, and no name.");
  const bool any_named = std::any_of(d.asked.begin(), d.asked.end(), [](const AskedEffect& a) { return a.named; });
  std::vector<std::string> header{"effect", "gain"};
  if (any_named) header.push_back("beside what was found");
  header.insert(header.end(), {"chance", "why it is not named", "left to be seen", "would bend", "least size"});
  double named_gain = 0.0;
  for (const AskedEffect& a : d.asked)
    if (a.named) named_gain += a.log_likelihood_gain;
  std::vector<std::vector<std::string>> rows;
  for (const AskedEffect& a : d.asked) {
    std::vector<std::string> row{effect_text(a.effect, a.component), number_text("%.1f", a.log_likelihood_gain)};
    if (any_named)
      row.push_back(a.named ? "named" : a.gain_beside_findings ? number_text("%.1f", *a.gain_beside_findings) : "");
    row.push_back(a.p_value < kCertain ? "under 1e-15" : number_text("%.2g", a.p_value));
    row.push_back(why_not_named(a, named_gain, d.verdict == Verdict::unknown_effect));
    row.push_back(a.survives ? number_text(*a.survives < 0.095 ? "%.1f %%" : "%.0f %%", 100.0 * *a.survives) : "");
    row.push_back(a.bends ? parameter_words(a.bends->name) : "");
    row.push_back(a.least_seen ? size_text(a.least_seen->value, a.least_seen->unit) : a.named ? "" : "none would show");
    rows.push_back(row);
  }
  report.word_table(header, rows);
}

struct FitRow {
  const char* name;
  const std::optional<FitFigures>& figures;
  const char* colour;
};

std::vector<FitRow> rows_of(const FitTable& t) {
  return {{"as drawn", t.nominal, "#b9c4cc"},
          {"calibrated", t.calibrated, ink::kOrange},
          {"calibrated, and a flexible curve", t.spline, "#e3c9a8"},
          {"calibrated, and a meaningless term of equal freedom", t.placebo, "#e3c9a8"},
          {"calibrated, and what was found", t.with_findings, ink::kBlue}};
}

std::string heading_text(const FitFigures& figures) {
  return figures.has_heading() ? number_text("%.3f", degrees(figures.heading_rms_rad)) : "not measured";
}

void add_proof(HtmlReport& report, const Diagnosis& d) {
  std::vector<std::vector<std::string>> table;
  BarPicture bars;
  const bool any_findings = any_is_put_in(d);
  const auto add = [&](const std::string& part, const FitTable& fit) {
    BarGroup group{part, {}};
    const auto add_row = [&](const char* name, const std::optional<FitFigures>& figures, const char* colour) {
      if (!figures) return;
      const std::string chi2 =
          std::isnan(figures->normalised_chi2) ? "not measured" : number_text("%.2f", figures->normalised_chi2);
      if (!figures->gathered()) {
        table.push_back({part + ": " + name, "not measured", "not measured", chi2});
        return;
      }
      table.push_back(
          {part + ": " + name, number_text("%.2f", 1e3 * figures->position_rms_m), heading_text(*figures), chi2});
      group.bars.push_back(
          {name, 1e3 * figures->position_rms_m, number_text("%.2f mm", 1e3 * figures->position_rms_m), colour});
    };
    for (const FitRow& row : rows_of(fit))
      if (&row.figures != &fit.with_findings || any_findings) add_row(row.name, row.figures, row.colour);
    add_row("what noise alone would leave", fit.noise_floor, ink::kGreen);
    if (!group.bars.empty()) bars.groups.push_back(group);
  };
  add("Fitted on", d.train);
  add(d.left_out_in_turn ? "Each run left out in turn" : "Held out", d.held_out);
  BarGroup simulated{"Physics simulator, driven by the recordings", {}};
  const auto add_simulated = [&](const char* name, const std::optional<FitFigures>& figures, const char* colour) {
    if (!figures || !figures->gathered()) return;
    table.push_back({std::string("Simulator: ") + name, number_text("%.2f", 1e3 * figures->position_rms_m),
                     heading_text(*figures), number_text("%.2f", figures->normalised_chi2)});
    simulated.bars.push_back(
        {name, 1e3 * figures->position_rms_m, number_text("%.2f mm", 1e3 * figures->position_rms_m), colour});
  };
  add_simulated("calibrated", d.simulation.calibrated, ink::kOrange);
  if (any_findings && is_switched_on(d.simulation))
    add_simulated("with what was found switched on", d.simulation.with_findings, ink::kBlue);
  if (!simulated.bars.empty()) bars.groups.push_back(simulated);
  if (table.empty()) return;
  report.heading("The proof: before and after");
  const WindowSize over = d.train_over.value_or(WindowSize{});
  report.paragraph(
      "The error of the predicted pose, gathered " +
      (over.is_long() ? over_which_way(over) : "over one metre of travel or one turn of a radian from a true start") +
      ", root mean square. Held-out recordings gave no name and no number: they may take a name away that they "
      "contradict, or show that something is missing.");
  if (!d.fitted_on.empty())
    report.paragraph("Fitted on " + list_of(d.fitted_on, "and") +
                     (d.held_out_runs.empty() ? "" : "; held out: " + list_of(d.held_out_runs, "and")) + ".");
  if (d.unseen_gain)
    report.paragraph(number_text(
        *d.unseen_gain < 0.0
            ? "Unseen, the recordings are less likely by %.1f in log-likelihood with what was found than "
              "with the calibration alone."
            : "Unseen, the recordings are likelier by %.1f in log-likelihood with what was found than with "
              "the calibration alone. Where each sample of the truth errs by more than the way over a metre, "
              "this shows what the errors below cannot.",
        std::abs(*d.unseen_gain)));
  bars.title = "Position error " + over_which_way(over);
  bars.x_label = "position error [mm]";
  if (!bars.groups.empty()) report.picture(bar_picture(bars));
  report.table({"", "position [mm]", "heading [\xC2\xB0]", "normalised chi2"}, table);
}

void add_limits(HtmlReport& report, const Diagnosis& d) {
  if (!d.not_testable.empty()) {
    report.heading("What these recordings could not show");
    report.paragraph(
        "Each of these may be there or not: the way that was driven leaves no trace of it beside the calibration.");
    std::vector<std::vector<std::string>> rows;
    for (const NotTestable& n : d.not_testable) rows.push_back({effect_words(n.effect), n.because, n.drive_this});
    report.word_table({"effect", "because", "this drive would show it"}, rows);
  }
  if (!d.next_drive.empty()) {
    report.heading("What to drive next");
    report.sentence(d.next_drive);
  }
}

void add_calibration(HtmlReport& report, const LeastSquaresCalibration& c) {
  if (c.parameters.empty()) return;
  report.heading("Calibration");
  std::vector<std::vector<std::string>> rows;
  for (const ParameterEstimate& p : c.parameters)
    rows.push_back({parameter_words(p.name), quantity_text(p.nominal, 0.0, p.unit),
                    p.determined ? quantity_text(p.value, p.stderr_value, p.unit) : "not determined"});
  report.table({"parameter", "as drawn", "estimate and standard error"}, rows);
  for (const std::string& sentence : c.cannot_tell) report.paragraph("Cannot tell: " + sentence);
  report.paragraph(
      number_text("Noise that the fit found: each wheel %.2f mm per root metre", 1e3 * c.noise.wheel_m_per_sqrt_m) +
      (c.noise.truth_position_m > 0.0 ? number_text(", the truth %.2f mm", 1e3 * c.noise.truth_position_m)
                                      : std::string()) +
      (c.noise.truth_heading_rad > 0.0 ? number_text(" and %.3f\xC2\xB0", degrees(c.noise.truth_heading_rad))
                                       : std::string()) +
      ".");
}

}  // namespace

HtmlReport diagnosis_report(const Diagnosis& diagnosis) {
  HtmlReport report(verdict_sentence(diagnosis));
  add_findings(report, diagnosis);
  add_gathered(report, diagnosis);
  add_place_and_time(report, diagnosis);
  add_responses(report, diagnosis);
  add_evidence(report, diagnosis);
  add_asked(report, diagnosis);
  add_proof(report, diagnosis);
  add_limits(report, diagnosis);
  add_calibration(report, diagnosis.calibration);
  if (!diagnosis.warnings.empty()) {
    report.heading("To be aware of");
    for (const std::string& warning : diagnosis.warnings) report.paragraph(warning);
  }
  return report;
}

}  // namespace odolab
