#include "core/io/verdict_sentence.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/calibration/miscounted_wheel.h"
#include "core/diagnosis/effects/effect.h"
#include "core/diagnosis/refuted.h"
#include "core/io/diagnosis_text.h"

namespace odolab {

namespace {

// What all names together do to a stretch, where that is little: after ten metres a thousandth of the way. Else empty.
std::string little_sentence(const Diagnosis& d) {
  constexpr double kLittle_m = 1e-4, kLittle_rad = 2e-4;
  double moved_m2 = 0.0, moved_rad2 = 0.0;
  for (const Finding& f : d.findings) {
    if (is_fault(f) || is_of_the_measurement(f)) continue;
    if (!f.moves) return "";
    moved_m2 += f.moves->position_rms_m * f.moves->position_rms_m;
    moved_rad2 += f.moves->heading_rms_rad * f.moves->heading_rms_rad;
  }
  const MovedTrack all{std::sqrt(moved_m2), std::sqrt(moved_rad2)};
  if (all.position_rms_m > kLittle_m || all.heading_rms_rad > kLittle_rad) return "";
  const bool is_of_a_metre = !d.train_over.value_or(WindowSize{}).is_long();
  return " It matters little: where it acts it moves each metre or radian by " + moved_text(all) +
         (is_of_a_metre && d.train.noise_floor ? ", in noise of " + figures_text(*d.train.noise_floor) : "") + ".";
}

// Whether all that has no name is where the truth and the wheels part, in one stretch.
bool is_one_incident(const Diagnosis& d) {
  std::size_t stretches = 0;
  for (const Finding& f : d.findings) {
    if (f.effect == "unknown" && !f.is_parted) return false;
    if (f.is_parted) stretches += f.where.time_s.size();
  }
  return stretches == 1;
}

// Names between which nothing is decided, each a choice of its own.
std::string listed(const std::vector<std::string>& choices) {
  if (choices.size() == 1) return choices.front();
  std::string text;
  for (std::size_t i = 0; i < choices.size(); ++i)
    text += std::string(i == 0 ? "" : i + 1 == choices.size() ? "; and " : "; ") + "either " + choices[i];
  return text;
}

}  // namespace

std::string verdict_sentence(const Diagnosis& diagnosis) {
  std::vector<std::string> physics, measured, open, faults;  // `open`: names that these recordings do not tell apart
  for (const Finding& f : diagnosis.findings) {
    if (f.effect == "unknown") continue;
    std::vector<std::string> either{effect_text(f.effect, f.component)};
    if (diagnosis.verdict == Verdict::ambiguous)
      for (const Alternative& a : f.alternatives) either.push_back(effect_text(a.effect, a.component));
    if (either.size() > 3) {
      either.resize(3);
      either.push_back("others");
    }
    std::vector<std::string>& list = is_fault(f)                ? faults
                                     : either.size() > 1        ? open
                                     : is_of_the_measurement(f) ? measured
                                                                : physics;
    const std::string name = list_of(either, "or");
    if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
  }
  std::string sentence;
  switch (diagnosis.verdict) {
    case Verdict::found:
    case Verdict::ambiguous: {
      const bool any = !physics.empty() || !measured.empty();
      if (!any && open.empty()) return "The data are at fault: " + list_of(faults, "and") + ".";
      if (!physics.empty())
        sentence = "What the model lacks: " + list_of(physics, "and") + "." + little_sentence(diagnosis);
      else if (any)
        sentence =
            !open.empty() ? ""
            : diagnosis.calibration_alone.innovations_are_correlated
                ? "No physics is found missing, but what is left is no mere noise: it goes on from one sample of "
                  "the truth to the next."
            : diagnosis.cannot_judge ? "These recordings cannot say whether physics is missing."
                                     : "No physics is missing.";
      if (!measured.empty())
        sentence += (sentence.empty() ? "" : " ") +
                    ("It was measured otherwise than the vehicle's file says: " + list_of(measured, "and") + ".");
      if (!open.empty())
        sentence += (any ? " Not told apart by these recordings: "
                         : "Something is missing, and these recordings cannot tell what: ") +
                    listed(open) + ".";
      break;
    }
    case Verdict::nothing_missing:
      sentence = diagnosis.calibration_alone.innovations_are_correlated
                     ? "Nothing is found missing, but what calibration leaves is no mere noise: it goes on from one "
                       "sample of the truth to the next."
                 : diagnosis.not_testable.empty()
                     ? "Nothing is missing: calibration explains these recordings down to their noise."
                     : "Nothing is missing that these drives could show: calibration explains these recordings down "
                       "to their noise.";
      break;
    case Verdict::unknown_effect:
      sentence = is_one_incident(diagnosis)
                     ? "Once, something happened that no known effect describes; all else is judged without it."
                     : "Something is missing that no known effect describes.";
      for (const auto* also : {&physics, &measured}) open.insert(open.begin(), also->begin(), also->end());
      if (!open.empty()) sentence += " Beside it: " + list_of(open, "and") + ".";
      break;
    case Verdict::cannot_say:
      sentence = "These recordings cannot say whether anything is missing.";
      break;
  }
  for (const MiscountedWheel& w : miscounted_wheels(diagnosis.calibration)) sentence += " " + in_words(w) + ".";
  if (!faults.empty()) sentence += " The data are at fault too: " + list_of(faults, "and") + ".";
  const bool by_unseen = is_refuted_by_unseen(diagnosis), by_simulator = is_refuted_by_simulator(diagnosis);
  const std::string unseen = diagnosis.left_out_in_turn ? "what was left out in turn" : "what was held out";
  if (by_unseen || by_simulator)
    sentence += " But " +
                (by_unseen && by_simulator ? unseen + " and the simulator do"
                 : by_unseen               ? unseen + " does"
                                           : "the simulator does") +
                " not bear it out.";
  return sentence;
}

}  // namespace odolab
