// All effects of a run, switched on from its scenario.
#pragma once

#include <memory>
#include <vector>

#include "physics/effects/effect.h"

namespace odolab::planar {

// Effects that share a hook act one after the other in the scenario's order.
class Effects {
 public:
  // The effects have no problems (problems_in). `own` are others that no list names; they act last.
  Effects(const std::vector<ActiveEffect>& active, const Machine& machine,
          const std::vector<std::shared_ptr<Effect>>& own = {});

  bool empty() const { return effects_.empty(); }
  auto begin() const { return effects_.begin(); }
  auto end() const { return effects_.end(); }

  Floor laid_on(Floor floor) const;
  ActualDrive built_into(ActualDrive actual) const;
  ActualMachine built_into(ActualMachine machine, const VehicleKind& nominal) const;
  TruthMounting mounted(TruthMounting truth) const;
  // The stamp that the robot's clock gives, and the time since the start at which it gives one.
  double robot_stamp_s(double begin_s, double since_start_s) const;
  double since_start_of_stamp_s(double begin_s, double stamp_s) const;

 private:
  std::vector<std::shared_ptr<Effect>> effects_;
};

// True where the planar world has an effect of this name.
bool has_effect(const std::string& name);

}  // namespace odolab::planar
