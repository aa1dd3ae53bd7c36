#include "core/diagnosis/units/together/joined_candidates.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/chi_square.h"
#include "core/diagnosis/naming/intervals.h"
#include "core/diagnosis/units/component_names.h"
#include "core/diagnosis/units/together/joined_moments.h"

namespace odolab {

namespace {

constexpr std::size_t kFewShapes = 40;

// What acts on a vehicle as a whole, through its speed, its load, its tyres or the floor.
bool is_of_all(const Effect& e) {
  static const std::set<std::string> names = {
      "floor_slope_creep", "slip_zone",     "lateral_slip", "turn_speed_loss",       "speed_dependent_radius",
      "tyre_compression",  "traction_slip", "turn_scrub",   "payload_radius_change", "radius_drift"};
  return names.count(e.name) > 0 &&
         (e.component == "both_wheels" || e.component == "vehicle" || e.component == "floor");
}

// A push turns all units about the first one.
std::vector<Motions> swung(std::vector<Motions> push, const DriveView& view, const DriveView& of_first) {
  for (const Motions::Stretch& stretch : push[2].stretches())
    for (std::size_t i = stretch.first; i < stretch.end; ++i) {
      const Vec2 arm = view.steps[i].position - of_first.steps[i].position;
      const Vec2 by = rotated({-arm.y_m, arm.x_m}, -view.steps[i].heading_rad);
      push[2][i].forward_m = push[2][i].turn_rad * by.x_m;
      push[2][i].sideways_m = push[2][i].turn_rad * by.y_m;
    }
  return push;
}

// To where between the shapes that were tried it says most: one number after the other, and once more where others
// have moved meanwhile.
void climb(const JoinedModel& model, const JoinedCandidate& c, double believed_white,
           const std::vector<std::vector<double>>& tried, ScoredTogether& best) {
  const std::vector<int> free = free_shapes(*c.effect);
  const int most_rounds = free.size() > 1 ? 4 : 1;
  const std::vector<double> begun = best.shape;
  bool moved = true;
  for (int round = 0; round < most_rounds && moved; ++round) {
    moved = false;
    for (int k : free) {
      const auto i = static_cast<std::size_t>(k);
      double step = 1e300;
      for (const std::vector<double>& shape : tried)
        if (const double away = std::abs(shape[i] - begun[i]); away > 1e-9) step = std::min(step, away);
      if (step == 1e300) continue;
      for (int halves = 0; halves < 4; ++halves) {
        step *= 0.5;
        for (double side : {-step, step}) {
          std::vector<double> shape = best.shape;
          shape[i] += side;
          JoinedColumns columns = columns_at(model, c, shape);
          const JoinedTest test = model.test(columns, believed_white);
          if (test.judged() <= best.test.judged()) continue;
          best.take_if_better(test, shape, std::move(columns));
          moved = true;
          break;
        }
      }
    }
  }
}

// A truth whose noise lasts makes steps at all times: by how much more they say, in recordings without the best of
// them, than white noise makes.
double scatter_elsewhere(const std::vector<std::vector<double>>& shapes, const std::vector<double>& said,
                         const ScoredTogether& best) {
  std::vector<double> statistics;
  for (std::size_t k = 0; k < shapes.size(); ++k)
    if (shapes[k][0] != best.shape[0]) statistics.push_back(said[k]);
  return inflation_of(statistics, best.test.freedom);
}

// Which form of one thing it is, is said by the simpler unless that says less by two standard errors.
void take_simpler_form(const JoinedModel& model, double believed_white, ScoredTogether& best) {
  constexpr double kPlainly = 4.0;
  const Effect& e = *best.candidate.effect;
  if (e.simpler_form.empty()) return;
  std::vector<double> shape = best.shape;
  shape.back() = e.simpler_form[static_cast<std::size_t>(shape.back())];
  if (shape == best.shape) return;
  JoinedColumns columns = columns_at(model, best.candidate, shape);
  const JoinedTest test = model.test(columns, believed_white);
  if (test.judged() < best.test.judged() - kPlainly) return;
  best.test = test;
  best.shape = std::move(shape);
  best.columns = std::make_shared<const JoinedColumns>(std::move(columns));
}

}  // namespace

void ScoredTogether::take_if_better(const JoinedTest& other, const std::vector<double>& at, JoinedColumns of) {
  if (columns && other.judged() <= test.judged()) return;
  test = other;
  shape = at;
  columns = std::make_shared<const JoinedColumns>(std::move(of));
}

void ScoredTogether::judge_among(std::size_t looked_at) {
  const double p = test.freedom > 0 ? chi_square_tail(test.judged(), test.freedom) : 1.0;
  p_value = std::min(1.0, p * static_cast<double>(looked_at) * std::exp(log_tests));
}

double least_said(const Vehicle& vehicle) {
  constexpr double kLeast = 25.0, kLeastOfCastors = 100.0;
  return std::holds_alternative<MultiCastor>(vehicle.kind) ? kLeastOfCastors : kLeast;
}

std::vector<JoinedCandidate> joined_candidates(const JoinedModel& model) {
  const std::vector<VehicleUnit> units = units_of(model.vehicle());
  std::vector<std::size_t> all;
  for (std::size_t u = 0; u < units.size(); ++u) all.push_back(u);
  std::vector<JoinedCandidate> list;
  const int runs = static_cast<int>(model.runs().size());
  if (runs > 1)
    for (const Effect& e : effects::wheel_eccentricity_of_each_run(runs))
      for (std::size_t u : all) list.push_back({&e, {u}, component_of_unit(units[u].name, e.component)});
  for (const Effect& e : catalogue()) {
    // A wheel that is not square to its axle is a joint's biased encoder, or where its pivot is: both are in the model.
    if (e.name == "floor_slope_creep" && !model.follows_truth()) continue;  // it is the way of all of them
    if (!e.acts_on_motion() || !e.motions || e.only_commands || e.of_each_recording || e.name == "wheel_toe") continue;
    if (e.local && e.name != "slip_zone") continue;
    const bool of_each = e.name != "floor_slope_creep";
    if (of_each)
      for (std::size_t u : all) list.push_back({&e, {u}, component_of_unit(units[u].name, e.component)});
    if (is_of_all(e) && model.follows_truth() && (all.size() > 1 || !of_each))
      list.push_back({&e, all, e.component == "floor" ? "floor" : "vehicle"});
  }
  return list;
}

std::vector<std::vector<double>> shapes_of(const Effect& e, const std::vector<DriveView>& views) {
  std::vector<std::vector<double>> shapes{{}};
  if (e.scan) shapes = e.scan(views);
  if (e.name == "slip_zone")  // smaller ones are found from these
    std::erase_if(shapes, [](const std::vector<double>& patch) { return patch[2] < 0.4; });
  if (e.forms.size() < 2) return shapes;
  std::vector<std::vector<double>> with_forms;
  for (std::size_t form = 0; form < e.forms.size(); ++form)
    for (std::vector<double> shape : shapes) {
      shape.push_back(static_cast<double>(form));
      with_forms.push_back(std::move(shape));
    }
  return with_forms;
}

JoinedModel::MotionsOf motions_at(const JoinedModel& model, const JoinedCandidate& c,
                                  const std::vector<double>& shape) {
  if (c.effect->name != "collision" || c.units.size() < 2)
    return [&e = *c.effect, shape](const DriveView& view) { return e.motions(view, shape); };
  return [&e = *c.effect, shape, &model, first = c.units.front()](const DriveView& view) {
    const DriveView& of_first = model.views(first)[static_cast<std::size_t>(view.number)];
    std::vector<Motions> motions = e.motions(view, shape);
    return &view == &of_first || motions[2].empty() ? motions : swung(std::move(motions), view, of_first);
  };
}

JoinedColumns columns_at(const JoinedModel& model, const JoinedCandidate& c, const std::vector<double>& shape) {
  return model.columns_of(motions_at(model, c, shape), c.effect->amplitudes.size(), c.units);
}

JoinedColumns columns_at(const JoinedModel& model, const JoinedCandidate& c,
                         const std::vector<std::vector<double>>& shapes) {
  std::vector<JoinedModel::MotionsOf> each;
  for (const std::vector<double>& shape : shapes) each.push_back(motions_at(model, c, shape));
  return model.columns_of_each(each, c.effect->amplitudes.size(), c.units);
}

ScoredTogether at_its_best(const JoinedModel& model, const JoinedCandidate& c, double believed_white,
                           const std::vector<Vec2>& places) {
  ScoredTogether best;
  best.candidate = c;
  std::vector<std::vector<double>> shapes = shapes_of(*c.effect, model.views(c.units.front()));
  if (c.effect->name == "slip_zone")
    for (const Vec2& place : places)
      for (const double radius_m : {0.25, 0.5, 0.9}) shapes.push_back({place.x_m, place.y_m, radius_m, 0.0});
  std::vector<double> said(shapes.size(), 0.0);
  std::size_t at = 0;
  const auto try_shapes = [&](std::size_t from, std::size_t to, std::size_t step) {
    constexpr std::size_t kAtOnce = 16;
    const std::size_t amplitudes = c.effect->amplitudes.size();
    for (std::size_t k = from; k < to;) {
      std::vector<std::size_t> numbers;
      std::vector<std::vector<double>> some;
      for (; k < to && some.size() < kAtOnce; k += step) numbers.push_back(k), some.push_back(shapes[k]);
      const JoinedColumns columns = columns_at(model, c, some);
      const std::vector<JoinedTest> tests = model.tests(columns, amplitudes, believed_white);
      for (std::size_t i = 0; i < some.size(); ++i) {
        said[numbers[i]] = tests[i].statistic;
        if (best.columns && tests[i].judged() <= best.test.judged()) continue;
        at = numbers[i];
        best.take_if_better(
            tests[i], some[i],
            columns.middleCols(static_cast<Eigen::Index>(i * amplitudes), static_cast<Eigen::Index>(amplitudes)));
      }
    }
  };
  const std::size_t stride = !c.effect->local && shapes.size() > kFewShapes ? shapes.size() / kFewShapes + 1 : 1;
  try_shapes(0, shapes.size(), stride);
  if (stride > 1) {
    const std::size_t middle = at;
    try_shapes(middle > stride ? middle - stride + 1 : 0, std::min(middle + stride, shapes.size()), 1);
  }
  if (!best.columns) return best;
  climb(model, c, believed_white, shapes, best);
  take_simpler_form(model, believed_white, best);
  if (c.effect->of_one_recording) best.least_inflation = scatter_elsewhere(shapes, said, best);
  best.test.inflation = std::max(best.test.inflation, best.least_inflation);
  best.log_tests = std::log(std::max(1.0, static_cast<double>(shapes.size()) * c.effect->tests_of_a_shape));
  return best;
}

}  // namespace odolab
