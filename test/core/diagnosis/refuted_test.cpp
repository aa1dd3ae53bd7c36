#include "core/diagnosis/refuted.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/io/diagnosis_json.h"
#include "core/io/diagnosis_text.h"
#include "core/io/verdict_sentence.h"
#include "test/support/diagnosis_by_hand.h"

namespace odolab {
namespace {

nlohmann::json refuted_by(const Diagnosis& d) {
  return nlohmann::json::parse(to_text(diagnosis_json(d)))["refuted_by"];
}

FitFigures off_by(double position_m, double heading_rad) { return {position_m, heading_rad, 1.0}; }

TEST(RefutedAnswer, IsOneThatPredictsUnseenRunsWorse) {
  Diagnosis d = test::diagnosis_by_hand();
  d.held_out.calibrated = off_by(0.010, 0.010);
  d.held_out.with_findings = off_by(0.006, 0.010);
  EXPECT_FALSE(is_refuted_by_unseen(d));
  d.held_out.with_findings = off_by(0.012, 0.010);
  EXPECT_TRUE(is_refuted_by_unseen(d));
  EXPECT_NE(verdict_sentence(d).find("what was held out does not bear it out"), std::string::npos);
  EXPECT_EQ(refuted_by(d), nlohmann::json({"held_out"}));
  d.held_out.with_findings = off_by(0.012, 0.004);  // headings are what it is about
  EXPECT_FALSE(is_refuted_by_unseen(d));
}

TEST(RefutedAnswer, IsOneThatTheSimulatorDoesNotFollow) {
  Diagnosis d = test::diagnosis_by_hand();
  d.simulation.calibrated = off_by(0.010, 0.010);
  d.simulation.with_findings = off_by(0.020, 0.010);
  EXPECT_TRUE(is_refuted_by_simulator(d));
  EXPECT_NE(verdict_sentence(d).find("the simulator does not bear it out"), std::string::npos);
  d.findings.front().effect = "slip_zone";
  EXPECT_TRUE(is_refuted_by_simulator(d));
  d.findings.front().form = 1;  // by where the axle's middle is, as the simulator plays it too
  EXPECT_TRUE(is_refuted_by_simulator(d));
  d.findings.front().form = 3;  // which no effect has
  EXPECT_FALSE(is_refuted_by_simulator(d));
  d.findings.clear();
  EXPECT_FALSE(is_refuted_by_simulator(d));
}

TEST(RefutedAnswer, IsNoneWhereTheSimulatorCannotPlayWhatWasFound) {
  Diagnosis d = test::diagnosis_by_hand();
  d.simulation.calibrated = off_by(0.010, 0.010);
  d.simulation.with_findings = off_by(0.020, 0.010);
  Finding& step = d.findings.front();
  step.effect = "bump";
  step.component = "left_wheel";
  step.parameters = {{"extra_distance_m", 0.03, 0.001, "m"}, {"at_s", 12.0, 0.0, "s"}};
  EXPECT_TRUE(beyond_the_simulator(d).empty());
  EXPECT_TRUE(is_refuted_by_simulator(d));
  step.parameters.front().value = 0.12;  // more than a wheel climbs there
  EXPECT_EQ(beyond_the_simulator(d).size(), 1u);
  EXPECT_FALSE(is_refuted_by_simulator(d));
  EXPECT_EQ(verdict_sentence(d).find("bear it out"), std::string::npos);
  const std::vector<std::string> lines = summary_lines(d, 60, 100);
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
    return line.find("neither confirms nor refutes: it cannot play bump of the left wheel") != std::string::npos;
  }));
}

TEST(RefutedAnswer, IsNoneWhereTheSimulatorGoesOtherWaysAnyhow) {
  Diagnosis d = test::diagnosis_by_hand();
  d.train.calibrated = off_by(0.005, 0.005);
  d.simulation.calibrated = off_by(0.050, 0.2);  // castors that turned over to another side
  d.simulation.with_findings = off_by(0.100, 0.2);
  EXPECT_FALSE(simulator_follows(d));
  EXPECT_FALSE(is_refuted_by_simulator(d));
  d.held_out.calibrated = off_by(0.030, 0.15);  // the simulator drives these, too, and the model errs there as well
  EXPECT_TRUE(simulator_follows(d));
  d.left_out_in_turn = true;  // they are the same recordings
  EXPECT_FALSE(simulator_follows(d));
  d.simulation.calibrated = off_by(0.050, 0.006);  // what is missing alone may take it so far
  EXPECT_TRUE(simulator_follows(d));
}

}  // namespace
}  // namespace odolab
