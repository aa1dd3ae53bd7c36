#include "core/diagnosis/units/together/joined_moments.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"

namespace odolab {

namespace {

constexpr double kMomentsApart_s = 0.5;  // of the strongest
constexpr double kNearTheEnd_s = 0.3;

// When a drive has left its first centimetres behind, which take up whatever play there is.
double set_off_s(const DriveView& view) {
  constexpr double kFirst_m = 0.05;
  double rolled_m = 0.0;
  for (const EffectStep& s : view.steps) {
    rolled_m += s.rolled_m();
    if (rolled_m > kFirst_m) return s.time_s;
  }
  return 1e300;
}

// Of a motion of its units at that moment.
double statistic_of(const JoinedFilter::Impact& at, const JoinedMoments& kind, const DifferentialDrive& drive) {
  if (kind.wheel != Wheel::both) {
    const auto row = 3 * static_cast<Eigen::Index>(kind.units.front());
    const double heading_rad = at.units[kind.units.front()].heading_rad, side = kind.wheel == Wheel::right ? 1.0 : -1.0;
    const Eigen::Vector3d by(0.5 * std::cos(heading_rad), 0.5 * std::sin(heading_rad), side / drive.wheelbase_m);
    const double score = by.dot(at.score.segment<3>(row));
    const double information = by.dot(at.information.block<3, 3>(row, row) * by);
    return information > 0.0 ? score * score / information : 0.0;
  }
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d score = Eigen::Vector3d::Zero();
  const auto swung = [&](std::size_t u) {
    const Vec2 arm = at.units[u].position() - at.units[kind.units.front()].position();
    Eigen::Matrix3d by = Eigen::Matrix3d::Identity();
    by(0, 2) = -arm.y_m, by(1, 2) = arm.x_m;
    return by;
  };
  for (std::size_t u : kind.units) {
    const Eigen::Matrix3d by = swung(u);
    score += by.transpose() * at.score.segment<3>(3 * static_cast<Eigen::Index>(u));
    for (std::size_t v : kind.units)
      information += by.transpose() *
                     at.information.block<3, 3>(3 * static_cast<Eigen::Index>(u), 3 * static_cast<Eigen::Index>(v)) *
                     swung(v);
  }
  const Eigen::LDLT<Eigen::Matrix3d> solved(information);
  return solved.info() == Eigen::Success && solved.vectorD().minCoeff() > 0.0 ? score.dot(solved.solve(score)) : 0.0;
}

}  // namespace

double inflation_of(const std::vector<double>& statistics, int freedom) {
  constexpr std::size_t kFewestToScatter = 20;
  return statistics.size() < kFewestToScatter ? 1.0 : std::max(1.0, scatter_of_statistics(statistics, freedom));
}

std::vector<JoinedMoments> joined_moments(const JoinedModel& model, std::size_t most) {
  std::vector<JoinedMoments> kinds;
  std::vector<std::size_t> all;
  for (std::size_t u = 0; u < model.units(); ++u) all.push_back(u);
  for (std::size_t u : all)
    for (Wheel wheel : {Wheel::left, Wheel::right, Wheel::both}) kinds.push_back({{u}, wheel, {}, 0.0, 1.0});
  if (model.follows_truth() && all.size() > 1) kinds.push_back({all, Wheel::both, {}, 0.0, 1.0});

  std::vector<std::vector<std::vector<JoinedMoment>>> of_run(model.runs().size());
  parallel_for(static_cast<int>(of_run.size()), [&](int run) {
    const auto r = static_cast<std::size_t>(run);
    of_run[r].resize(kinds.size());
    const double from_s = set_off_s(model.views(0)[r]), to_s = model.views(0)[r].steps.back().time_s - kNearTheEnd_s;
    for (const JoinedFilter::Impact& at : model.impacts(r))
      for (std::size_t k = 0; k < kinds.size() && at.time_s > from_s && at.time_s < to_s; ++k)
        of_run[r][k].push_back({run, at.time_s, statistic_of(at, kinds[k], model.views(kinds[k].units[0])[r].drive)});
  });
  std::vector<std::vector<JoinedMoment>> found(kinds.size());
  for (const auto& of_kinds : of_run)
    for (std::size_t k = 0; k < kinds.size(); ++k)
      found[k].insert(found[k].end(), of_kinds[k].begin(), of_kinds[k].end());
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    std::sort(found[k].begin(), found[k].end(),
              [](const JoinedMoment& a, const JoinedMoment& b) { return a.statistic > b.statistic; });
    // What happened once makes every moment of its run likelier: by the other runs, where there are any.
    std::vector<double> statistics;
    for (const JoinedMoment& m : found[k])
      if (model.runs().size() < 2 || m.run != found[k].front().run) statistics.push_back(m.statistic);
    kinds[k].count = static_cast<double>(found[k].size());
    kinds[k].inflation = inflation_of(statistics, kinds[k].wheel == Wheel::both ? 3 : 1);
    for (const JoinedMoment& m : found[k]) {
      if (kinds[k].strongest.size() == most) break;
      if (std::none_of(kinds[k].strongest.begin(), kinds[k].strongest.end(), [&](const JoinedMoment& s) {
            return s.run == m.run && std::abs(s.time_s - m.time_s) < kMomentsApart_s;
          }))
        kinds[k].strongest.push_back(m);
    }
  }
  return kinds;
}

}  // namespace odolab
