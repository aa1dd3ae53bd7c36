#include "core/diagnosis/sentences.h"

#include <algorithm>

#include "core/base/formatted.h"

namespace odolab {

namespace {

std::string finding_in_words(const Finding& f) {
  std::string s = f.sentence;
  for (std::size_t k = 0; k < std::min<std::size_t>(f.parameters.size(), 3); ++k) {
    const FoundParameter& p = f.parameters[k];
    s += (k == 0 ? " (" : ", ") + p.name + formatted(" %.4g +- %.2g", p.value, p.stderr_value) +
         (p.unit == "1" ? "" : " " + p.unit);
  }
  if (!f.parameters.empty()) s += ")";
  return s;
}

const char* headline(Verdict verdict) {
  switch (verdict) {
    case Verdict::found:
      return "Something is missing from the model, and it has a name:";
    case Verdict::nothing_missing:
      return "Nothing is missing: calibration leaves nothing but noise.";
    case Verdict::unknown_effect:
      return "Something is missing that no entry of the catalogue describes.";
    case Verdict::ambiguous:
      return "Something is missing; these recordings do not decide between the names given.";
    case Verdict::cannot_say:
      break;
  }
  return "These recordings are too poor to judge whether anything is missing.";
}

}  // namespace

std::vector<std::string> sentences_of(const Diagnosis& d) {
  std::vector<std::string> sentences = {headline(d.verdict)};
  for (const Finding& f : d.findings) {
    sentences.push_back(finding_in_words(f));
    for (const Alternative& a : f.alternatives)
      sentences.push_back("  or " + a.effect + " (" + a.component + "); told apart by " + a.told_apart_by);
  }
  if (!d.next_drive.empty()) sentences.push_back("Drive next: " + d.next_drive + ".");
  return sentences;
}

}  // namespace odolab
