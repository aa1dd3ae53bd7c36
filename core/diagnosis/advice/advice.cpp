#include "core/diagnosis/advice/advice.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/formatted.h"
#include "core/base/parallel.h"
#include "core/base/quantile.h"
#include "core/diagnosis/advice/advised_drive.h"
#include "core/diagnosis/advice/drive_plan.h"
#include "core/diagnosis/advice/visible.h"
#include "core/diagnosis/naming/select.h"
#include "core/vehicle/key_words.h"

namespace odolab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kShared = 6;             // parameters of all runs, which come first
constexpr double kWorthDriving = 0.7;  // of the standard deviations that a decision needs

DrivingRange range_of(const JointModel& joint) {
  std::vector<double> v, w, a, b;
  for (const DriveView& view : joint.views())
    for (const EffectStep& s : view.steps) {
      v.push_back(std::abs(s.speed_mps)), w.push_back(std::abs(s.yaw_rate_radps));
      a.push_back(std::abs(s.acceleration_mps2)), b.push_back(std::abs(s.yaw_acceleration_radps2));
    }
  DrivingRange r;
  r.speed_mps = std::clamp(quantile(v, 0.95), 0.1, 3.0);
  // Who only drove straight can turn too: each wheel at half its speed.
  r.yaw_rate_radps = std::clamp(std::max(quantile(w, 0.95), r.speed_mps / joint.model.drive.wheelbase_m), 0.2, 3.0);
  r.acceleration_mps2 = std::clamp(quantile(a, 0.98), 0.2, 2.0);
  r.yaw_acceleration_radps2 = std::clamp(quantile(b, 0.98), 1.0, 10.0);
  return r;
}

// A model with the manoeuvres as its runs, one each.
JointModel imagined(const JointModel& joint, const std::vector<AdvisedDrive>& all, const DrivingRange& range) {
  std::vector<double> periods;
  int with_heading = 0;
  for (const InnovationRun& run : joint.runs()) {
    with_heading += run.truth_has_heading ? 1 : -1;
    for (std::size_t i = 1; i < run.truth.size(); ++i) periods.push_back(run.truth[i].time_s - run.truth[i - 1].time_s);
  }
  std::vector<InnovationRun> runs;
  for (const AdvisedDrive& m : all)
    runs.push_back(run_of(m, range, joint.model.drive, quantile(periods, 0.5), with_heading > 0));
  LeastSquaresCalibration start;
  start.vehicle.kind = joint.model.drive;
  start.vehicle.truth = joint.model.truth;
  start.vehicle.truth.time_offset_s = 0.0;
  start.noise = joint.model.noise;
  const Vehicle nominal = start.vehicle;
  JointModel m(std::move(runs), std::vector<char>(all.size(), joint.views().front().from_commands), start, nominal);
  m.linearise();
  return m;
}

// Columns in question, behind those of the six shared parameters: of effects that were let in, and of candidates.
struct Question {
  const Effect* effect = nullptr;
  std::vector<double> shape;
  int first_column = 0;

  int columns() const { return static_cast<int>(effect->amplitudes.size()); }
};

// Information on the six shared parameters and on all columns in question, the clock of the run projected off.
MatrixXd information(const JointModel& joint, int run, const std::vector<Question>& questions) {
  const LinearisedRun& linear = joint.linearised()[static_cast<std::size_t>(run)];
  const int rows = 3 * linear.samples();
  int q = 7;
  for (const Question& c : questions) q += c.columns();
  MatrixXd z = MatrixXd::Zero(rows, q);
  std::array<double*, column::first_extra> of_parameters{};
  for (int c = 0; c < 6; ++c) of_parameters[static_cast<std::size_t>(c)] = z.col(c).data();
  of_parameters[column::truth_clock] = z.col(6).data();
  linear.of_parameters(of_parameters);
  int at = 7;
  const DriveView& view = joint.views()[static_cast<std::size_t>(run)];
  for (const Question& c : questions) {
    if (c.effect->clock_rate) {
      if (!c.effect->of_each_recording) linear.of_clock_rate(z.col(at).data());
      at += c.columns();
      continue;
    }
    for (const Motions& m : c.effect->motions(view, c.shape)) linear.of_motion(m, z.col(at++).data());
  }
  MatrixXd gram = z.transpose() * z;
  MatrixXd out(q - 1, q - 1);  // the clock last
  std::vector<int> order{0, 1, 2, 3, 4, 5};
  for (int c = 7; c < q; ++c) order.push_back(c);
  const double clock = gram(6, 6) + 25.0;
  for (int i = 0; i < q - 1; ++i)
    for (int j = 0; j < q - 1; ++j)
      out(i, j) = gram(order[i], order[j]) - gram(order[i], 6) * gram(6, order[j]) / clock;
  return out;
}

// What is open: which of two names it is, and what could not have been seen.
struct Open {
  std::vector<Question> questions;
  std::vector<Decision> pairs, sights;    // of confusions; of each dark effect
  std::vector<std::size_t> confusion_of;  // each pair

  int columns() const {
    return questions.empty() ? kShared : questions.back().first_column + questions.back().columns();
  }
  std::size_t ask(const Effect* effect, const std::vector<double>& shape) {
    questions.push_back({effect, shape, columns()});
    return questions.size() - 1;
  }
  // Told from the best that the shared parameters and the questions `free` can do in place of `value`.
  Decision decision(int from, const std::vector<double>& value, const std::vector<std::size_t>& free, double inflation,
                    double needed) const {
    const auto size = static_cast<Eigen::Index>(value.size());
    Decision d;
    d.from = from;
    d.value = Eigen::Map<const VectorXd>(value.data(), size);
    for (int c = 0; c < kShared; ++c) d.free.push_back(c);
    for (std::size_t q : free)
      for (int k = 0; k < questions[q].columns(); ++k)
        if (const int c = questions[q].first_column + k; c < from || c >= from + size) d.free.push_back(c);
    d.inflation = inflation;
    d.needed = needed;
    return d;
  }
};

Open open_of(const JointModel& joint, const std::vector<Confusion>& confused, const std::vector<Visible>& dark) {
  const double told_apart = std::sqrt(kClearlyBeaten) + kPower;
  Open open;
  std::vector<std::size_t> known, alternatives;
  for (const AcceptedEffect& a : joint.accepted) known.push_back(open.ask(a.effect, a.shape));
  // All that is known but for one, with another.
  const auto known_beside = [&](std::size_t own, std::size_t other) {
    std::vector<std::size_t> free = known;
    std::erase(free, own);
    free.push_back(other);
    return free;
  };
  for (const Confusion& c : confused) alternatives.push_back(open.ask(c.alternative, c.shape));
  // The name that was fitted, told from the other.
  for (std::size_t k = 0; k < confused.size(); ++k) {
    const std::size_t own = known[static_cast<std::size_t>(confused[k].accepted)];
    open.pairs.push_back(open.decision(open.questions[own].first_column, joint.accepted[own].value,
                                       known_beside(own, alternatives[k]), confused[k].inflation, told_apart));
    open.confusion_of.push_back(k);
  }
  // Beaten in the form that fits best, a name would come back in another: the other one, told from that.
  for (std::size_t k = 0; k < confused.size(); ++k) {
    const std::size_t own = known[static_cast<std::size_t>(confused[k].accepted)];
    const AcceptedEffect& a = joint.accepted[own];
    for (std::size_t form = 0; form < a.effect->forms.size(); ++form) {
      std::vector<double> shape = a.shape;
      if (shape.back() == static_cast<double>(form) || confused[k].value.empty()) continue;
      shape.back() = static_cast<double>(form);
      const std::size_t question = open.ask(a.effect, shape);
      open.pairs.push_back(open.decision(open.questions[alternatives[k]].first_column, confused[k].value,
                                         known_beside(own, question), confused[k].inflation, told_apart));
      open.confusion_of.push_back(k);
    }
  }
  // An effect of medium size, told from none.
  for (const Visible& v : dark) {
    const std::size_t question = open.ask(v.effect, v.shape);
    std::vector<std::size_t> free = known;
    free.push_back(question);
    open.sights.push_back(open.decision(open.questions[question].first_column + v.weakest,
                                        {v.effect->amplitudes[static_cast<std::size_t>(v.weakest)].medium}, free,
                                        v.inflation, v.standard));
  }
  return open;
}

// Information on all columns: what is known before any drive and by the recordings, and what each drive would add.
struct KnownAlready {
  MatrixXd now;
  std::vector<MatrixXd> adds;
};

KnownAlready known_of(const JointModel& joint, const Open& open, const std::vector<AdvisedDrive>& all,
                      const DrivingRange& range) {
  const JointModel drives = imagined(joint, all, range);
  std::vector<Question> elsewhere = open.questions;  // neither events nor places come back
  for (Question& q : elsewhere) {
    for (std::size_t k = 0; k < q.effect->shapes.size(); ++k)
      if (q.effect->shapes[k].name == kSessionStart) q.shape[k] = 0.0;  // a session begins with the drive
    if (q.effect->of_one_recording || q.effect->and_later_recordings || q.effect->local) q.shape[0] = 1e6;
  }
  const int runs = static_cast<int>(joint.runs().size()), count = runs + static_cast<int>(all.size());
  std::vector<MatrixXd> parts(static_cast<std::size_t>(count));
  parallel_for(count, [&](int i) {
    parts[static_cast<std::size_t>(i)] =
        i < runs ? information(joint, i, open.questions) : information(drives, i - runs, elsewhere);
  });
  KnownAlready known{MatrixXd::Zero(open.columns(), open.columns()), {parts.begin() + runs, parts.end()}};
  for (int r = 0; r < runs; ++r) known.now += parts[static_cast<std::size_t>(r)];
  const DifferentialDrive& d = joint.model.drive;
  const double prior[kShared] = {
      0.1 * d.wheel_radius_left_m, 0.1 * d.wheel_radius_right_m, 0.1 * d.wheelbase_m, 0.2, 0.2, 0.3};
  for (int c = 0; c < kShared; ++c) known.now(c, c) += 1.0 / (prior[c] * prior[c]);
  return known;
}

// The drive that tells names apart, by the pair that it tells least.
void advise_between(Advice& out, const JointModel& joint, const std::vector<Confusion>& confused, const Open& open,
                    const KnownAlready& known, const std::vector<AdvisedDrive>& all) {
  const std::vector<Decision>& pairs = open.pairs;
  const DrivePlan plan = planned(known.now, known.adds, all, pairs);
  std::size_t least = 0;
  for (std::size_t k = 1; k < pairs.size(); ++k)
    if (plan.reached[k] / pairs[k].needed < plan.reached[least] / pairs[least].needed) least = k;
  const Confusion& between = confused[open.confusion_of[least]];
  const AcceptedEffect& a = joint.accepted[static_cast<std::size_t>(between.accepted)];
  const std::string names = effect_words(a.effect->name) + " from " + effect_words(between.alternative->name);
  if (plan.any && plan.reached[least] >= kWorthDriving * pairs[least].needed) {
    out.next_drive =
        in_words(plan, all) + ": tells " + names +
        formatted(" by %.0f standard deviations, now %.1f", plan.reached[least], separation(known.now, pairs[least]));
    out.next_legs = legs_of(plan, all);
  } else {
    out.next_drive = a.effect->told_apart_by + ": tells " + names;
  }
}

// The drive that would show most of what these recordings could not.
void advise_to_see(Advice& out, const std::vector<Visible>& dark, const Open& open, const KnownAlready& known,
                   const std::vector<AdvisedDrive>& all) {
  constexpr int kMostNames = 4;
  const DrivePlan plan = planned(known.now, known.adds, all, open.sights);
  std::string names;
  int named = 0;
  for (std::size_t k = 0; k < open.sights.size(); ++k)
    if (plan.reached[k] >= 0.9 * open.sights[k].needed && ++named <= kMostNames)
      names += (names.empty() ? "" : ", ") + effect_words(dark[k].effect->name);
  if (plan.any && !names.empty()) {
    out.next_drive = in_words(plan, all) + ": would show " + names + (named > kMostNames ? " and others" : "") +
                     " if there were any";
    out.next_legs = legs_of(plan, all);
  } else {
    out.next_drive = out.not_testable.front().drive_this;
  }
}

}  // namespace

Advice advice(const JointModel& joint, const std::vector<Confusion>& confused, const std::vector<Visible>& dark) {
  Advice out;
  if (dark.empty() && confused.empty()) return out;
  const DrivingRange range = range_of(joint);
  const std::vector<AdvisedDrive> all = advised_drives(range);
  const Open open = open_of(joint, confused, dark);
  const KnownAlready known = known_of(joint, open, all, range);
  for (std::size_t k = 0; k < dark.size(); ++k) {
    const DrivePlan plan = planned(known.now, known.adds, all, {open.sights[k]});
    const bool is_worth_it = plan.any && plan.reached[0] >= kWorthDriving * open.sights[k].needed;
    out.not_testable.push_back(
        {dark[k].effect->name, because_of(dark[k]), is_worth_it ? in_words(plan, all) : dark[k].effect->told_apart_by});
  }
  if (!open.pairs.empty())
    advise_between(out, joint, confused, open, known, all);
  else if (!open.sights.empty())
    advise_to_see(out, dark, open, known, all);
  return out;
}

bool are_most_effects(const std::vector<NotTestable>& not_testable) {
  std::set<std::string> names;
  for (const Effect& e : catalogue())
    if (!e.only_commands) names.insert(e.name);
  return 3 * not_testable.size() > 2 * names.size();
}

}  // namespace odolab
