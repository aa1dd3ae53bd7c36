// What recordings that were held out make of names.
#pragma once

#include <cstddef>
#include <optional>

#include "core/base/progress.h"
#include "core/diagnosis/naming/select.h"
#include "core/diagnosis/proof.h"

namespace odolab {

// Of the accepted effects the one that is no more than chance in all recordings together, nor is what it may be
// instead. `of_all`: fitted to those held out as well (Predictor::fitted_to_all).
std::optional<std::size_t> not_borne_out(const JointModel& of_all, const Selected& selected, double family_wise_error);

// Where nothing stands: names that are hinted at and borne out are let in, or nothing is changed.
bool name_what_is_hinted_at(JointModel& joint, Selected& selected, const Predictor& predictor, double family_wise_error,
                            const Progress& go_on);

}  // namespace odolab
