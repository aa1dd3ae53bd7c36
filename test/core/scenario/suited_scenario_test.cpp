#include "core/scenario/suited_scenario.h"

#include <gtest/gtest.h>

#include "core/scenario/machine_parameters.h"

namespace odolab {
namespace {

std::vector<VehicleKind> all_kinds() {
  EncoderTrailer trailer;
  trailer.tow = as_differential_drive(Tracked{});
  return {DifferentialDrive{},   SynchroDrive{},        Tracked{}, Clapper{}, OmniMate{}, trailer,
          SmartEncoderTrailer{}, three_castor_vehicle()};
}

TEST(SuitedScenario, HasNoProblemsFromAnyKindToAnyOther) {
  for (const VehicleKind& first : all_kinds())
    for (const VehicleKind& second : all_kinds()) {
      Vehicle before, after;
      before.kind = first;
      after.kind = second;
      Scenario scenario = with_vehicle(Scenario{}, before);
      if (moves_sideways(first)) scenario.path = ManoeuvrePath{{{1.0, 0.5, 0.0}}};
      if (std::holds_alternative<DifferentialDrive>(first)) scenario.benchmark = Benchmark{};
      ASSERT_TRUE(problems_in(scenario).empty()) << problems_in(scenario).front();
      const Scenario other = with_vehicle(scenario, after);
      EXPECT_TRUE(problems_in(other).empty())
          << kind_name(before) << " to " << kind_name(after) << ": " << problems_in(other).front();
    }
}

TEST(SuitedScenario, KeepsFloorAndPathWhereTheVehicleCanDriveThem) {
  Scenario scenario;
  scenario.floor.bumps.push_back({});
  scenario.path = SquarePath{2.0, true};
  Vehicle clapper;
  clapper.kind = Clapper{};
  const Scenario suited = with_vehicle(scenario, clapper);
  EXPECT_EQ(suited.floor.bumps.size(), 1u);
  EXPECT_EQ(std::get<SquarePath>(suited.path).side_m, 2.0);
}

TEST(VehicleParameters, AreAlikeForNominalAndTrueAndWriteThroughToTheVehicle) {
  for (const VehicleKind& kind : all_kinds()) {
    VehicleKind one = kind, other = kind;
    const auto list = parameters_of(one);
    ASSERT_EQ(list.size(), parameters_of(other).size());
    ASSERT_FALSE(list.empty());
    for (const VehicleParameter& p : list) {
      EXPECT_FALSE(p.label.empty());
      EXPECT_FALSE(p.about.empty());
    }
    *list.front().value *= 1.25;
    VehicleKind changed = one;
    EXPECT_DOUBLE_EQ(*parameters_of(changed).front().value, 1.25 * *parameters_of(other).front().value);
  }
}

}  // namespace
}  // namespace odolab
