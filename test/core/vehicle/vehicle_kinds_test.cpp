#include <gtest/gtest.h>

#include <cmath>

#include "core/vehicle/vehicle.h"

namespace odolab {
namespace {

TEST(VehicleKinds, AreSoundAsTheyStand) {
  EXPECT_TRUE(problems_in(VehicleKind{SynchroDrive{}}).empty());
  EXPECT_TRUE(problems_in(VehicleKind{Tracked{}}).empty());
  EXPECT_TRUE(problems_in(VehicleKind{Clapper{}}).empty());
  EXPECT_TRUE(problems_in(VehicleKind{OmniMate{}}).empty());
  EXPECT_TRUE(problems_in(VehicleKind{EncoderTrailer{}}).empty());
  EXPECT_TRUE(problems_in(VehicleKind{SmartEncoderTrailer{}}).empty());
  EXPECT_TRUE(problems_in(VehicleKind{three_castor_vehicle()}).empty());
}

TEST(VehicleKinds, HaveTheContractsNames) {
  Vehicle vehicle;
  EXPECT_EQ(kind_name(vehicle), "differential_drive");
  vehicle.kind = three_castor_vehicle();
  EXPECT_EQ(kind_name(vehicle), "multi_castor");
}

TEST(VehicleKinds, NameTheKeyThatIsWrong) {
  Clapper clapper;
  clapper.truck_b.wheelbase_m = 0.0;
  clapper.link_length_m = std::nan("");
  std::vector<std::string> problems = problems_in(VehicleKind{clapper});
  ASSERT_EQ(problems.size(), 3u);  // the offset's bound is a share of the length
  EXPECT_EQ(problems[0], "link_length_m: found nan, expected a length in metres above 0");
  EXPECT_EQ(problems[2], "truck_b.wheelbase_m: found 0, expected a length in metres above 0");

  MultiCastor castors = three_castor_vehicle();
  castors.castors[1].wheel_radius_left_m = -1.0;
  castors.castors[2].pivot_angle_rad = castors.castors[0].pivot_angle_rad;
  problems = problems_in(VehicleKind{castors});
  ASSERT_EQ(problems.size(), 2u);
  EXPECT_EQ(problems[0], "castor[2].wheel_radius_left_m: found -1, expected a length in metres above 0");
  EXPECT_EQ(problems[1], "castor[3].pivot_radius_m: found the place of castor 1, expected a place of its own");
  castors.castors.resize(1);
  problems = problems_in(VehicleKind{castors});
  ASSERT_FALSE(problems.empty());
  EXPECT_EQ(problems[0], "castor: found 1, expected two castors or more");
}

TEST(VehicleKinds, SayWhatOnlyADifferentialDriveCanDo) {
  Vehicle vehicle;
  EXPECT_FALSE(other_than_differential_drive(vehicle, "can be diagnosed"));
  vehicle.name = "CLAPPER";
  vehicle.kind = Clapper{};
  EXPECT_EQ(other_than_differential_drive(vehicle, "can be diagnosed")->message(),
            "CLAPPER: kind: found 'clapper', expected 'differential_drive', the only kind that can be diagnosed");
}

}  // namespace
}  // namespace odolab
