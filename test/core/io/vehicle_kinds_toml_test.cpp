// Reading and writing of vehicles with links, trailers and castors.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/io/vehicle_toml.h"
#include "core/io/whole_file.h"
#include "source_dir.h"
#include "test/core/io/files.h"

namespace odolab {
namespace {

const std::string kClapper = R"(kind = "clapper"
name = "CLAPPER"
[clapper]
link_length_m = 1.1
encoder_counts_per_revolution = 500
link_angle_resolution_rad = 0.0052
link_length_resolution_m = 0.0001
link_length_offset_m = 0.002
[clapper.truck_a]
wheel_radius_left_m = 0.075
wheel_radius_right_m = 0.076
wheelbase_m = 0.340
[clapper.truck_b]
wheel_radius_left_m = 0.075
wheel_radius_right_m = 0.075
wheelbase_m = 0.341
)";

const std::string kTwoCastors = R"(kind = "multi_castor"
[multi_castor]
wheel_encoder_resolution_rad = 0.00524
pivot_encoder_resolution_rad = 0.00122
[[multi_castor.castor]]
pivot_radius_m = 0.25
pivot_angle_rad = 0.0
offset_m = 0.05
wheel_radius_left_m = 0.05
wheel_radius_right_m = 0.05
wheel_offset_left_m = 0.06
wheel_offset_right_m = 0.06
pivot_encoder_offset_rad = 0.0
[[multi_castor.castor]]
pivot_radius_m = 0.25
pivot_angle_rad = 3.0
offset_m = 0.05
wheel_radius_left_m = 0.05
wheel_radius_right_m = 0.05
wheel_offset_left_m = 0.06
wheel_offset_right_m = 0.07
)";

std::string complaint_of_kind(const std::string& text) {
  ScratchFolder folder;
  const std::string path = folder.write("x.toml", text);
  return message_of(read_vehicle(path), path);
}

std::string text_of(const std::string& path) { return *read_whole_file(path); }

TEST(VehicleKindsToml, ReadTheContractsClapper) {
  ScratchFolder folder;
  const Result<Vehicle> vehicle = read_vehicle(folder.write("x.toml", kClapper));
  ASSERT_TRUE(vehicle.ok()) << vehicle.error().message();
  const Clapper& clapper = std::get<Clapper>(vehicle->kind);
  EXPECT_EQ(clapper.link_length_m, 1.1);
  EXPECT_EQ(clapper.link_length_offset_m, 0.002);
  EXPECT_EQ(clapper.link_angle_a_offset_rad, 0.0);  // 0 where absent
  EXPECT_EQ(clapper.truck_a.wheel_radius_right_m, 0.076);
  EXPECT_EQ(clapper.truck_b.wheelbase_m, 0.341);
  EXPECT_EQ(clapper.truck_b.encoder_counts_per_revolution, 500.0);  // one number for both trucks
}

TEST(VehicleKindsToml, ReadTheContractsCastors) {
  ScratchFolder folder;
  const Result<Vehicle> vehicle = read_vehicle(folder.write("x.toml", kTwoCastors));
  ASSERT_TRUE(vehicle.ok()) << vehicle.error().message();
  const MultiCastor& castors = std::get<MultiCastor>(vehicle->kind);
  ASSERT_EQ(castors.castors.size(), 2u);
  EXPECT_EQ(castors.castors[1].pivot_angle_rad, 3.0);
  EXPECT_EQ(castors.castors[1].wheel_offset_right_m, 0.07);
  EXPECT_EQ(castors.castors[1].pivot_encoder_offset_rad, 0.0);
}

// Writing what was read and reading it again gives the same text: every field goes both ways.
TEST(VehicleKindsToml, EveryKindGoesBothWaysUnchanged) {
  ScratchFolder folder;
  MultiCastor castors = three_castor_vehicle();
  castors.castors[2].pivot_encoder_offset_rad = 0.1 + 0.2;
  Clapper clapper;
  clapper.link_angle_b_offset_rad = 1.0 / 7.0;
  OmniMate omnimate;
  omnimate.truck_b.wheelbase_m = 0.5;
  SynchroDrive synchro;
  synchro.base_turn_rad_per_m = 1e-3;
  Tracked tracked;
  tracked.slip_factor = 1.3;
  EncoderTrailer trailer;
  trailer.trailer.gear_ratio = 2.5;
  SmartEncoderTrailer smart;
  smart.tow.wheelbase_m = 0.337;
  for (const VehicleKind& kind :
       {VehicleKind{synchro}, VehicleKind{tracked}, VehicleKind{clapper}, VehicleKind{omnimate}, VehicleKind{trailer},
        VehicleKind{smart}, VehicleKind{castors}}) {
    Vehicle vehicle;
    vehicle.kind = kind;
    vehicle.truth.axle_T_tracked.x_m = 0.25;
    const std::string first = folder.path("first.toml"), second = folder.path("second.toml");
    ASSERT_TRUE(write_vehicle(first, vehicle).ok());
    const Result<Vehicle> back = read_vehicle(first);
    ASSERT_TRUE(back.ok()) << back.error().message();
    ASSERT_EQ(back->kind.index(), kind.index());
    ASSERT_TRUE(write_vehicle(second, *back).ok());
    EXPECT_EQ(text_of(folder.path("first.toml")), text_of(folder.path("second.toml"))) << kind_name(vehicle);
  }
  EXPECT_NE(text_of(folder.path("first.toml")).find("pivot_encoder_offset_rad = 0.30000000000000004"),
            std::string::npos);
}

TEST(VehicleKindsToml, SayInOneLineWhatIsWrong) {
  EXPECT_EQ(complaint_of_kind(replaced(kClapper, "link_length_offset_m", "link_length_ofset_m")),
            "x.toml:8: found the key 'link_length_ofset_m', expected a known key; the nearest is "
            "'link_length_offset_m'");
  EXPECT_EQ(complaint_of_kind(replaced(kClapper, "wheelbase_m = 0.341", "wheelbase_m = 0")),
            "x.toml:16: clapper.truck_b.wheelbase_m: found 0, expected a length in metres above 0");
  EXPECT_EQ(complaint_of_kind(kClapper.substr(0, kClapper.find("[clapper.truck_b]"))),
            "x.toml:3: found no table [clapper.truck_b], expected it to be given");
  EXPECT_EQ(complaint_of_kind("kind = \"encoder_trailer\"\n[encoder_trailer]\n"),
            "x.toml:2: found no key 'hitch_offset_m', no key 'drawbar_length_m', no table [encoder_trailer.tow], no "
            "table [encoder_trailer.trailer], expected them to be given");
  EXPECT_EQ(complaint_of_kind(replaced(kTwoCastors, "offset_m = 0.05", "offset = 0.05")).substr(0, 34),
            "x.toml:8: found the key 'offset', ");
  EXPECT_EQ(
      complaint_of_kind(replaced(kTwoCastors, "pivot_angle_rad = 3.0", "pivot_angle_rad = 0.0")),
      "x.toml:15: multi_castor.castor[2].pivot_radius_m: found the place of castor 1, expected a place of its own");
}

TEST(VehicleKindsToml, AllVehiclesThatComeAlongAreRead) {
  int read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ODOLAB_SOURCE_DIR "/assets/vehicles")) {
    const Result<Vehicle> vehicle = read_vehicle(entry.path().string());
    EXPECT_TRUE(vehicle.ok()) << vehicle.error().message();
    ++read;
  }
  EXPECT_GE(read, 10);
}

}  // namespace
}  // namespace odolab
