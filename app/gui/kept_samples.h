// All that a long run sampled, whole and outside of memory, for when a person saves its recording.
#pragma once

#include "core/base/result.h"
#include "core/io/temporary_numbers.h"
#include "physics/simulation.h"

namespace odolab {

class KeptSamples {
 public:
  // Now and then: takes from the simulation what it has sampled, once that is worth a write.
  void take_from(Simulation& simulation);
  // Everything so far, to the bit what the simulation alone would have recorded.
  Result<Recording> recording(const Simulation& simulation) const;

 private:
  std::size_t seen_ = 0;  // samples
  TemporaryNumbers time_s_, readings_, commands_, truth_;
};

}  // namespace odolab
