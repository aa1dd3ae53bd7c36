#include "core/diagnosis/units/together/scored_moments.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/diagnosis/units/component_names.h"
#include "core/diagnosis/units/together/beyond_rounding.h"
#include "core/diagnosis/units/together/joined_moments.h"

namespace odolab {

namespace {

constexpr double kNearlyLeast = 20.0;  // of a moment, before its form and time are sought

std::vector<double> shape_at(const Effect& e, const JoinedMoment& moment, const JoinedMoments& kind,
                             const JoinedModel& model) {
  if (e.of_one_recording) return {static_cast<double>(moment.run), moment.time_s};
  const DriveView& view = model.views(kind.units.front())[static_cast<std::size_t>(moment.run)];
  const EffectStep& s = view.steps[std::min(view.step_at(moment.time_s), view.steps.size() - 1)];
  const double side = kind.wheel == Wheel::left ? 0.5 : -0.5;
  const Vec2 place = s.position + rotated({0.0, side * view.drive.wheelbase_m}, s.heading_rad);
  return {place.x_m, place.y_m};
}

void try_moment(const JoinedModel& with, const std::vector<double>& shape, ScoredTogether& best) {
  JoinedColumns columns = columns_at(with, best.candidate, shape);
  JoinedTest test = with.test(columns, -1.0);
  test.inflation = best.of_moments;
  best.take_if_better(test, shape, std::move(columns));
}

ScoredTogether scored_moment(const JoinedModel& with, const Effect& e, const JoinedMoments& kind,
                             const JoinedMoment& moment, std::size_t looked_at) {
  ScoredTogether best;
  best.candidate = {&e, kind.units,
                    kind.units.size() > 1
                        ? "vehicle"
                        : component_of_unit(units_of(with.vehicle())[kind.units.front()].name, e.component)};
  best.of_moments = kind.inflation;
  best.log_tests = std::log(std::max(1.0, kind.count));
  const std::vector<double> first = shape_at(e, moment, kind, with);
  for (std::size_t form = 0; form < std::max<std::size_t>(1, e.forms.size()); ++form) {
    std::vector<double> shape = first;
    if (e.forms.size() > 1) shape.push_back(static_cast<double>(form));
    try_moment(with, shape, best);
  }
  for (double step : {0.1, 0.05, 0.025})
    for (std::size_t i = 0; i < e.shapes.size(); ++i)
      for (double side : {-step, step}) {
        if (!is_estimated(e.shapes[i])) continue;
        std::vector<double> shape = best.shape;
        shape[i] += side;
        try_moment(with, shape, best);
      }
  best.judge_among(looked_at);
  return best;
}

}  // namespace

std::vector<ScoredTogether> scored_moments(const JoinedModel& with, std::size_t looked_at) {
  struct Asked {
    const Effect* effect;
    const JoinedMoments* kind;
    const JoinedMoment* moment;
  };
  std::vector<Asked> asked;
  const std::vector<JoinedMoments> kinds = joined_moments(with);
  for (const JoinedMoments& kind : kinds)
    for (const Effect& e : catalogue()) {
      const bool is_push = kind.wheel == Wheel::both;
      if (e.name != (is_push ? "collision" : "bump") || (!is_push && e.component != component_of(kind.wheel))) continue;
      if (lies_across(e)) continue;  // no moment
      for (const JoinedMoment& moment : kind.strongest)
        if (moment.statistic / kind.inflation > kNearlyLeast) asked.push_back({&e, &kind, &moment});
    }
  std::vector<ScoredTogether> all(asked.size());
  parallel_for(static_cast<int>(asked.size()), [&](int k) {
    const Asked& one = asked[static_cast<std::size_t>(k)];
    all[static_cast<std::size_t>(k)] = scored_moment(with, *one.effect, *one.kind, *one.moment, looked_at);
  });
  std::erase_if(all, [&](const ScoredTogether& s) { return !happens_beyond_rounding(s, with.vehicle()); });
  return all;
}

}  // namespace odolab
