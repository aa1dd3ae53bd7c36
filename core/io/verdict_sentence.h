// What a diagnosis comes to, in one sentence.
#pragma once

#include <string>

#include "core/diagnosis/diagnosis.h"

namespace odolab {

std::string verdict_sentence(const Diagnosis& diagnosis);

}  // namespace odolab
