// What else a truth may err by, where it is made up of several instruments: of a trailer the outside truth and what its
// hitch reads, of a castor what its pivot reads.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/diagnosis/generic/generic_tests.h"

namespace odolab {

struct TruthError {
  std::string component;          // of the instrument: "truck_b"
  bool is_of_a_length = false;    // else of an angle
  std::string channel, variable;  // "error of the hitch's encoder", "what it reads"
  // Of each amplitude what the truth moves by from step to step.
  std::shared_ptr<const Effect> term;
  // Whether amplitudes are more than the instrument's rounding makes.
  std::function<bool(const std::vector<double>& value)> is_more_than_rounding;
  std::vector<GenericCurve> curves;
};

// Twice what the likelihood gains, at least, and two more for each number: bodies that are joined give way a little,
// and that looks like an instrument's error.
constexpr double kLeastOfJoinedBodies = 50.0;

// Each as a group without a name. p values are over `looked_at` tests.
std::vector<GenericTest> truth_error_tests(const AskedModel& asked, double looked_at);

}  // namespace odolab
