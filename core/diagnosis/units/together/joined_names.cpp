#include "core/diagnosis/units/together/joined_names.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel.h"
#include "core/base/quantile.h"
#include "core/diagnosis/gathered_evidence.h"
#include "core/diagnosis/naming/in_each_run.h"
#include "core/diagnosis/naming/intervals.h"
#include "core/diagnosis/naming/select.h"
#include "core/diagnosis/units/together/beyond_rounding.h"
#include "core/diagnosis/units/together/joined_candidates.h"
#include "core/diagnosis/units/together/joined_errors.h"
#include "core/diagnosis/units/together/joined_moments.h"
#include "core/diagnosis/units/together/joined_unnamed.h"
#include "core/diagnosis/units/together/scored_moments.h"
#include "core/diagnosis/units/together/usual.h"

namespace odolab {

namespace {

constexpr std::ptrdiff_t kMostNames = 3;  // beside what is usual
// Twice what the likelihood gains, at least: of what was sought in many places or from many times on; and of a push
// that one unit feels alone, which as a rule is a joint that errs.
constexpr double kLeastSought = 35.0, kLeastOfOneUnit = 60.0;
constexpr double kAsMuchOfAPush = 0.85;
constexpr double kSaysSomething = 6.0;  // less by itself says nothing beside others either
constexpr double kTrace = 0.03;         // of the strongest name: what is less is its form's
constexpr double kSaysAsMuch = 0.8;     // beside the name: then it is no other name for the same
constexpr double k95 = 1.96;

// In many places, or from many times on.
bool is_sought(const Effect& e) {
  return e.local ||
         std::any_of(e.shapes.begin(), e.shapes.end(), [](const auto& shape) { return shape.name == "at_s"; });
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

class JoinedNaming {
 public:
  JoinedNaming(JoinedModel& model, double family_wise_error) : model_(model), p_(family_wise_error) {}

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
           (!is_from_a_time || lasts_beyond_rounding(s, model_));
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
      for (ScoredTogether& s : scored_moments(with, scored_.size())) now.push_back(std::move(s));
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

  // Of all that said something by itself.
  void ask_again(const JoinedModel& with, std::vector<ScoredTogether>& all) const {
    std::erase_if(all, [](const ScoredTogether& s) { return s.test.statistic < kSaysSomething; });
    parallel_for(static_cast<int>(all.size()), [&](int k) { ask_again(with, all[static_cast<std::size_t>(k)]); });
  }

  void ask_again(const JoinedModel& with, ScoredTogether& s) const {
    s.test = with.test(*s.columns, s.of_moments > 0.0 ? -1.0 : believed_white_);
    s.test.inflation = s.of_moments > 0.0 ? s.of_moments : std::max({s.test.inflation, s.least_inflation, scatter_});
    s.judge_among(scored_.size());
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
    f.parameters =
        parameters_of(accepted, joined_covariance(others, s, believed_white_), model_.views(s.candidate.units.front()));
    for (const FoundParameter& p : f.parameters)
      if (p.name == "at_s") f.where.time_s = {{p.value - k95 * p.stderr_value, p.value + k95 * p.stderr_value}};

    f.gathered = gathered_evidence(others.evidence_of(*s.columns, s.test.value), model_.names(), f.log_likelihood_gain);
    with.let_in(*s.columns);
    std::vector<ScoredTogether> instead = scored_;
    std::erase_if(instead, [&](const ScoredTogether& other) { return other.test.judged() < 0.3 * s.test.judged(); });
    if (s.of_moments > 0.0)
      for (ScoredTogether& other : scored_moments(others, scored_.size()))
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

  JoinedModel& model_;
  double least_ = least_said(model_.vehicle());
  double p_, believed_white_ = kFewestBatchesBelieved, scatter_ = 1.0;
  std::vector<ScoredTogether> scored_, named_;
};

}  // namespace

JoinedNames joined_names(JoinedModel& model, double family_wise_error, const Progress& progress) {
  return JoinedNaming(model, family_wise_error).run(progress);
}

}  // namespace odolab
