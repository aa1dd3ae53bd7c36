#include <gtest/gtest.h>

#include <algorithm>

#include "app/cli/run/outputs.h"

namespace odolab {
namespace {

// A perfect robot returns to within a tenth of a millimetre before and after: no number of times is better or worse.
TEST(UmbmarkOutputs, OfARobotWithoutErrorsFindNothingBetterNorWorse) {
  Scenario scenario;
  scenario.path = SquarePath{1.0, false};
  scenario.sensors.truth_period_s = 0.0;
  scenario.benchmark = Benchmark{1, false};
  const Result<RunOutputs> out = umbmark_outputs(scenario, 1, {});
  ASSERT_TRUE(out) << out.error().message();
  for (const auto& [name, value] : out->figures)
    if (name == "improvement") {
      EXPECT_EQ(value, 1.0);
    }
  for (const std::string& sentence : out->sentences) EXPECT_EQ(sentence.find("That is"), std::string::npos) << sentence;
}

}  // namespace
}  // namespace odolab
