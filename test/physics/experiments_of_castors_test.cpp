// The experiments in kinematics, on few cases: that they run, and that what they say of the physics holds.
#include <gtest/gtest.h>

#include <algorithm>

#include "physics/experiments/experiment.h"

namespace odolab {
namespace {

ExperimentReport report_of(const std::string& name, int cases) {
  for (const Experiment& experiment : experiments())
    if (experiment.name == name) return *experiment.run({.seed = 3, .cases = cases}, {});
  ADD_FAILURE() << name;
  return {};
}

double figure(const ExperimentReport& report, const std::string& name) {
  for (const Figure& f : report.figures)
    if (f.name == name) return f.ours;
  ADD_FAILURE() << name;
  return 0.0;
}

TEST(CastorCalibrationExperiment, ImprovesEveryParameter) {
  const ExperimentReport report = report_of("castor-calibration", 5);
  EXPECT_TRUE(succeeded(report));
  for (const char* parameter : {"r_w", "d", "beta"}) {
    const std::string name = std::string("mean error of ") + parameter;
    EXPECT_LT(figure(report, name + ", calibrated"), 0.25 * figure(report, name + ", as built"));
  }
}

// With exact parameters all that is left is the integration: printed, some 60 mm; correct, a tenth of that.
TEST(CastorUmbmarkExperiment, ShowsThatTableTwoIsTheIntegrationsError) {
  const ExperimentReport report = report_of("castor-umbmark", 2);
  EXPECT_GT(figure(report, "Emax CAST-1, exact parameters, integrated as the paper"), 50.0);
  EXPECT_LT(figure(report, "Emax CAST-1, exact parameters, integrated correctly"), 10.0);
}

TEST(CastorRejectionExperiment, FindsTheSlippingCastorAndSuspectsNoOther) {
  EXPECT_TRUE(succeeded(report_of("castor-rejection", 6)));
}

TEST(IpecUnconnectedExperiment, CorrectsHeadingsBySightAlone) {
  const ExperimentReport report = report_of("ipec-unconnected", 4);
  // ten bumps of 0.59 degrees, seen with noise of 0.3
  EXPECT_NEAR(figure(report, "heading error with ten bumps, each robot alone"), 5.9, 0.5);
  EXPECT_LT(figure(report, "heading error with ten bumps, IPEC"), 0.9);
}

}  // namespace
}  // namespace odolab
