#include "core/io/vehicle_toml.h"

#include "core/io/file_kind.h"
#include "test/core/io/files.h"

namespace odolab {
namespace {

constexpr const char* kLabMate =
    "kind = \"differential_drive\"\n"
    "name = \"LabMate\"\n"
    "\n"
    "[differential_drive]\n"
    "wheel_radius_left_m = 0.075\n"
    "wheel_radius_right_m = 0.0751\n"
    "wheelbase_m = 0.340\n"
    "encoder_counts_per_revolution = 2000\n";

std::string complaint(const std::string& text) {
  ScratchFolder folder;
  const std::string path = folder.write("x.toml", text);
  return message_of(read_vehicle(path), path);
}

TEST(VehicleToml, ReadsTheContractsExample) {
  ScratchFolder folder;
  const Result<Vehicle> vehicle = read_vehicle(folder.write("x.toml", kLabMate));
  ASSERT_TRUE(vehicle.ok()) << vehicle.error().message();
  EXPECT_EQ(vehicle->name, "LabMate");
  const auto& drive = std::get<DifferentialDrive>(vehicle->kind);
  EXPECT_EQ(drive.wheel_radius_right_m, 0.0751);
  EXPECT_EQ(drive.encoder_counts_per_revolution, 2000.0);
  EXPECT_EQ(drive.gear_ratio, 1.0);
}

TEST(VehicleToml, SaysWhatAFileIsThatIsNoVehicles) {
  EXPECT_EQ(complaint("name = \"a square\"\n[path]\nkind = \"square\"\n"),
            "x.toml: found a scenario's file, expected a vehicle's file");
  EXPECT_EQ(complaint("lesson = \"dead reckoning\"\n"), "x.toml: found a lesson's file, expected a vehicle's file");
  EXPECT_EQ(complaint("time_s,left_wheel_rad,right_wheel_rad\n0,0,0\n"),
            "x.toml: found a recording, expected a vehicle's file");
  EXPECT_EQ(complaint("name = \"LabMate\"\n"), "x.toml: found no key 'kind', expected it to be given");
}

// Its sprockets may be called wheels, as a differential drive's are.
TEST(VehicleToml, ReadsATrackedVehicleByTheNamesOfADifferentialDrive) {
  ScratchFolder folder;
  const std::string path = folder.write("x.toml",
                                        "kind = \"tracked\"\n[tracked]\nwheel_radius_left_m = 0.081\n"
                                        "wheel_radius_right_m = 0.08\nwheelbase_m = 0.47\n");
  const Result<Vehicle> vehicle = read_vehicle(path);
  ASSERT_TRUE(vehicle.ok()) << vehicle.error().message();
  const auto& tracked = std::get<Tracked>(vehicle->kind);
  EXPECT_EQ(tracked.sprocket_radius_left_m, 0.081);
  EXPECT_EQ(tracked.track_width_m, 0.47);
}

TEST(VehicleToml, RoundTripKeepsEveryBit) {
  ScratchFolder folder;
  Vehicle vehicle;
  vehicle.name = "a \"quoted\" \\ name\nin two lines, \xC3\xA9";
  DifferentialDrive drive;
  drive.wheel_radius_left_m = 0.1 + 0.2;
  drive.wheel_radius_right_m = 1.0 / 3.0;
  drive.wheelbase_m = 1e-7;
  drive.encoder_counts_per_revolution = 64;
  drive.gear_ratio = 43.7;
  drive.counter_bits = 16;
  vehicle.kind = drive;
  vehicle.truth = {{0.1, -0.2, 3.0}, 1.0 / 7.0};
  const std::string path = folder.path("x.toml");
  ASSERT_TRUE(write_vehicle(path, vehicle).ok());
  const Result<Vehicle> back = read_vehicle(path);
  ASSERT_TRUE(back.ok()) << back.error().message();
  const auto& is = std::get<DifferentialDrive>(back->kind);
  EXPECT_EQ(back->name, vehicle.name);
  EXPECT_EQ(is.wheel_radius_left_m, drive.wheel_radius_left_m);
  EXPECT_EQ(is.wheel_radius_right_m, drive.wheel_radius_right_m);
  EXPECT_EQ(is.wheelbase_m, drive.wheelbase_m);
  EXPECT_EQ(is.encoder_counts_per_revolution, 64.0);
  EXPECT_EQ(is.gear_ratio, 43.7);
  EXPECT_EQ(is.counter_bits, 16);
  EXPECT_EQ(back->truth.axle_T_tracked.x_m, 0.1);
  EXPECT_EQ(back->truth.axle_T_tracked.y_m, -0.2);
  EXPECT_EQ(back->truth.axle_T_tracked.heading_rad, 3.0);
  EXPECT_EQ(back->truth.time_offset_s, 1.0 / 7.0);
}

TEST(VehicleToml, SaysInOneLineWhatIsWrong) {
  EXPECT_EQ(complaint(replaced(kLabMate, "wheelbase_m = 0.340", "wheelbase_m = 0.340\nwheel_bse_m = 0.34")),
            "x.toml:8: found the key 'wheel_bse_m', expected a known key; the nearest is 'wheelbase_m'");
  EXPECT_EQ(
      complaint(std::string(kLabMate) + "wheel_radius_rigt_m = 0.07\n"),
      "x.toml:9: found the key 'wheel_radius_rigt_m', expected a known key; the nearest is 'wheel_radius_right_m'");
  EXPECT_EQ(complaint(replaced(kLabMate, "wheelbase_m = 0.340", "wheel_bse_m = 0.34")),
            "x.toml:7: found the key 'wheel_bse_m', expected a known key; the nearest is 'wheelbase_m'");
  EXPECT_EQ(complaint(replaced(kLabMate, "name", "colour = \"red\"\nname")),
            "x.toml:2: found the key 'colour', expected a known key: kind, name, differential_drive or truth_mounting");
  EXPECT_EQ(complaint(replaced(kLabMate, "0.075\n", "0\n")),
            "x.toml:5: differential_drive.wheel_radius_left_m: found 0, expected a length in metres above 0");
  EXPECT_EQ(complaint(replaced(kLabMate, "0.340", "\"wide\"")),
            "x.toml:7: wheelbase_m: found 'wide', expected a number");
  EXPECT_EQ(complaint(replaced(kLabMate, "0.340", "inf")),
            "x.toml:7: wheelbase_m: found an infinity, expected a number");
  EXPECT_EQ(
      complaint(replaced(kLabMate, "differential_drive", "hovercraft")),
      "x.toml:1: kind: found 'hovercraft', expected differential_drive, synchro_drive, tracked, clapper, omnimate, "
      "encoder_trailer, smart_encoder_trailer or multi_castor");
  EXPECT_EQ(complaint(replaced(kLabMate, "kind = \"differential_drive\"\n", "")),
            "x.toml: found no key 'kind', expected it to be given");
  EXPECT_EQ(complaint("kind = \"differential_drive\"\n"),
            "x.toml: found no table [differential_drive], expected it to be given");
  EXPECT_EQ(complaint(std::string(kLabMate) + "counter_bits = 70\n"),
            "x.toml:9: differential_drive.counter_bits: found 70, expected 0 (never wraps) to 62");
  EXPECT_EQ(complaint(std::string(kLabMate) + "counter_bits = 1.5\n"),
            "x.toml:9: counter_bits: found 1.5, expected a whole number");
  EXPECT_EQ(complaint(""), "x.toml: found an empty file, expected TOML keys");
}

TEST(VehicleToml, NoticesBrokenToml) {
  const std::string cut_off = complaint("kind = \"differential_drive\"\n[differential_drive]\nwheel_radius_left_m = ");
  EXPECT_EQ(cut_off.substr(0, 29), "x.toml:3: found broken TOML (");
  EXPECT_EQ(cut_off.find('\n'), std::string::npos);
  EXPECT_EQ(complaint("kind = \"differential_drive\"\n[differential_dr").substr(0, 29),
            "x.toml:2: found broken TOML (");
  EXPECT_EQ(complaint("name = \"a\"\nname = \"b\"\n").substr(0, 29), "x.toml:2: found broken TOML (");
}

TEST(VehicleToml, WritesNoVehicleThatHasProblems) {
  ScratchFolder folder;
  Vehicle vehicle;
  std::get<DifferentialDrive>(vehicle.kind).wheelbase_m = -1.0;
  const std::string path = folder.path("x.toml");
  EXPECT_EQ(message_of(write_vehicle(path, vehicle), path),
            "x.toml: wheelbase_m: found -1, expected a length in metres above 0");
  EXPECT_EQ(folder.files(), 0u);
}

TEST(FileKind, IsSeenByContent) {
  ScratchFolder folder;
  EXPECT_EQ(file_kind(folder.write("a.txt", kLabMate)), FileKind::vehicle);
  EXPECT_EQ(file_kind(folder.write("b.txt", "# a square\nname = \"square\"\n[path]\nkind = \"square\"\n")),
            FileKind::scenario);
  EXPECT_EQ(file_kind(folder.write("c.txt", "\xEF\xBB\xBFtime_s,left_ticks\n")), FileKind::recording);
  EXPECT_EQ(file_kind(folder.write("d.txt", "0,0,0,0,0,0\n0.05,0,0,0,1,2\n")), FileKind::foreign_recording);
  EXPECT_EQ(file_kind(folder.write("e.toml", "name = \n")), FileKind::scenario);
  EXPECT_EQ(file_kind(folder.write("f.csv", "t,x\n0,1\n")), FileKind::recording);
  EXPECT_EQ(file_kind(folder.write("g.txt", "Dear reader\n")), FileKind::unknown);
  EXPECT_EQ(file_kind(folder.path("none")), FileKind::unknown);
}

}  // namespace
}  // namespace odolab
