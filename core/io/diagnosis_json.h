// A diagnosis as JSON of the schema "odolab.diagnosis/1", for scripts.
#pragma once

#include <string>

#include "core/diagnosis/diagnosis.h"
#include "core/io/summary_json.h"

namespace odolab {

// Keys that hold nothing are left out where the schema lets them: `where` has only what applies, `fit` and `simulation`
// only what was judged. A parameter that the recordings do not determine has the nominal value and a null stderr.
// No chance is less than 1e-300, which stands for all below it.
// Each entry of `fit` and `simulation` has `window_m` and `window_rad` too, the medians of the way and the turn over
// which its errors are gathered: more than a metre or a radian where the truth's poses are further apart.
Json diagnosis_json(const Diagnosis& diagnosis);

// The schema's word: "found", "nothing_missing", ...
std::string word_of(Verdict verdict);

}  // namespace odolab
