// A fitted model as a TOML file: the calibrated vehicle as a table [vehicle], and each effect as in a scenario, [[effect]],
// with the standard errors of its parameters beside them.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/diagnosis/fitted_model.h"

namespace odolab {

// The clocks of single recordings are not kept: a file's name is no proof that it is the same recording.
// Errors name file and line or key. What was written reads back to the same bits.
Result<FittedModel> read_model(const std::string& path);
Result<Done> write_model(const std::string& path, const FittedModel& model);
std::string model_text(const FittedModel& model);

}  // namespace odolab
