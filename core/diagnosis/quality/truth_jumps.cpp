#include "core/diagnosis/quality/truth_jumps.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/base/quantile.h"
#include "core/geometry/small_turn.h"

namespace odolab {

namespace {

constexpr double kUnlikely = 12.0;  // squared, of three numbers: seven in a thousand, and four in a row never
constexpr int kGoOn = 3;            // samples that must follow
constexpr double kAlike = 16.3;     // squared, of three numbers: one in a thousand

Eigen::Matrix3d covariance_of(const Innovation& i) {
  const double* c = i.covariance;
  Eigen::Matrix3d m;
  m << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5];
  return m;
}

// Whether a sample lies where another said, but for the noise of both and what was added on the way.
bool is_there_too(const Innovation& jump, const Innovation& later, const FittedNoise& noise) {
  const double p2 = noise.truth_position_m * noise.truth_position_m,
               h2 = noise.truth_heading_rad * noise.truth_heading_rad;
  const Eigen::Vector3d apart(later.residual[0] - jump.residual[0], later.residual[1] - jump.residual[1],
                              wrapped(later.residual[2] - jump.residual[2]));
  Eigen::Matrix3d covariance = covariance_of(later) - covariance_of(jump);
  covariance.diagonal() += 2.0 * Eigen::Vector3d(p2, p2, h2);
  return apart.dot(covariance.ldlt().solve(apart)) < kAlike;
}

// A tracker that loses itself and comes back is an outlier of several samples, and no jump.
bool comes_back(const std::vector<Innovation>& seen, std::size_t jump) {
  constexpr double kLeft = 0.3;
  std::size_t next = jump;
  while (next < seen.size() && seen[next].set_aside) ++next;
  const auto off_m = [&](std::size_t i) { return std::hypot(seen[i].residual[0], seen[i].residual[1]); };
  const bool began_anew = next - jump >= static_cast<std::size_t>(kContradiction);
  return !began_anew && next < seen.size() && off_m(next) < kLeft * off_m(jump);
}

void look_at_changes(const std::vector<Innovation>& seen, TruthJumps& out) {
  constexpr double kMiddle = 1.1774;  // of the length of what scatters by one in x and in y
  std::vector<double> sizes_m;
  for (std::size_t i = 1; i < seen.size(); ++i)
    if (seen[i].truth_index == seen[i - 1].truth_index + 1)
      sizes_m.push_back(
          std::hypot(seen[i].residual[0] - seen[i - 1].residual[0], seen[i].residual[1] - seen[i - 1].residual[1]));
  out.changes = static_cast<double>(sizes_m.size());
  out.change_m = median(std::move(sizes_m)) / kMiddle;
}

}  // namespace

TruthJumps truth_jumps(const InnovationRun& given, const InnovationModel& model) {
  TruthJumps found;
  std::vector<TruthJump>& jumps = found.jumps;
  if (!given.truth_has_heading) return found;
  InnovationRun run = given;
  if (run.cut.empty()) run.cut.assign(run.truth.size(), 0);
  const SummedRun summed = summed_up(run, model);
  constexpr int kMostPasses = 5;  // what follows a jump within its shadow shows once that is known
  bool more = true;
  for (int pass = 0; pass < kMostPasses && more; ++pass) {
    std::vector<Innovation> seen;
    std::vector<Pose> pose(run.truth.size());
    FilterOptions options;
    options.derivatives = false;
    options.gate = kUnlikely;
    options.on_innovation = [&](const Innovation& i) { seen.push_back(i); };
    options.on_step = [&](const FilterStep& s) { pose[static_cast<std::size_t>(s.truth_index)] = s.pose; };
    filtered(run, summed, model, options);
    if (pass == 0) look_at_changes(seen, found);
    more = false;
    for (std::size_t i = 1; i + kGoOn < seen.size(); ++i) {
      const Innovation& jump = seen[i];
      const auto k = static_cast<std::size_t>(jump.truth_index);
      if (!jump.set_aside || seen[i - 1].set_aside || seen[i - 1].truth_index + 1 != jump.truth_index || jump.size != 3)
        continue;
      bool goes_on = true;
      for (std::size_t j = 1; j <= kGoOn; ++j)
        goes_on = goes_on && seen[i + j].set_aside &&
                  seen[i + j].truth_index == jump.truth_index + static_cast<int>(j) &&
                  is_there_too(jump, seen[i + j], model.noise);
      if (!goes_on || comes_back(seen, i)) continue;
      run.cut[k] = 1;
      more = true;
      const Turn facing = turn_of(pose[k].heading_rad);
      const Pose& m = model.truth.axle_T_tracked;
      const Vec2 arm{facing.c * m.x_m - facing.s * m.y_m, facing.s * m.x_m + facing.c * m.y_m};
      const double turn = jump.residual[2];
      TruthJump out;
      out.time_s = {run.truth[k - 1].time_s, run.truth[k].time_s};
      out.at = pose[k].position();
      out.by = {jump.residual[0] + turn * arm.y_m, jump.residual[1] - turn * arm.x_m};
      out.of_axle = {facing.c * out.by.x_m + facing.s * out.by.y_m, facing.c * out.by.y_m - facing.s * out.by.x_m,
                     turn};
      const Eigen::Matrix3d covariance = covariance_of(jump);
      out.by_chance_m = std::sqrt(0.5 * (covariance(0, 0) + covariance(1, 1)));
      jumps.push_back(out);
    }
  }
  return found;
}

bool stand_out(const std::vector<TruthJumps>& recordings) {
  constexpr double kBeyondChance = 4.0;
  std::vector<double> sizes_m;
  for (const TruthJumps& r : recordings)
    for (const TruthJump& jump : r.jumps) sizes_m.push_back(length(jump.by));
  const double middle_m = median(sizes_m);
  double as_large_by_chance = 0.0;
  for (const TruthJumps& r : recordings)
    if (r.change_m > 0.0) as_large_by_chance += r.changes * std::exp(-0.5 * std::pow(middle_m / r.change_m, 2));
  return 0.5 * static_cast<double>(sizes_m.size()) > kBeyondChance * as_large_by_chance;
}

bool are_of_the_truth(const std::vector<TruthJump>& jumps) {
  constexpr std::size_t kFewest = 6;
  if (jumps.size() < kFewest) return false;
  std::vector<double> ahead, aside, by_chance;
  for (const TruthJump& j : jumps) {
    ahead.push_back(std::abs(j.of_axle.forward_m));
    aside.push_back(std::abs(j.of_axle.sideways_m));
    by_chance.push_back(j.by_chance_m);
  }
  constexpr double kAsMuch = 0.5, kBeyondChance = 1.5;
  if (median(aside) < kAsMuch * median(ahead) || median(aside) < kBeyondChance * median(by_chance)) return false;
  // A truth knows nothing of where the vehicle faces.
  constexpr double kOneWay = 4.6;  // Rayleigh's test of directions: one in a hundred of those that go any way
  Vec2 either_way;
  for (const TruthJump& j : jumps) {
    const double doubled = 2.0 * std::atan2(j.of_axle.sideways_m, j.of_axle.forward_m);
    either_way = either_way + Vec2{std::cos(doubled), std::sin(doubled)};
  }
  if (dot(either_way, either_way) > kOneWay * static_cast<double>(jumps.size())) return false;
  constexpr double kNear_m = 0.5, kAlong = 0.95, kOfOneSize = 0.3;
  const auto is_of_its_place = [&](const TruthJump& a) {
    return std::any_of(jumps.begin(), jumps.end(), [&](const TruthJump& b) {
      const double of_a = length(a.by), of_b = length(b.by);
      return &a != &b && length(a.at - b.at) < kNear_m && std::abs(dot(a.by, b.by)) > kAlong * of_a * of_b &&
             std::abs(of_a - of_b) < kOfOneSize * std::max(of_a, of_b);
    });
  };
  return 2 * static_cast<std::size_t>(std::count_if(jumps.begin(), jumps.end(), is_of_its_place)) < jumps.size();
}

}  // namespace odolab
