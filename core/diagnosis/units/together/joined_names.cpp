#include "core/diagnosis/units/together/joined_names.h"

#include <algorithm>
#include <cmath>

#include "core/base/chi_square.h"
#include "core/base/parallel.h"
#include "core/base/quantile.h"
#include "core/diagnosis/effects/effect_motions.h"
#include "core/diagnosis/gathered_evidence.h"
#include "core/diagnosis/naming/in_each_run.h"
#include "core/diagnosis/naming/intervals.h"
#include "core/diagnosis/naming/select.h"
#include "core/diagnosis/units/component_names.h"
#include "core/diagnosis/units/together/joined_candidates.h"
#include "core/diagnosis/units/together/joined_moments.h"
#include "core/diagnosis/units/together/joined_unnamed.h"
#include "core/diagnosis/units/together/usual.h"

namespace odolab {

namespace {

constexpr std::ptrdiff_t kMostNames = 3;  // beside what is usual
// Twice what the likelihood gains, at least: of what was sought in many places or from many times on; and of a push
// that one unit feels alone, which as a rule is a joint that errs.
constexpr double kLeastSought = 35.0, kLeastOfOneUnit = 60.0;
constexpr double kAsMuchOfAPush = 0.85;
constexpr double kSaysSomething = 6.0;  // less by itself says nothing beside others either
constexpr double kNearlyLeast = 20.0;   // of a moment, before its form and time are sought
constexpr double kTrace = 0.03;         // of the strongest name: what is less is its form's
constexpr double kSaysAsMuch = 0.8;     // beside the name: then it is no other name for the same
constexpr double k95 = 1.96;

void judge(ScoredTogether& s, std::size_t looked_at) {
  const double p = s.test.freedom > 0 ? chi_square_tail(s.test.judged(), s.test.freedom) : 1.0;
  s.p_value = std::min(1.0, p * static_cast<double>(looked_at) * std::exp(s.log_tests));
}

// In many places, or from many times on.
bool is_sought(const Effect& e) {
  return e.local ||
         std::any_of(e.shapes.begin(), e.shapes.end(), [](const auto& shape) { return shape.name == "at_s"; });
}

// What counts and the joints' rounding make of nothing.
double rounding_m(const ScoredTogether& s, const Vehicle& vehicle) {
  constexpr double kCounts = 1.5;
  double least_m = 0.0;
  const std::vector<VehicleUnit> units = units_of(vehicle);
  for (std::size_t u : s.candidate.units) {
    const DifferentialDrive& d = units[u].drive;
    least_m = std::max({least_m, kCounts * 2.0 * kPi * d.wheel_radius_left_m / d.counts_per_wheel_turn(),
                        rounding_of_joints(vehicle, u).position_m});
  }
  return least_m;
}

// Of what happens at a moment.
bool is_more_than_rounding(const ScoredTogether& s, const Vehicle& vehicle) {
  const double least_m = rounding_m(s, vehicle);
  if (s.test.value.size() < 3) return std::abs(s.test.value[0]) > least_m;
  const double base_m = units_of(vehicle)[s.candidate.units.front()].drive.wheelbase_m;
  return std::max(std::hypot(s.test.value[0], s.test.value[1]), 0.5 * base_m * std::abs(s.test.value[2])) > least_m;
}

// Of what lasts from a time on: by the end of some run.
bool goes_beyond_rounding(const ScoredTogether& s, const JoinedModel& model) {
  const double least_m = rounding_m(s, model.vehicle());
  const std::vector<double> value(s.test.value.begin(), s.test.value.end());
  for (std::size_t u : s.candidate.units)
    for (const DriveView& view : model.views(u)) {
      const Motions moved = motion_of(*s.candidate.effect, view, s.shape, value);
      double forward_m = 0.0, turn_rad = 0.0;
      for (std::size_t i = 0; i < view.steps.size(); ++i) {
        forward_m += moved.at(i).forward_m;
        turn_rad += moved.at(i).turn_rad;
        if (std::max(std::abs(forward_m), 0.5 * view.drive.wheelbase_m * std::abs(turn_rad)) > least_m) return true;
      }
    }
  return false;
}

// Whether values lie within what any vehicle has.
bool is_physical(const ScoredTogether& s) {
  for (std::size_t a = 0; a < s.candidate.effect->amplitudes.size(); ++a) {
    const Effect::Amplitude& of = s.candidate.effect->amplitudes[a];
    const double value = s.test.value[static_cast<Eigen::Index>(a)];
    if (value < of.low || value > of.high) return false;
  }
  return true;
}

// Where the moments are that say most: a patch that is small on a wide floor is met at some of them.
std::vector<Vec2> places_of_moments(const JoinedModel& model) {
  constexpr std::size_t kMost = 8;
  std::vector<Vec2> places;
  for (const JoinedMoments& kind : joined_moments(model, kMost))
    for (const JoinedMoment& m : kind.strongest) {
      const DriveView& view = model.views(kind.units.front())[static_cast<std::size_t>(m.run)];
      places.push_back(view.steps[std::min(view.step_at(m.time_s), view.steps.size() - 1)].position);
    }
  return places;
}

// Two things of the same moment.
bool is_one_moment(const ScoredTogether& a, const ScoredTogether& b) {
  constexpr double kClose_s = 1.0;
  if (!a.candidate.effect->of_one_recording || !b.candidate.effect->of_one_recording) return false;
  return a.shape[0] == b.shape[0] && std::abs(a.shape[1] - b.shape[1]) < kClose_s;
}

// What has a place, within a slippery patch or next to it: the patch's shape is not quite what it is taken for.
bool lies_in_patch(const ScoredTogether& s, const ScoredTogether& patch) {
  constexpr double kBeside_m = 0.2;
  if (patch.candidate.effect->name != "slip_zone" || s.candidate.effect->of_one_recording) return false;
  const auto of = [](const ScoredTogether& one, const char* name) -> std::optional<double> {
    for (std::size_t i = 0; i < one.candidate.effect->shapes.size(); ++i)
      if (one.candidate.effect->shapes[i].name == name) return one.shape[i];
    return std::nullopt;
  };
  const std::optional<double> x_m = of(s, "x_m"), y_m = of(s, "y_m");
  return x_m && y_m &&
         std::hypot(*x_m - *of(patch, "x_m"), *y_m - *of(patch, "y_m")) < *of(patch, "radius_m") + kBeside_m;
}

// One number that says as much as the three of a push at that moment.
bool is_simpler(const ScoredTogether& s, const ScoredTogether& than) {
  return s.of_moments > 0.0 && than.of_moments > 0.0 && is_one_moment(s, than) && s.test.freedom < than.test.freedom &&
         s.test.judged() > kAsMuchOfAPush * than.test.judged();
}

class Naming {
 public:
  Naming(JoinedModel& model, double family_wise_error) : model_(model), p_(family_wise_error) {}

  JoinedNames run(const Progress& progress) {
    name_all(progress);
    const bool is_pushed = std::any_of(named_.begin(), named_.end(),
                                       [](const ScoredTogether& s) { return s.candidate.effect->name == "collision"; });
    if (model_.believes_what_contradicts() && !is_pushed) {
      model_.doubt_what_contradicts();
      named_.clear();
      name_all(progress);
    }
    if (!named_.empty()) {  // what they left had made the noise too large
      model_.fit_noise_beside(acting());
      named_.clear();
      name_all(progress);
    }
    JoinedNames result;
    for (std::size_t k = 0; k < named_.size(); ++k) result.names.push_back(name_of(k));
    std::vector<ScoredTogether> beside;
    if (!named_.empty()) ask_again(without(named_.size()), beside = scored_);
    result.asked = asked_together(scored_, beside, [&](const Effect& e) { return least_of(e); });
    result.unknown = unnamed_together(model_, named_, p_);
    if (!named_.empty()) model_.put_in(acting());
    return result;
  }

 private:
  double least_of(const Effect& e) const { return is_sought(e) ? std::max(least_, kLeastSought) : least_; }

  bool holds(const ScoredTogether& s) const {
    const bool is_push_of_one = s.candidate.effect->name == "collision" && s.candidate.units.size() == 1;
    const double least = std::max(least_of(*s.candidate.effect), is_push_of_one       ? kLeastOfOneUnit
                                                                 : s.of_moments > 0.0 ? kLeastSought
                                                                                      : 0.0);
    const bool is_from_a_time = is_sought(*s.candidate.effect) && !s.candidate.effect->local;
    return s.p_value < p_ && s.test.judged() > least && (s.of_moments > 0.0 || s.test.lasts_throughout()) &&
           (!is_from_a_time || goes_beyond_rounding(s, model_));
  }

  std::vector<JoinedModel::Acting> acting() const {
    std::vector<JoinedModel::Acting> all;
    for (const ScoredTogether& s : named_)
      all.push_back({motions_at(model_, s.candidate, s.shape), s.test.value, s.candidate.units});
    return all;
  }

  // One after the other, the best first.
  void name_all(const Progress& progress) {
    score_all(progress);
    JoinedModel with = model_;
    const auto is_more = [&](const ScoredTogether& s) { return !is_usual(s, model_); };
    while (std::count_if(named_.begin(), named_.end(), is_more) < kMostNames && goes_on(progress, 0.5)) {
      ScoredTogether* best = nullptr;
      std::vector<ScoredTogether> now = scored_;
      if (!named_.empty()) {
        scatter_ = usual_scatter(with);
        ask_again(with, now);
      }
      for (ScoredTogether& s : scored_moments(with)) now.push_back(std::move(s));
      for (ScoredTogether& s : now) {
        if (!holds(s) || !is_physical(s) || is_named(s)) continue;
        if (!named_.empty() && s.test.judged() < kTrace * named_.front().test.judged()) continue;
        if (!best || s.says() > best->says()) best = &s;
      }
      if (!best) break;
      for (ScoredTogether& s : now)
        if (is_simpler(s, *best) && holds(s) && is_physical(s)) best = &s;
      with.let_in(*best->columns);
      named_.push_back(*best);
    }
    leave_out_what_no_longer_holds();
  }

  void score_all(const Progress& progress) {
    const std::vector<JoinedCandidate> list = joined_candidates(model_);
    scored_.resize(list.size());
    std::vector<ScoreByBatches> scores(list.size());
    const std::vector<Vec2> places = places_of_moments(model_);
    parallel_for(
        static_cast<int>(list.size()),
        [&](int k) {
          const auto i = static_cast<std::size_t>(k);
          scored_[i] = at_its_best(model_, list[i], kFewestBatchesBelieved, places);
          if (scored_[i].columns && !list[i].effect->scan) scores[i] = model_.score_by_batches(*scored_[i].columns);
        },
        {}, progress);
    std::erase_if(scored_, [](const ScoredTogether& s) { return !s.columns; });
    std::erase_if(scores, [](const ScoreByBatches& s) { return s.u.empty(); });
    believed_white_ = batches_of_prior(scores);
    scatter_ = usual_scatter(scores);
    parallel_for(static_cast<int>(scored_.size()),
                 [&](int k) { ask_again(model_, scored_[static_cast<std::size_t>(k)]); });
  }

  // Wheels that slip on as they did just now scatter the scores of all that lasts: none is believed to scatter less
  // than most do.
  static double usual_scatter(const std::vector<ScoreByBatches>& scores) {
    constexpr double kFewestToTell = 3.0;  // batches that matter
    std::vector<double> scatters;
    for (const ScoreByBatches& s : scores)
      if (s.count >= kFewestToTell) scatters.push_back(s.scatter);
    return scatters.empty() ? 1.0 : std::max(1.0, median(std::move(scatters)));
  }

  // Beside what was let in.
  double usual_scatter(const JoinedModel& with) const {
    std::vector<ScoreByBatches> scores(scored_.size());
    parallel_for(static_cast<int>(scored_.size()), [&](int k) {
      const auto i = static_cast<std::size_t>(k);
      if (!scored_[i].candidate.effect->scan) scores[i] = with.score_by_batches(*scored_[i].columns);
    });
    return usual_scatter(scores);
  }

  // The strongest moments, each as a bump, as one that comes back at its place, and as a push, as it suits them.
  std::vector<ScoredTogether> scored_moments(const JoinedModel& with) const {
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
        if (e.name != (is_push ? "collision" : "bump") || (!is_push && e.component != component_of(kind.wheel)))
          continue;
        for (const JoinedMoment& moment : kind.strongest)
          if (moment.statistic / kind.inflation > kNearlyLeast) asked.push_back({&e, &kind, &moment});
      }
    std::vector<ScoredTogether> all(asked.size());
    parallel_for(static_cast<int>(asked.size()), [&](int k) {
      const Asked& one = asked[static_cast<std::size_t>(k)];
      all[static_cast<std::size_t>(k)] = scored_moment(with, *one.effect, *one.kind, *one.moment);
    });
    std::erase_if(all, [&](const ScoredTogether& s) { return !is_more_than_rounding(s, model_.vehicle()); });
    return all;
  }

  ScoredTogether scored_moment(const JoinedModel& with, const Effect& e, const JoinedMoments& kind,
                               const JoinedMoment& moment) const {
    ScoredTogether best;
    best.candidate = {&e, kind.units,
                      kind.units.size() > 1
                          ? "vehicle"
                          : component_of_unit(units_of(model_.vehicle())[kind.units.front()].name, e.component)};
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
    judge(best, scored_.size());
    return best;
  }

  static std::vector<double> shape_at(const Effect& e, const JoinedMoment& moment, const JoinedMoments& kind,
                                      const JoinedModel& model) {
    if (e.of_one_recording) return {static_cast<double>(moment.run), moment.time_s};
    const DriveView& view = model.views(kind.units.front())[static_cast<std::size_t>(moment.run)];
    const EffectStep& s = view.steps[std::min(view.step_at(moment.time_s), view.steps.size() - 1)];
    const double side = kind.wheel == Wheel::left ? 0.5 : -0.5;
    const Vec2 place = s.position + rotated({0.0, side * view.drive.wheelbase_m}, s.heading_rad);
    return {place.x_m, place.y_m};
  }

  static void try_moment(const JoinedModel& with, const std::vector<double>& shape, ScoredTogether& best) {
    JoinedColumns columns = columns_at(with, best.candidate, shape);
    JoinedTest test = with.test(columns, -1.0);
    test.inflation = best.of_moments;
    best.take_if_better(test, shape, std::move(columns));
  }

  // Of all that said something by itself.
  void ask_again(const JoinedModel& with, std::vector<ScoredTogether>& all) const {
    std::erase_if(all, [](const ScoredTogether& s) { return s.test.statistic < kSaysSomething; });
    parallel_for(static_cast<int>(all.size()), [&](int k) { ask_again(with, all[static_cast<std::size_t>(k)]); });
  }

  void ask_again(const JoinedModel& with, ScoredTogether& s) const {
    s.test = with.test(*s.columns, s.of_moments > 0.0 ? -1.0 : believed_white_);
    s.test.inflation = s.of_moments > 0.0 ? s.of_moments : std::max({s.test.inflation, s.least_inflation, scatter_});
    judge(s, scored_.size());
  }

  bool is_named(const ScoredTogether& s) const {
    return std::any_of(named_.begin(), named_.end(), [&](const ScoredTogether& n) {
      if (lies_in_patch(s, n)) return true;
      if (s.candidate.effect->local || n.candidate.effect->local) return is_one_moment(s, n);
      return n.candidate.effect == s.candidate.effect && n.candidate.component == s.candidate.component;
    });
  }

  JoinedModel without(std::size_t left_out) const {
    JoinedModel others = model_;
    for (std::size_t k = 0; k < named_.size(); ++k)
      if (k != left_out) others.let_in(*named_[k].columns);
    return others;
  }

  // Beside the others.
  void leave_out_what_no_longer_holds() {
    for (std::size_t k = named_.size(); k-- > 0;) {
      const JoinedModel others = without(k);
      ask_again(others, named_[k]);
      if (!holds(named_[k]) || !comes_back_in_each(others, named_[k]))
        named_.erase(named_.begin() + static_cast<std::ptrdiff_t>(k));
    }
    for (std::size_t k = 0; k < named_.size(); ++k) ask_again(without(k), named_[k]);
    std::stable_sort(named_.begin(), named_.end(), [](const ScoredTogether& a, const ScoredTogether& b) {
      return a.test.judged() > b.test.judged();
    });
  }

  static bool comes_back_in_each(const JoinedModel& others, const ScoredTogether& s) {
    if (s.candidate.effect->of_one_recording) return true;
    return comes_back(gain_of_each(others.evidence_of(*s.columns, s.test.value), std::max(1.0, s.test.inflation)));
  }

  JoinedName name_of(std::size_t k) const {
    const ScoredTogether& s = named_[k];
    const Effect& e = *s.candidate.effect;
    JoinedName name{{}, s.candidate.units, is_usual(s, model_)};
    Finding& f = name.finding;
    f.effect = e.name;
    f.component = s.candidate.component;
    f.sentence = e.sentence;
    f.where.regime = e.regime;
    if (e.of_one_recording) {
      f.where.recording = model_.names()[static_cast<std::size_t>(s.shape[0])];
      f.where.and_later_recordings = e.and_later_recordings;
    }
    if (e.name == "slip_zone") f.where.zone = WhereFound::Zone{s.shape[0], s.shape[1], s.shape[2]};
    f.p_value = s.p_value;
    f.log_likelihood_gain = 0.5 * s.test.judged();
    if (e.forms.size() > 1) {
      f.form = static_cast<int>(s.shape.back());
      f.form_in_words = e.forms[static_cast<std::size_t>(f.form)];
    }
    AcceptedEffect accepted{&e, s.shape, {}, false};
    for (Eigen::Index a = 0; a < s.test.value.size(); ++a) accepted.value.push_back(s.test.value[a]);
    JoinedModel others = without(k), with = others;
    f.parameters = parameters_of(accepted, covariance_of(others, s), model_.views(s.candidate.units.front()));
    for (const FoundParameter& p : f.parameters)
      if (p.name == "at_s") f.where.time_s = {{p.value - k95 * p.stderr_value, p.value + k95 * p.stderr_value}};

    f.gathered = gathered_evidence(others.evidence_of(*s.columns, s.test.value), model_.names(), f.log_likelihood_gain);
    with.let_in(*s.columns);
    std::vector<ScoredTogether> instead = scored_;
    std::erase_if(instead, [&](const ScoredTogether& other) { return other.test.judged() < 0.3 * s.test.judged(); });
    if (s.of_moments > 0.0)
      for (ScoredTogether& other : scored_moments(others))
        if (other.candidate.effect->of_one_recording == e.of_one_recording &&
            (!e.of_one_recording || is_one_moment(other, s)))
          instead.push_back(std::move(other));
    ask_again(others, instead);
    for (ScoredTogether& other : instead) {
      if (other.candidate.effect->name == e.name && other.candidate.component == s.candidate.component) continue;
      if (!is_physical(other) || other.test.judged() < least_) continue;
      const double less_tried = 2.0 * std::max(0.0, s.log_tests - other.log_tests);
      if (other.test.judged() < s.test.judged() - kClearlyBeaten - less_tried || is_simpler(s, other)) continue;
      const double alone = other.test.judged();
      ask_again(with, other);
      if (other.test.judged() > kSaysAsMuch * alone) continue;
      f.alternatives.push_back({other.candidate.effect->name, other.candidate.component, 0.5 * alone,
                                other.candidate.effect->told_apart_by});
    }
    std::stable_sort(f.alternatives.begin(), f.alternatives.end(), [](const Alternative& a, const Alternative& b) {
      return a.log_likelihood_gain > b.log_likelihood_gain;
    });
    return name;
  }

  // By how much a time can be another until that says less by one, in the mean of both sides.
  double stderr_of_time(const JoinedModel& others, const ScoredTogether& s, std::size_t shape) const {
    constexpr double kLeast_s = 0.05, kMost_s = 3.2;
    double sum_s = 0.0;
    for (double side : {-1.0, 1.0}) {
      double by_s = kLeast_s;
      for (; by_s < kMost_s; by_s *= 2.0) {
        std::vector<double> moved = s.shape;
        moved[shape] += side * by_s;
        const JoinedTest test = others.test(columns_at(others, s.candidate, moved), believed_white_);
        const double less = s.test.judged() - test.statistic / s.test.inflation;
        if (less < 1.0) continue;
        by_s /= std::sqrt(less);
        break;
      }
      sum_s += 0.5 * std::max(by_s, kLeast_s);
    }
    return sum_s;
  }

  // With what a form is wrong by; of places and limits as wide as what was scanned.
  Eigen::MatrixXd covariance_of(const JoinedModel& others, const ScoredTogether& s) const {
    constexpr double kForm = 0.03, kOneOfSeveral = 0.05;
    const Effect& e = *s.candidate.effect;
    Eigen::MatrixXd covariance = s.test.inflation * s.test.covariance;
    const double size = s.test.value.norm();
    covariance.diagonal().array() += std::pow((e.forms.size() > 1 ? kOneOfSeveral : kForm) * size, 2);
    const std::vector<int> free = free_shapes(e);
    const Eigen::Index amplitudes = covariance.rows(), shapes = static_cast<Eigen::Index>(free.size());
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(amplitudes + shapes, amplitudes + shapes);
    all.topLeftCorner(amplitudes, amplitudes) = covariance;
    // The scanned shapes that the likelihood does not tell apart say how well a shape is known.
    const std::vector<std::vector<double>> shapes_tried = shapes_of(e, model_.views(s.candidate.units.front()));
    for (Eigen::Index f = 0; f < shapes; ++f) {
      double nearest = 1e300;
      const auto k = static_cast<std::size_t>(free[static_cast<std::size_t>(f)]);
      if (e.shapes[k].name == "at_s") {
        all(amplitudes + f, amplitudes + f) = std::pow(stderr_of_time(others, s, k), 2);
        continue;
      }
      for (const std::vector<double>& shape : shapes_tried)
        if (std::abs(shape[k] - s.shape[k]) > 1e-9) nearest = std::min(nearest, std::abs(shape[k] - s.shape[k]));
      if (nearest < 1e300) all(amplitudes + f, amplitudes + f) = nearest * nearest;
    }
    return all;
  }

  JoinedModel& model_;
  double least_ = least_said(model_.vehicle());
  double p_, believed_white_ = kFewestBatchesBelieved, scatter_ = 1.0;
  std::vector<ScoredTogether> scored_, named_;
};

}  // namespace

JoinedNames joined_names(JoinedModel& model, double family_wise_error, const Progress& progress) {
  return Naming(model, family_wise_error).run(progress);
}

}  // namespace odolab
