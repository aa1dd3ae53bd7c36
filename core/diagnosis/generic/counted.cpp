#include "core/diagnosis/generic/counted.h"

#include <algorithm>

namespace odolab {

namespace {

constexpr double kHidden = 0.5;  // counts

// From the lowest to the highest of some numbers, zero among them.
struct Extent {
  double low = 0.0, high = 0.0;
  void take(double v) { low = std::min(low, v), high = std::max(high, v); }
  double half() const { return 0.5 * (high - low); }
};

bool is_hidden(const JointModel& joint, const Effect& term, const std::vector<double>& value) {
  const DifferentialDrive& drive = joint.model.drive;
  for (std::size_t r = 0; r < joint.runs().size(); ++r) {
    const DriveView& view = joint.views()[r];
    const std::vector<Motions> columns = term.motions(view, {});
    Motions motion(view.steps.size());
    for (std::size_t k = 0; k < columns.size(); ++k) columns[k].add_to(motion, value[k]);
    Extent left_m, right_m;
    double forward_m = 0.0, turn_rad = 0.0;
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      if (motion[i].sideways_m != 0.0) return false;  // nothing that is counted goes sideways
      forward_m += motion[i].forward_m, turn_rad += motion[i].turn_rad;
      left_m.take(forward_m - 0.5 * drive.wheelbase_m * turn_rad);
      right_m.take(forward_m + 0.5 * drive.wheelbase_m * turn_rad);
    }
    const double hidden_rad = kHidden * count_rad(joint.runs()[r], drive);
    if (left_m.half() > hidden_rad * drive.wheel_radius_left_m ||
        right_m.half() > hidden_rad * drive.wheel_radius_right_m)
      return false;
  }
  return true;
}

}  // namespace

void leave_to_counting(GenericTest& t, const JointModel& joint) {
  for (CandidateTest* of : {&t.test, &t.instead})
    if (!of->value.empty() && t.p_value_of(*of) < 1.0 && is_hidden(joint, *t.as_effect, of->value)) of->statistic = 0.0;
  t.p_value = t.p_value_of(t.test);
}

}  // namespace odolab
