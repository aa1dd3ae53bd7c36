#include "app/gui/run_estimates.h"

#include <cassert>

namespace odolab {

RunEstimates::RunEstimates(const Scenario& scenario, const Simulation& simulation)
    : steering_(steering_estimator(scenario.vehicle.kind, scenario.driving.internal_correction)) {
  assert(simulation.channels() == encoder_channels(scenario.vehicle.kind));
  for (const Estimator& estimator : estimators_for(scenario.vehicle.kind)) {
    running_.push_back(estimator.begin(simulation.state().true_pose));
    estimates_.push_back({estimator.name, estimator.about, {}, {}, {}, {}});
  }
  take(simulation);
}

void RunEstimates::take(const Simulation& simulation) {
  const SimulationState& state = simulation.state();
  for (std::size_t i = 0; i < running_.size(); ++i) {
    running_[i]->take(state.time_s, simulation.readings());
    estimates_[i].track.push_back({state.time_s, running_[i]->pose()});
    estimates_[i].gap = between(state.true_pose, running_[i]->pose());
  }
  truth_.push_back({state.time_s, state.true_pose});
  kept_.add();
  const std::vector<bool> stays = kept_.thin();
  if (stays.empty()) return;
  keep_only(stays, truth_);
  for (RunEstimate& estimate : estimates_) keep_only(stays, estimate.track);
}

void RunEstimates::remember() {
  for (RunEstimate& estimate : estimates_) {
    estimate.gap_m.push_back(length(estimate.gap.position()));
    estimate.heading_rad.push_back(wrapped(estimate.gap.heading_rad));
  }
}

void RunEstimates::keep_pictures(const std::vector<bool>& stays) {
  for (RunEstimate& estimate : estimates_) {
    keep_only(stays, estimate.gap_m);
    keep_only(stays, estimate.heading_rad);
  }
}

}  // namespace odolab
