#include "core/diagnosis/units/together/joined_names.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "core/base/chi_square.h"
#include "core/base/parallel.h"
#include "core/diagnosis/generic/generic_tests.h"
#include "core/diagnosis/naming/intervals.h"
#include "core/diagnosis/naming/select.h"
#include "core/diagnosis/units/component_names.h"
#include "core/diagnosis/units/together/joined_groups.h"

namespace odolab {

namespace {

constexpr std::size_t kMostNames = 3;
constexpr double kLeast = 25.0;  // twice what the likelihood gains
constexpr double kUneven = 2.5,
                 kBeyondDoubt = 200.0;  // the scatter of what acts in a few places, unless it says so much
constexpr double kTrace = 0.03;         // of the strongest name: what is less is its form's
constexpr double kSaysAsMuch = 0.8;     // beside the name: then it is no other name for the same
constexpr std::size_t kFewShapes = 40;
constexpr double kUnnamedInstead = 1.15;
constexpr double k95 = 1.96;

// An entry of the catalogue on one unit, or on all of them.
struct Candidate {
  const Effect* effect = nullptr;
  std::vector<std::size_t> units;
  std::string component;
};

struct Scored {
  Candidate candidate;
  std::vector<double> shape;
  JoinedColumns columns;
  JoinedTest test;
  double log_tests = 0.0, p_value = 1.0;
  double says() const { return test.judged() - 2.0 * test.freedom - 2.0 * log_tests; }
};

// What acts on a vehicle as a whole, through its speed, its load, its tyres or the floor.
bool is_of_all(const Effect& e) {
  static const std::set<std::string> names = {
      "floor_slope_creep", "slip_zone",     "lateral_slip", "turn_speed_loss",       "speed_dependent_radius",
      "tyre_compression",  "traction_slip", "turn_scrub",   "payload_radius_change", "radius_drift"};
  return names.count(e.name) > 0 &&
         (e.component == "both_wheels" || e.component == "vehicle" || e.component == "floor");
}

std::vector<Candidate> candidates(const JoinedModel& model) {
  const std::vector<VehicleUnit> units = units_of(model.vehicle());
  std::vector<std::size_t> all;
  for (std::size_t u = 0; u < units.size(); ++u) all.push_back(u);
  std::vector<Candidate> list;
  const int runs = static_cast<int>(model.runs().size());
  if (runs > 1)
    for (const Effect& e : effects::wheel_eccentricity_of_each_run(runs))
      for (std::size_t u : all) list.push_back({&e, {u}, component_of_unit(units[u].name, e.component)});
  for (const Effect& e : catalogue()) {
    // A wheel that is not square to its axle is a joint's biased encoder, or where its pivot is: both are in the model.
    if (e.name == "floor_slope_creep" && !model.has_truth()) continue;  // it is the way of all of them
    if (!e.acts_on_motion() || !e.motions || e.only_commands || e.of_each_recording || e.name == "wheel_toe") continue;
    if (e.local && e.name != "slip_zone") continue;
    if (e.name != "floor_slope_creep")
      for (std::size_t u : all) list.push_back({&e, {u}, component_of_unit(units[u].name, e.component)});
    if (is_of_all(e) && model.has_truth()) list.push_back({&e, all, e.component == "floor" ? "floor" : "vehicle"});
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

JoinedColumns columns_at(const JoinedModel& model, const Candidate& c, const std::vector<double>& shape) {
  return model.columns_of([&](const DriveView& view) { return c.effect->motions(view, shape); },
                          c.effect->amplitudes.size(), c.units);
}

// To where between the shapes that were tried it says most.
void climb(const JoinedModel& model, const Candidate& c, double believed_white,
           const std::vector<std::vector<double>>& tried, Scored& best) {
  for (int k : free_shapes(*c.effect)) {
    const auto i = static_cast<std::size_t>(k);
    double step = 1e300;
    for (const std::vector<double>& shape : tried)
      if (const double away = std::abs(shape[i] - best.shape[i]); away > 1e-9) step = std::min(step, away);
    for (int halves = 0; halves < 4 && step < 1e300; ++halves) {
      step *= 0.5;
      for (double side : {-step, step}) {
        std::vector<double> shape = best.shape;
        shape[i] += side;
        JoinedColumns columns = columns_at(model, c, shape);
        const JoinedTest test = model.test(columns, believed_white);
        if (test.judged() <= best.test.judged()) continue;
        best.test = test;
        best.shape = std::move(shape);
        best.columns = std::move(columns);
        break;
      }
    }
  }
}

// At the shape that says most; of many, every so many-th first, and then those beside the best.
Scored at_its_best(const JoinedModel& model, const Candidate& c, double believed_white) {
  Scored best;
  best.candidate = c;
  std::vector<std::vector<double>> shapes = shapes_of(*c.effect, model.views(c.units.front()));
  const auto try_shape = [&](std::size_t k) {
    JoinedColumns columns = columns_at(model, c, shapes[k]);
    const JoinedTest test = model.test(columns, believed_white);
    if (best.columns.size() > 0 && test.judged() <= best.test.judged()) return false;
    best.test = test;
    best.shape = shapes[k];
    best.columns = std::move(columns);
    return true;
  };
  const std::size_t stride = !c.effect->local && shapes.size() > kFewShapes ? shapes.size() / kFewShapes + 1 : 1;
  std::size_t at = 0;
  for (std::size_t k = 0; k < shapes.size(); k += stride)
    if (try_shape(k)) at = k;
  if (stride > 1)
    for (std::size_t k = at > stride ? at - stride + 1 : 0; k < std::min(at + stride, shapes.size()); ++k) try_shape(k);
  for (int rounds = 0; rounds < (free_shapes(*c.effect).size() > 1 ? 2 : 1); ++rounds)
    climb(model, c, believed_white, shapes, best);
  best.log_tests = std::log(std::max(1.0, static_cast<double>(shapes.size()) * c.effect->tests_of_a_shape));
  return best;
}

void judge(Scored& s, std::size_t looked_at) {
  const double p = s.test.freedom > 0 ? chi_square_tail(s.test.judged(), s.test.freedom) : 1.0;
  s.p_value = std::min(1.0, p * static_cast<double>(looked_at) * std::exp(s.log_tests));
}

// Not by what happens in a few places only, and predicts what it was not fitted on.
bool lasts_throughout(const JoinedTest& test) {
  return test.cross_validated > 0.0 && (test.inflation < kUneven || test.judged() > kBeyondDoubt);
}

bool holds(const Scored& s, double family_wise_error) {
  return s.p_value < family_wise_error && s.test.judged() > kLeast && lasts_throughout(s.test);
}

// Whether values lie within what any vehicle has.
bool is_physical(const Scored& s) {
  for (std::size_t a = 0; a < s.candidate.effect->amplitudes.size(); ++a) {
    const Effect::Amplitude& of = s.candidate.effect->amplitudes[a];
    const double value = s.test.value[static_cast<Eigen::Index>(a)];
    if (value < of.low || value > of.high) return false;
  }
  return true;
}

class Naming {
 public:
  Naming(JoinedModel& model, double family_wise_error) : model_(model), p_(family_wise_error) {}

  JoinedNames run(const Progress& progress) {
    score_all(progress);
    JoinedModel with = model_;
    while (named_.size() < kMostNames && goes_on(progress, 0.5)) {
      Scored* best = nullptr;
      std::vector<Scored> now = scored_;
      for (Scored& s : now) {
        if (!named_.empty()) ask_again(with, s);
        if (!holds(s, p_) || !is_physical(s) || is_named(s)) continue;
        if (!named_.empty() && s.test.judged() < kTrace * named_.front().test.judged()) continue;
        if (!best || s.says() > best->says()) best = &s;
      }
      if (!best) break;
      with.let_in(best->columns);
      named_.push_back(*best);
    }
    leave_out_what_no_longer_holds();
    JoinedNames result;
    for (std::size_t k = 0; k < named_.size(); ++k) result.names.push_back(name_of(k));
    look_for_the_unnamed(result);
    for (const Scored& s : named_) model_.let_in(s.columns);
    return result;
  }

 private:
  void score_all(const Progress& progress) {
    const std::vector<Candidate> list = candidates(model_);
    scored_.resize(list.size());
    std::vector<ScoreByBatches> scores(list.size());
    parallel_for(
        static_cast<int>(list.size()),
        [&](int k) {
          const auto i = static_cast<std::size_t>(k);
          scored_[i] = at_its_best(model_, list[i], kFewestBatchesBelieved);
          if (!list[i].effect->scan) scores[i] = model_.score_by_batches(scored_[i].columns);
        },
        {}, progress);
    std::erase_if(scores, [](const ScoreByBatches& s) { return s.u.empty(); });
    believed_white_ = batches_of_prior(scores);
    for (Scored& s : scored_) {
      s.test = model_.test(s.columns, believed_white_);
      judge(s, scored_.size());
    }
  }

  void ask_again(const JoinedModel& with, Scored& s) const {
    s.test = with.test(s.columns, believed_white_);
    judge(s, scored_.size());
  }

  bool is_named(const Scored& s) const {
    return std::any_of(named_.begin(), named_.end(), [&](const Scored& n) {
      return n.candidate.effect == s.candidate.effect && n.candidate.component == s.candidate.component;
    });
  }

  JoinedModel without(std::size_t left_out) const {
    JoinedModel others = model_;
    for (std::size_t k = 0; k < named_.size(); ++k)
      if (k != left_out) others.let_in(named_[k].columns);
    return others;
  }

  // Beside the others.
  void leave_out_what_no_longer_holds() {
    for (std::size_t k = named_.size(); k-- > 0;) {
      ask_again(without(k), named_[k]);
      if (!holds(named_[k], p_)) named_.erase(named_.begin() + static_cast<std::ptrdiff_t>(k));
    }
    for (std::size_t k = 0; k < named_.size(); ++k) ask_again(without(k), named_[k]);
    std::stable_sort(named_.begin(), named_.end(),
                     [](const Scored& a, const Scored& b) { return a.test.judged() > b.test.judged(); });
  }

  JoinedName name_of(std::size_t k) const {
    const Scored& s = named_[k];
    const Effect& e = *s.candidate.effect;
    JoinedName name{{}, s.candidate.units};
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
    f.parameters = parameters_of(accepted, covariance_of(s));
    for (const FoundParameter& p : f.parameters)
      if (p.name == "at_s") f.where.time_s = {{p.value - k95 * p.stderr_value, p.value + k95 * p.stderr_value}};

    JoinedModel others = without(k), with = others;
    with.let_in(s.columns);
    for (Scored other : scored_) {
      if (other.candidate.effect->name == e.name && other.candidate.component == s.candidate.component) continue;
      ask_again(others, other);
      if (!is_physical(other) || other.test.judged() < kLeast) continue;
      const double less_tried = 2.0 * std::max(0.0, s.log_tests - other.log_tests);
      if (other.test.judged() < s.test.judged() - kClearlyBeaten - less_tried) continue;
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

  // With what a form is wrong by, and of shapes as wide as what was scanned.
  Eigen::MatrixXd covariance_of(const Scored& s) const {
    constexpr double kForm = 0.03;
    Eigen::MatrixXd covariance = s.test.inflation * s.test.covariance;
    const double size = s.test.value.norm();
    covariance.diagonal().array() += std::pow(kForm * size, 2);
    const Effect& e = *s.candidate.effect;
    const std::vector<int> free = free_shapes(e);
    const Eigen::Index amplitudes = covariance.rows(), shapes = static_cast<Eigen::Index>(free.size());
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(amplitudes + shapes, amplitudes + shapes);
    all.topLeftCorner(amplitudes, amplitudes) = covariance;
    // The scanned shapes that the likelihood does not tell apart say how well a shape is known.
    const std::vector<std::vector<double>> shapes_tried = shapes_of(e, model_.views(s.candidate.units.front()));
    for (Eigen::Index f = 0; f < shapes; ++f) {
      double nearest = 1e300;
      const auto k = static_cast<std::size_t>(free[static_cast<std::size_t>(f)]);
      for (const std::vector<double>& shape : shapes_tried)
        if (std::abs(shape[k] - s.shape[k]) > 1e-9) nearest = std::min(nearest, std::abs(shape[k] - s.shape[k]));
      if (nearest < 1e300) all(amplitudes + f, amplitudes + f) = nearest * nearest;
    }
    return all;
  }

  void look_for_the_unnamed(JoinedNames& result) const {
    JoinedModel with = model_;
    double named = 0.0;
    for (const Scored& s : named_) {
      with.let_in(s.columns);
      named += s.test.judged();
    }
    const std::vector<JoinedGroup> groups = joined_groups(model_);
    std::vector<Finding> found(groups.size());
    std::vector<double> excess(groups.size(), 0.0);
    parallel_for(static_cast<int>(groups.size()), [&](int i) {
      const auto k = static_cast<std::size_t>(i);
      const JoinedColumns columns = groups[k].columns(model_);
      const JoinedTest beside = with.test(columns), instead = named_.empty() ? beside : model_.test(columns);
      const double tests = static_cast<double>(groups.size());
      const double p = beside.freedom > 0 ? chi_square_tail(beside.judged(), beside.freedom) * tests : 1.0;
      const bool more_beside = p < 0.1 * p_ && beside.judged() > kLeast + 2.0 * beside.freedom &&
                               beside.judged() - beside.freedom > kMostLeft * named && lasts_throughout(beside);
      const bool more_instead =
          !named_.empty() && p < 0.1 * p_ &&
          instead.judged() - 2.0 * instead.freedom - 2.0 * std::log(tests) > kUnnamedInstead * named;
      if (!more_beside && !more_instead) return;
      if (groups[k].is_more_than_rounding) {
        const Eigen::VectorXd& value = beside.value;
        if (!groups[k].is_more_than_rounding(std::vector<double>(value.begin(), value.end()))) return;
      }
      Finding& f = found[k];
      f.effect = "unknown";
      f.component = groups[k].component;
      f.where.regime = groups[k].words;
      f.log_likelihood_gain = 0.5 * (named_.empty() ? beside.judged() : std::max(beside.judged(), instead.judged()));
      f.p_value = std::min(1.0, p);
      f.sentence = "something that no entry of the catalogue describes: " + groups[k].words;
      excess[k] = f.log_likelihood_gain - 0.5 * beside.freedom;
    });
    const auto most = std::max_element(excess.begin(), excess.end());
    if (most == excess.end() || *most <= 0.0) return;
    result.unknown = found[static_cast<std::size_t>(most - excess.begin())];
    for (const JoinedName& n : result.names)
      result.unknown->alternatives.push_back(
          {n.finding.effect, n.finding.component, n.finding.log_likelihood_gain, ""});
  }

  JoinedModel& model_;
  double p_, believed_white_ = kFewestBatchesBelieved;
  std::vector<Scored> scored_, named_;
};

}  // namespace

JoinedNames joined_names(JoinedModel& model, double family_wise_error, const Progress& progress) {
  return Naming(model, family_wise_error).run(progress);
}

}  // namespace odolab
