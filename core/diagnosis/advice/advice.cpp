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

// Columns in question: those of effects that were let in, and of candidates.
struct Question {
  const Effect* effect = nullptr;
  std::vector<double> shape;
};

// Information on the six shared parameters and on all columns in question, the clock of the run projected off.
MatrixXd information(const JointModel& joint, int run, const std::vector<Question>& questions) {
  const LinearisedRun& linear = joint.linearised()[static_cast<std::size_t>(run)];
  const int rows = 3 * linear.samples();
  int q = 7;
  for (const Question& c : questions) q += static_cast<int>(c.effect->amplitudes.size());
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
      at += static_cast<int>(c.effect->amplitudes.size());
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

}  // namespace

Advice advice(const JointModel& joint, const std::vector<Confusion>& confused, const std::vector<Visible>& dark) {
  Advice out;
  if (dark.empty() && confused.empty()) return out;

  const DrivingRange range = range_of(joint);
  const std::vector<AdvisedDrive> all = advised_drives(range);
  std::vector<Question> questions;
  std::vector<int> first_column;
  int columns = 6;
  const auto ask = [&](const Effect* effect, const std::vector<double>& shape) {
    questions.push_back({effect, shape});
    first_column.push_back(columns);
    columns += static_cast<int>(effect->amplitudes.size());
  };
  std::vector<int> shared{0, 1, 2, 3, 4, 5};  // what any decision has to do without
  for (const AcceptedEffect& a : joint.accepted) ask(a.effect, a.shape);
  const std::size_t known_effects = questions.size();
  for (const Confusion& c : confused) ask(c.alternative, c.shape);
  // Beaten in the form that fits best, a name would come back in another.
  std::vector<std::pair<std::size_t, std::size_t>> other_forms;  // confusion, question
  for (std::size_t k = 0; k < confused.size(); ++k) {
    const AcceptedEffect& own = joint.accepted[static_cast<std::size_t>(confused[k].accepted)];
    for (std::size_t form = 0; form < own.effect->forms.size(); ++form) {
      std::vector<double> shape = own.shape;
      if (shape.back() == static_cast<double>(form) || confused[k].value.empty()) continue;
      shape.back() = static_cast<double>(form);
      other_forms.emplace_back(k, questions.size());
      ask(own.effect, shape);
    }
  }
  for (const Visible& v : dark) ask(v.effect, v.shape);

  const JointModel drives = imagined(joint, all, range);
  const int runs = static_cast<int>(joint.runs().size()), count = runs + static_cast<int>(all.size());
  std::vector<MatrixXd> parts(static_cast<std::size_t>(count));
  parallel_for(count, [&](int i) {
    if (i < runs) {
      parts[i] = information(joint, i, questions);
      return;
    }
    std::vector<Question> elsewhere = questions;  // neither events nor places come back
    for (Question& q : elsewhere) {
      if (q.effect->of_one_recording || q.effect->and_later_recordings || q.effect->local) q.shape[0] = 1e6;
    }
    parts[i] = information(drives, i - runs, elsewhere);
  });
  MatrixXd known = MatrixXd::Zero(columns, columns);
  for (int r = 0; r < runs; ++r) known += parts[r];
  const DifferentialDrive& d = joint.model.drive;
  const double prior[6] = {
      0.1 * d.wheel_radius_left_m, 0.1 * d.wheel_radius_right_m, 0.1 * d.wheelbase_m, 0.2, 0.2, 0.3};
  for (int c = 0; c < 6; ++c) known(c, c) += 1.0 / (prior[c] * prior[c]);
  const std::vector<MatrixXd> adds(parts.begin() + runs, parts.end());

  const auto columns_of = [&](std::size_t question) {
    std::vector<int> c;
    for (std::size_t k = 0; k < questions[question].effect->amplitudes.size(); ++k)
      c.push_back(first_column[question] + static_cast<int>(k));
    return c;
  };
  // Two names: the one fitted, told from the best that the other can do.
  std::vector<Decision> pairs;
  for (std::size_t k = 0; k < confused.size(); ++k) {
    const auto a = static_cast<std::size_t>(confused[k].accepted);
    Decision decision;
    decision.from = first_column[a];
    decision.value = Eigen::Map<const VectorXd>(joint.accepted[a].value.data(),
                                                static_cast<Eigen::Index>(joint.accepted[a].value.size()));
    decision.free = shared;
    for (std::size_t other = 0; other < known_effects; ++other)
      if (other != a)
        for (int c : columns_of(other)) decision.free.push_back(c);
    for (int c : columns_of(known_effects + k)) decision.free.push_back(c);
    decision.inflation = confused[k].inflation;
    decision.needed = std::sqrt(2.0 * kClearlyBeaten) + kPower;
    pairs.push_back(decision);
  }
  // The alternative, were it the one, told from the fitted name in another form.
  for (const auto& [k, question] : other_forms) {
    const auto a = static_cast<std::size_t>(confused[k].accepted);
    Decision decision = pairs[k];
    decision.from = first_column[known_effects + k];
    decision.value =
        Eigen::Map<const VectorXd>(confused[k].value.data(), static_cast<Eigen::Index>(confused[k].value.size()));
    decision.free = shared;
    for (std::size_t other = 0; other < known_effects; ++other)
      if (other != a)
        for (int c : columns_of(other)) decision.free.push_back(c);
    for (int c : columns_of(question)) decision.free.push_back(c);
    pairs.push_back(decision);
  }
  // An effect of medium size, told from none.
  std::vector<Decision> sights;
  for (std::size_t k = 0; k < dark.size(); ++k) {
    const std::size_t question = known_effects + confused.size() + other_forms.size() + k;
    const Effect& e = *dark[k].effect;
    Decision decision;
    decision.from = first_column[question] + dark[k].weakest;
    decision.value = VectorXd::Constant(1, e.amplitudes[static_cast<std::size_t>(dark[k].weakest)].medium);
    decision.free = shared;
    for (std::size_t other = 0; other < known_effects; ++other)
      for (int c : columns_of(other)) decision.free.push_back(c);
    for (int c : columns_of(question))
      if (c != decision.from) decision.free.push_back(c);
    decision.inflation = dark[k].inflation;
    decision.needed = dark[k].standard;
    sights.push_back(decision);
  }

  for (std::size_t k = 0; k < dark.size(); ++k) {
    NotTestable n;
    n.effect = dark[k].effect->name;
    n.because = because_of(dark[k]);
    const DrivePlan plan = planned(known, adds, all, {sights[k]});
    n.drive_this =
        plan.any && plan.reached[0] >= 0.7 * sights[k].needed ? in_words(plan, all) : dark[k].effect->told_apart_by;
    out.not_testable.push_back(n);
  }
  if (!pairs.empty()) {
    const DrivePlan plan = planned(known, adds, all, pairs);
    std::size_t least = 0;
    for (std::size_t k = 1; k < pairs.size(); ++k)
      if (plan.reached[k] / pairs[k].needed < plan.reached[least] / pairs[least].needed) least = k;
    const Confusion& between = confused[least < confused.size() ? least : other_forms[least - confused.size()].first];
    const AcceptedEffect& a = joint.accepted[static_cast<std::size_t>(between.accepted)];
    const std::string names = effect_words(a.effect->name) + " from " + effect_words(between.alternative->name);
    if (plan.any && plan.reached[least] >= 0.7 * pairs[least].needed) {
      out.next_drive =
          in_words(plan, all) + ": tells " + names +
          formatted(" by %.0f standard deviations, now %.1f", plan.reached[least], separation(known, pairs[least]));
      out.next_legs = legs_of(plan, all);
    } else {
      out.next_drive = a.effect->told_apart_by + ": tells " + names;
    }
  } else if (!sights.empty()) {
    const DrivePlan plan = planned(known, adds, all, sights);
    std::string names;
    int named = 0;
    for (std::size_t k = 0; k < sights.size(); ++k)
      if (plan.reached[k] >= 0.9 * sights[k].needed && ++named <= 4)
        names += (names.empty() ? "" : ", ") + effect_words(dark[k].effect->name);
    if (plan.any && !names.empty()) {
      out.next_drive =
          in_words(plan, all) + ": would show " + names + (named > 4 ? " and others" : "") + " if there were any";
      out.next_legs = legs_of(plan, all);
    } else {
      out.next_drive = out.not_testable.front().drive_this;
    }
  }
  return out;
}

bool are_most_effects(const std::vector<NotTestable>& not_testable) {
  std::set<std::string> names;
  for (const Effect& e : catalogue())
    if (!e.only_commands) names.insert(e.name);
  return 3 * not_testable.size() > 2 * names.size();
}

}  // namespace odolab
