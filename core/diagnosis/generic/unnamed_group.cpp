#include "core/diagnosis/generic/unnamed_group.h"

#include <Eigen/Dense>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "core/base/formatted.h"
#include "core/diagnosis/gathered_evidence.h"
#include "core/diagnosis/generic/once_a_turn.h"
#include "core/diagnosis/generic/unlike_recordings.h"
#include "core/diagnosis/moved_track.h"
#include "core/geometry/angles.h"

namespace odolab {

namespace {

// Which recordings, and by how much; empty where the group is no number for each.
std::string of_which_recordings(const GenericTest& group, const JointModel& with) {
  const std::vector<double>& of_each = with.accepted.back().value;
  if (group.variable != "recording" || of_each.size() != with.runs().size()) return "";
  std::vector<std::string> names;
  for (const InnovationRun& run : with.runs()) names.push_back(run.name);
  const std::optional<UnlikeRecordings> unlike = unlike_recordings(of_each);
  const bool per_metre = group.channel.find("[rad/m]") != std::string::npos;
  return unlike ? " (" + in_words(*unlike, names, per_metre) + ")" : "";
}

// What comes once a turn over a small part of it seems to waves to come twice.
std::string variable_in_words(const GenericTest& group, const JointModel& without) {
  if (const std::optional<WheelAngle> angle = angle_of(group))
    if (const std::optional<double> part_rad = part_of_a_turn(without, angle->wheel, angle->turns))
      return formatted("its angle, once a turn, over about %.0f degrees: a lump or a dent, or a slot of its encoder",
                       degrees(*part_rad));
  return group.variable;
}

}  // namespace

std::vector<Response> shape_of(const GenericTest& group, const JointModel& with) {
  std::vector<Response> shape;
  if (group.curves.empty()) return shape;
  const std::vector<double>& fitted = with.accepted.back().value;
  const auto n = static_cast<Eigen::Index>(fitted.size());
  const Eigen::Index first = with.first_column(static_cast<int>(with.accepted.size()) - 1);
  const Eigen::MatrixXd covariance = group.test.inflation * with.covariance().block(first, first, n, n);
  const Eigen::VectorXd value = Eigen::Map<const Eigen::VectorXd>(fitted.data(), n);
  for (const GenericCurve& curve : group.curves) {
    Response r;
    r.variable = curve.variable;
    r.channel = curve.channel;
    r.at = curve.at;
    for (const std::vector<double>& of_point : curve.basis) {
      const Eigen::VectorXd basis = Eigen::Map<const Eigen::VectorXd>(of_point.data(), n);
      const double at = basis.dot(value), band = 2.0 * std::sqrt(basis.dot(covariance * basis));
      r.value.push_back(at);
      r.low.push_back(at - band);
      r.high.push_back(at + band);
    }
    shape.push_back(std::move(r));
  }
  return shape;
}

Unnamed unnamed_by(const GenericTest& group, const JointModel& with, const JointModel& without,
                   std::vector<Response> shape, double gain) {
  Unnamed u;
  u.gathered = gathered_evidence(with, with.accepted.size() - 1, 0.5 * gain);
  if (with.accepted.back().acts_on_motion()) u.moves = moved_between(without, with);
  u.component = group.component;
  u.is_of_the_clock = group.is_of_the_clock;
  u.where.regime =
      group.channel + " that depends on " + variable_in_words(group, without) + of_which_recordings(group, with);
  u.where.zone = group.zone;
  u.gain = gain;
  u.p_value = group.p_value;
  u.shape = std::move(shape);
  return u;
}

}  // namespace odolab
