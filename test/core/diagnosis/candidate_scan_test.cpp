#include "core/diagnosis/model/candidate_scan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test/support/missing_physics.h"

namespace odolab {
namespace {

JointModel model_with(const Effect& accepted, test::CaseSettings::Truth truth) {
  test::CaseSettings settings;
  settings.runs = 2;
  settings.duration_s = 30.0;
  settings.truth = truth;
  const test::Case c = test::generated_case(settings, 12);
  std::vector<InnovationRun> runs;
  for (const Recording& r : c.recordings) runs.push_back(*innovation_run(r, c.nominal));
  runs[1].set_aside[runs[1].set_aside.size() / 2] = 1;  // a sample that is not used
  const LeastSquaresCalibration start = *calibrate_least_squares(c.recordings, c.nominal);
  JointModel joint(std::move(runs), std::vector<char>(c.recordings.size(), 0), start, c.nominal);
  joint.accepted.push_back({&accepted, {}, {0.5 * accepted.amplitudes[0].medium}});
  joint.linearise();
  joint.linearise();
  return joint;
}

const Effect& lateral_slip() {
  for (const Effect& e : catalogue())
    if (e.name == "lateral_slip" && e.shapes.empty() && e.forms.size() < 2 && e.amplitudes.size() == 1) return e;
  for (const Effect& e : catalogue())
    if (e.shapes.empty() && e.forms.size() < 2 && e.amplitudes.size() == 1 && !e.clock_rate) return e;
  return catalogue().front();
}

// Every entry of the catalogue at a few of its shapes: the same as from columns that are written down, which end where
// a millionth of the largest is left; a difference of two products that are nearly absorbed shows the thousandfold.
void expect_the_same(const JointModel& joint, int without) {
  const CandidateScan scan(joint, without);
  int asked = 0;
  for (const Effect& e : catalogue()) {
    if (e.only_commands) continue;
    std::vector<std::vector<double>> shapes{{}};
    if (e.scan) shapes = e.scan(joint.views());
    for (std::size_t k = 0; k < 3 && !shapes.empty(); ++k) {
      std::vector<double> shape = shapes[(2 * k + 1) * shapes.size() / 6];
      if (e.forms.size() > 1) shape.push_back(static_cast<double>(k % e.forms.size()));
      const CandidateTest quick = scan.test(e, shape), slow = joint.test(joint.columns_of(e, shape), without);
      if (e.local && e.of_one_recording && !joint.is_well_inside(static_cast<int>(shape[0]), shape[1])) {
        EXPECT_TRUE(quick.value.empty()) << "nothing happens at the edge of what was recorded";
        continue;
      }
      ASSERT_EQ(quick.value.size(), slow.value.size()) << e.name;
      EXPECT_NEAR(quick.statistic, slow.statistic, 1e-4 + 1e-4 * slow.statistic) << e.name << " " << k;
      EXPECT_NEAR(quick.survives, slow.survives, 1e-5) << e.name << " " << k;
      for (std::size_t j = 0; j < slow.value.size(); ++j)
        EXPECT_NEAR(quick.value[j], slow.value[j], 1e-3 * slow.stderr_value[j]) << e.name << " " << k;
      asked += quick.value.empty() ? 0 : 1;
    }
  }
  EXPECT_GT(asked, 30);
}

TEST(CandidateScan, SaysWhatTheColumnsSay) {
  expect_the_same(model_with(lateral_slip(), test::CaseSettings::Truth::mocap), -1);
}

TEST(CandidateScan, SaysWhatTheColumnsSayWithAnEffectTakenOut) {
  expect_the_same(model_with(lateral_slip(), test::CaseSettings::Truth::mocap), 0);
}

TEST(CandidateScan, SaysWhatTheColumnsSayWhereTheTruthHasNoHeadings) {
  expect_the_same(model_with(lateral_slip(), test::CaseSettings::Truth::coarse_without_heading), -1);
}

// Shapes are asked four abreast, over all the time that any of the four lasts, and remembered: that rounds otherwise,
// in the last places of products that nearly cancel.
TEST(CandidateScan, SaysTheSameOfAShapeWhateverElseIsAsked) {
  const JointModel joint = model_with(lateral_slip(), test::CaseSettings::Truth::mocap);
  JointModel again = joint;
  again.linearise();
  JointModel apart = joint;
  apart.linearise();  // as `again`, and remembers nothing yet
  const CandidateScan together(again), without(again, 0), alone(apart);
  int asked = 0;
  for (const Effect& e : catalogue()) {
    if (e.only_commands || !e.scan) continue;
    std::vector<std::vector<double>> shapes = e.scan(again.views());
    shapes.resize(std::min<std::size_t>(shapes.size(), 7));  // a whole group and three left over
    for (std::vector<double>& shape : shapes)
      if (e.forms.size() > 1) shape.push_back(0.0);
    const std::vector<CandidateTest> all = together.tests(e, shapes), once_more = together.tests(e, shapes);
    const std::vector<CandidateTest> taken_out = without.tests(e, shapes);
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      const CandidateTest one = alone.test(e, shapes[k]);
      ASSERT_EQ(all[k].value.size(), one.value.size()) << e.name;
      EXPECT_NEAR(all[k].statistic, one.statistic, 1e-6 + 1e-6 * one.statistic) << e.name << " " << k;
      EXPECT_EQ(all[k].statistic, once_more[k].statistic) << e.name << " " << k;
      const CandidateTest slow = again.test(again.columns_of(e, shapes[k]), 0);
      if (taken_out[k].value.empty()) continue;
      EXPECT_NEAR(taken_out[k].statistic, slow.statistic, 1e-4 + 1e-4 * slow.statistic) << e.name << " " << k;
      ++asked;
    }
  }
  EXPECT_GT(asked, 20);
}

}  // namespace
}  // namespace odolab
