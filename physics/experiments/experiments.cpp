#include <algorithm>

#include "physics/experiments/experiment.h"

namespace odolab {

Experiment umbmark_one_direction();
Experiment umbmark_table3();
Experiment umbmark_systematic();
Experiment umbmark_extended();
Experiment k2a_calibration();
Experiment hundred_metres();
Experiment self_calibration();
Experiment clapper_straight();
Experiment clapper_rectangle();
Experiment clapper_link_bias();
Experiment clapper_bump();
Experiment castor_calibration();
Experiment castor_umbmark();
Experiment castor_umbmark_planar();
Experiment castor_rejection();
Experiment ipec_unconnected();
Experiment concealed_physics();
Experiment real_recordings();

const std::vector<Experiment>& experiments() {
  // clang-format off
  static const std::vector<Experiment> list = {
      umbmark_one_direction(),
      umbmark_table3(),
      umbmark_systematic(),
      umbmark_extended(),
      k2a_calibration(),
      hundred_metres(),
      self_calibration(),
      clapper_straight(),
      clapper_rectangle(),
      clapper_link_bias(),
      clapper_bump(),
      castor_calibration(),
      castor_umbmark(),
      castor_umbmark_planar(),
      castor_rejection(),
      ipec_unconnected(),
      concealed_physics(),
      real_recordings(),
  };
  // clang-format on
  return list;
}

bool succeeded(const ExperimentReport& report) {
  return std::all_of(report.claims.begin(), report.claims.end(),
                     [](const Claim& claim) { return claim.holds || claim.explained; });
}

}  // namespace odolab
