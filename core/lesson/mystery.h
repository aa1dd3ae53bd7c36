// How the diagnosis of a mystery compares with what was concealed.
#pragma once

#include <string>

#include "core/diagnosis/diagnosis.h"
#include "core/lesson/lesson.h"

namespace odolab {

struct MysteryOutcome {
  bool named = false;        // the concealed effect is among the findings, at its place
  bool named_first = false;  // and is the strongest
  int findings = 0;
};

MysteryOutcome judged(const Mystery& mystery, const Diagnosis& diagnosis);

}  // namespace odolab
