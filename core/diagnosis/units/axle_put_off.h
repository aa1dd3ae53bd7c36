// What the axle of a unit whose truth the joints tell is put off by, where a joint or a length is otherwise.
#pragma once

#include <functional>
#include <vector>

#include "core/calibration/innovations.h"
#include "core/diagnosis/units/vehicle_units.h"

namespace odolab {

// Of one run: at each reading, in the frame of the axle, for each one of what is otherwise.
struct AxlePutOff {
  std::vector<double> time_s;
  std::vector<Pose> by;

  Pose at(double time_s) const;  // between two readings in proportion; at least two are needed

  // During a step of the wheels: what stands after it, seen from what stood before.
  BodyMotion moved(double middle_s, double duration_s, double forward_m, double turn_rad) const;
};

// `changed` puts one thing, a length of the vehicle or what a joint reads, on by a small amount.
AxlePutOff axle_put_off(const std::vector<UnitSample>& samples, const Vehicle& vehicle, std::size_t unit,
                        const std::function<void(Vehicle& vehicle, std::vector<double>& joints, double by)>& changed);

}  // namespace odolab
