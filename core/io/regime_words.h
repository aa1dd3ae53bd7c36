// What an effect without a name depends on, as people say it.
#pragma once

#include <string>

namespace odolab {

// "turn per metre [rad/m] that depends on turn before, forgotten over metres" as "how far it turns for each metre,
// depending on how it turned over the last metres". Without units; what is not known stays as it is.
std::string regime_in_words(std::string regime);

}  // namespace odolab
