#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/diagnosis.h"

namespace odolab {

// The verdict, its findings and the next drive in plain words.
std::vector<std::string> sentences_of(const Diagnosis& d);

}  // namespace odolab
