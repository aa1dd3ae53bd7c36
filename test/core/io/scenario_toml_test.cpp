#include "core/io/scenario_toml.h"

#include "core/io/vehicle_toml.h"
#include "test/core/io/files.h"

namespace odolab {
namespace {

constexpr const char* kScenario = R"(name = "Ten bumps"
about = "The extended UMBmark."
vehicle = "vehicles/labmate.toml"
seed = 7

[actual]
wheelbase_m = 0.345

[floor]
friction = 0.7
[floor.roughness]
largest_height_m = 0.001
[[floor.bump]]
x_m = 2.0
height_m = 0.010
under = "inside_wheel"
[[floor.slip_zone]]
shape = "polygon"
corners = [[0, 0], [1, 0], [1, 1.5]]
slip = 0.2

[path]
kind = "square"
side_m = 4

[benchmark]
runs_each_way = 5
extended = true

[[expect]]
figure = "largest_systematic_error_m"
at_most = 0.03
)";

struct Scene {
  ScratchFolder folder;
  Scene() {
    folder.write("vehicles/labmate.toml",
                 "kind = \"differential_drive\"\n[differential_drive]\nwheel_radius_left_m = "
                 "0.08\nwheel_radius_right_m = 0.081\n"
                 "wheelbase_m = 0.340\nencoder_counts_per_revolution = 2000\n");
  }
  Result<Scenario> read(const std::string& text) { return read_scenario(folder.write("s.toml", text)); }
  std::string complaint(const std::string& text) { return message_of(read(text), folder.path("s.toml")); }
};

TEST(ScenarioToml, ReadsWhatStandsThereAndDefaultsForTheRest) {
  Scene scene;
  const Result<Scenario> s = scene.read(kScenario);
  ASSERT_TRUE(s.ok()) << s.error().message();
  EXPECT_EQ(s->name, "Ten bumps");
  EXPECT_EQ(s->seed, 7u);
  EXPECT_EQ(s->vehicle_file, "vehicles/labmate.toml");
  EXPECT_EQ(std::get<DifferentialDrive>(s->vehicle.kind).wheel_radius_left_m, 0.08);
  // as drawn but for the one value that is given
  EXPECT_EQ(s->actual.wheel_radius_left_m, 0.08);
  EXPECT_EQ(s->actual.wheel_radius_right_m, 0.081);
  EXPECT_EQ(s->actual.wheelbase_m, 0.345);
  EXPECT_EQ(s->actual.mass_kg, ActualDrive().mass_kg);
  EXPECT_EQ(s->floor.friction, 0.7);
  EXPECT_EQ(s->floor.roughness.largest_height_m, 0.001);
  EXPECT_EQ(s->floor.roughness.spacing_m, Roughness().spacing_m);
  ASSERT_EQ(s->floor.bumps.size(), 1u);
  EXPECT_EQ(s->floor.bumps[0].centre.x_m, 2.0);
  EXPECT_EQ(s->floor.bumps[0].under, Under::inside_wheel);
  ASSERT_EQ(s->floor.slip_zones.size(), 1u);
  EXPECT_EQ(std::get<Polygon>(s->floor.slip_zones[0].shape).corners[2].y_m, 1.5);
  EXPECT_FALSE(s->floor.slip_zones[0].friction.has_value());
  EXPECT_EQ(std::get<SquarePath>(s->path).side_m, 4.0);
  ASSERT_TRUE(s->benchmark.has_value());
  EXPECT_TRUE(s->benchmark->extended);
  ASSERT_EQ(s->expectations.size(), 1u);
  EXPECT_EQ(*s->expectations[0].at_most, 0.03);
  EXPECT_FALSE(s->expectations[0].at_least.has_value());
}

TEST(ScenarioToml, AFileWithANameAloneIsTheDefaultScenario) {
  Scene scene;
  const Result<Scenario> s = scene.read("name = \"plain\"\n");
  ASSERT_TRUE(s.ok()) << s.error().message();
  EXPECT_TRUE(std::holds_alternative<SquarePath>(s->path));
  EXPECT_EQ(s->actual.wheelbase_m, DifferentialDrive().wheelbase_m);
}

TEST(ScenarioToml, SaysInOneLineWhatIsWrong) {
  Scene scene;
  EXPECT_EQ(scene.complaint(replaced(kScenario, "side_m", "sidem")),
            "s.toml:24: found the key 'sidem', expected a known key; the nearest is 'side_m'");
  EXPECT_NE(scene.complaint(replaced(kScenario, "at_most = 0.03", "at_leest = 0.03"))
                .find("the key 'at_leest', expected a known key; the nearest is 'at_least'"),
            std::string::npos);
  EXPECT_EQ(scene.complaint(replaced(kScenario, "[floor]", "[flor]\n[floor]")),
            "s.toml:9: found the key 'flor', expected a known key; the nearest is 'floor'");
  EXPECT_EQ(scene.complaint(replaced(kScenario, "height_m = 0.010", "radius_m = 0.010")),
            "s.toml:15: found the key 'radius_m', expected a known key: x_m, y_m, direction_rad, length_m, height_m, "
            "under or round");
  EXPECT_EQ(scene.complaint(replaced(kScenario, "\"square\"", "\"circle\"")),
            "s.toml:23: kind: found 'circle', expected square, straight, figure_eight, waypoints, wheel_speeds, hand, "
            "rectangle, manoeuvres or replay");
  EXPECT_EQ(scene.complaint(replaced(kScenario, "inside_wheel", "outside_wheel")),
            "s.toml:16: under: found 'outside_wheel', expected any_wheel, left_wheel, right_wheel or inside_wheel");
  EXPECT_EQ(scene.complaint(replaced(kScenario, "0.010", "0.2")),
            "s.toml:15: floor.bump[1].height_m: found 0.2, expected 0 to 0.05 m");
  EXPECT_EQ(scene.complaint(replaced(kScenario, "wheelbase_m = 0.345", "wheelbase_m = 0")),
            "s.toml:7: actual.wheelbase_m: found 0, expected a value above 0 m");
  EXPECT_EQ(scene.complaint(replaced(kScenario, ", [1, 1.5]]", "]")),
            "s.toml:19: floor.slip_zone[1].corners: found 2, expected three corners or more");
  EXPECT_EQ(scene.complaint(replaced(kScenario, "[1, 1.5]", "[1]")),
            "s.toml:19: corners: found an array of 1, expected a point [x, y]");
  EXPECT_EQ(scene.complaint(replaced(kScenario, "seed = 7", "seed = -7")),
            "s.toml:4: seed: found -7, expected a whole number, 0 or more");
  EXPECT_EQ(scene.complaint(replaced(kScenario, "true", "1")), "s.toml:28: extended: found 1, expected true or false");
  EXPECT_EQ(scene.complaint(replaced(kScenario, "[benchmark]", "[[benchmark]]")),
            "s.toml:26: benchmark: found an array of tables, expected a table");
  EXPECT_EQ(scene.complaint(replaced(kScenario, "[[floor.bump]]", "[floor.bump]")),
            "s.toml:13: bump: found a table, expected tables, each under [[...]]");
  EXPECT_EQ(scene.complaint(replaced(kScenario, "at_most = 0.03", "")),
            "s.toml:30: found no key 'at_most', expected it to be given");
  EXPECT_EQ(scene.complaint(replaced(kScenario, "vehicles/labmate", "vehicles/labmat")),
            "s.toml:3: vehicle: found 'vehicles/labmat.toml', which does not exist, expected a vehicle file, relative "
            "to the scenario");
  EXPECT_EQ(scene.complaint("[path]\nkind = \"replay\"\n"),
            "s.toml:1: found no key 'recording', expected it to be given");
  EXPECT_EQ(scene.complaint("[path]\nkind = \"waypoints\"\n"),
            "s.toml:1: path.point: found 0, expected one point or more");
  const std::string cut_off = std::string(kScenario).substr(0, std::string(kScenario).find("4\n\n[benchmark]"));
  EXPECT_EQ(scene.complaint(cut_off).substr(0, 30), "s.toml:24: found broken TOML (");
}

TEST(ScenarioToml, AnEffectThatIsMisspeltIsNamedWithTheNearest) {
  Scene scene;
  const std::string good =
      "seed = 1\n[[effect]]\neffect = \"wheel_eccentricity\"\ncomponent = \"left_wheel\"\namplitude = 0.01\n";
  ASSERT_TRUE(scene.read(good).ok());
  EXPECT_EQ(scene.complaint(replaced(good, "eccentricity", "excentricity")),
            "s.toml:3: effect: found 'wheel_excentricity', expected a known word; the nearest is 'wheel_eccentricity'");
  EXPECT_EQ(scene.complaint(replaced(good, "left_wheel", "left")),
            "s.toml:4: component: found 'left', expected left_wheel, right_wheel or both_wheels");
  EXPECT_EQ(scene.complaint(replaced(good, "amplitude", "amplitud")),
            "s.toml:5: found the key 'amplitud', expected a known key; the nearest is 'amplitude'");
  EXPECT_EQ(scene.complaint(replaced(good, "amplitude = 0.01", "phase_rad = 1")),
            "s.toml:2: found no key 'amplitude', expected it to be given");
  EXPECT_EQ(scene.complaint(replaced(good, "0.01", "0.7")),
            "s.toml:5: effect[1].amplitude: found 0.7, expected 0 to 0.5");
  EXPECT_EQ(scene.complaint(replaced(good, "0.01", "\"much\"")),
            "s.toml:5: amplitude: found 'much', expected a number");
  EXPECT_EQ(scene.complaint("[sensors]\nrecord_encoders = false\n"),
            "s.toml:2: sensors.record_encoders: found 0, expected true, or else record_commands = true");
}

TEST(ScenarioToml, AFormThatAnEffectDoesNotHaveIsRefused) {
  Scene scene;
  const std::string good =
      "seed = 1\n[[effect]]\neffect = \"castor_reversal_kick\"\ncomponent = \"vehicle\"\nkick_rad = 0.01\nform = 14\n";
  ASSERT_TRUE(scene.read(good).ok());
  EXPECT_EQ(scene.complaint(replaced(good, "14", "17")),
            "s.toml:6: effect[1].form: found 17, expected a whole number from 0 to 16");
  EXPECT_EQ(scene.complaint(replaced(good, "14", "1.5")),
            "s.toml:6: effect[1].form: found 1.5, expected a whole number from 0 to 16");
  const std::string bump =
      "[[effect]]\neffect = \"bump\"\ncomponent = \"left_wheel\"\nextra_distance_m = 0.01\nat_s = 4.0\nform = 5\n";
  ASSERT_TRUE(scene.read(bump).ok());
  EXPECT_EQ(scene.complaint(replaced(bump, "form = 5", "form = 6")),
            "s.toml:6: effect[1].form: found 6, expected a whole number from 0 to 5");
  EXPECT_EQ(scene.complaint(replaced(bump, "at_s = 4.0", "y_m = 1.0")),
            "s.toml:1: found no key 'x_m', expected it to be given");
}

TEST(ScenarioToml, AnErrorInTheVehicleNamesTheVehiclesFile) {
  Scene scene;
  scene.folder.write(
      "vehicles/labmate.toml",
      "kind = \"differential_drive\"\n[differential_drive]\nwheel_radius_left_m = 0\nwheel_radius_right_m = 0.08\n"
      "wheelbase_m = 0.34\n");
  EXPECT_EQ(
      scene.complaint(kScenario),
      "vehicles/labmate.toml:3: differential_drive.wheel_radius_left_m: found 0, expected a length in metres above 0");
}

// Everything that a scenario can hold, each value unlike its default.
Scenario full_scenario() {
  Scenario s;
  s.name = "full";
  s.about = "a \"scenario\" with everything";
  DifferentialDrive drive;
  drive.wheel_radius_left_m = 0.0741;
  drive.gear_ratio = 1.0 / 3.0;
  s.vehicle.kind = drive;
  s.vehicle.name = "mine";
  s.vehicle.truth.axle_T_tracked = {0.01, 0.02, 0.03};
  s.actual = {0.0751, 0.0752, 0.341, 0.001, -0.002, 51.0, 3.1, 0.65};
  s.motor = {true, 0.021, 8.1, 4.1, 40.1};
  s.floor.friction = 0.31;
  s.floor.tilt_rad = 0.01;
  s.floor.downhill_direction_rad = 1.0 / 7.0;
  s.floor.roughness = {0.0009, 0.021};
  s.floor.bumps = {{{1.0, 2.0}, 0.3, 0.4, 0.011, Under::right_wheel, true}, {}};
  s.floor.slip_zones = {{Disc{{1, 2}, 0.3}, 0.1, 0.2},
                        {Rectangle{{3, 4}, 0.5, 0.6, 0.7}, std::nullopt, 0.8},
                        {Polygon{{{0, 0}, {1, 0}, {0.1, 0.9}}}, 0.4, 0.0}};
  s.start = {0.1, -0.2, 0.3};
  s.driving = {0.21, 1.1, 0.22, 1.2, 3.5};
  s.sensors = {0.025, 0.015, 0.002, 0.007, false, false, true};
  s.effects = {{"wheel_eccentricity", "left_wheel", {{"amplitude", 0.01}, {"phase_rad", 1.0 / 3.0}}},
               {"truth_frozen", "truth", {}}};
  s.expectations = {{"a", 1.0, std::nullopt}, {"b", std::nullopt, 2.0}, {"c", -1.0, 1.0}};
  s.step_s = 0.002;
  s.seed = 9223372036854775807ULL;
  return s;
}

class ScenarioTomlPaths : public testing::TestWithParam<Path> {};

TEST_P(ScenarioTomlPaths, RoundTripWritesTheSameFileAgain) {
  ScratchFolder folder;
  Scenario scenario = full_scenario();
  scenario.path = GetParam();
  if (std::holds_alternative<SquarePath>(scenario.path)) scenario.benchmark = Benchmark{3, true};
  const std::string first = folder.path("first.toml"), second = folder.path("second.toml");
  const Result<Done> written = write_scenario(first, scenario);
  ASSERT_TRUE(written.ok()) << written.error().message();
  const Result<Scenario> back = read_scenario(first);
  ASSERT_TRUE(back.ok()) << back.error().message();
  ASSERT_TRUE(write_scenario(second, *back).ok());
  // numbers are written exactly, so equal text means equal bits; that each value is written at all is checked below
  EXPECT_EQ(text_of(first), text_of(second));
  EXPECT_EQ(back->path.index(), scenario.path.index());
  EXPECT_EQ(back->seed, scenario.seed);
  EXPECT_EQ(back->actual.drive_wheel_load_share, 0.65);
  EXPECT_EQ(back->motor.integral_gain, 40.1);
  EXPECT_EQ(back->floor.downhill_direction_rad, 1.0 / 7.0);
  EXPECT_EQ(back->floor.bumps[0].under, Under::right_wheel);
  EXPECT_EQ(std::get<Rectangle>(back->floor.slip_zones[1].shape).direction_rad, 0.7);
  EXPECT_EQ(*back->floor.slip_zones[2].friction, 0.4);
  EXPECT_EQ(back->start.heading_rad, 0.3);
  EXPECT_EQ(back->driving.turn_acceleration_radps2, 1.2);
  EXPECT_EQ(back->driving.stands_s, 3.5);
  EXPECT_EQ(back->sensors.truth_heading_noise_rad, 0.007);
  EXPECT_FALSE(back->sensors.truth_heading);
  EXPECT_FALSE(back->sensors.record_encoders);
  EXPECT_TRUE(back->sensors.record_commands);
  EXPECT_TRUE(back->floor.bumps[0].round);
  ASSERT_EQ(back->effects.size(), 2u);
  EXPECT_EQ(back->effects[0].effect, "wheel_eccentricity");
  EXPECT_EQ(back->effects[0].component, "left_wheel");
  EXPECT_EQ(back->effects[0].parameters, scenario.effects[0].parameters);
  EXPECT_EQ(back->benchmark.has_value(), scenario.benchmark.has_value());
  EXPECT_EQ(back->expectations.size(), 3u);
  EXPECT_EQ(back->vehicle.name, "mine");
  EXPECT_EQ(std::get<DifferentialDrive>(back->vehicle.kind).gear_ratio, 1.0 / 3.0);
  EXPECT_EQ(back->vehicle.truth.axle_T_tracked.heading_rad, 0.03);
}

INSTANTIATE_TEST_SUITE_P(AllKinds, ScenarioTomlPaths,
                         testing::Values(Path(SquarePath{3.9, true}), Path(StraightPath{7.0, true}),
                                         Path(FigureEightPath{0.7, 3}), Path(WaypointPath{{{1, 2}, {3.5, -4}}}),
                                         Path(WheelSpeedPath{{{1.0, 2.0, 3.0}, {4.0, -5.0, 6.0}}, 0.25}),
                                         Path(HandPath{12.0}), Path(RectanglePath{6.0, 3.0, 0.4, true}),
                                         Path(ManoeuvrePath{{{1.0, 0.0, 0.5}, {-2.0, 0.0, 0.0}}}),
                                         Path(ReplayPath{"runs/one.csv", ReplayPath::By::commands})));

TEST(ScenarioToml, ActualLengthsOfLinkedTrucksStandInATableOfTheirKind) {
  ScratchFolder folder;
  Scenario scenario;
  Clapper trucks;
  scenario.vehicle.kind = trucks;
  trucks.truck_b.wheel_radius_left_m = 0.0751;
  trucks.link_length_offset_m = 0.002;
  scenario.machine.lengths = trucks;
  scenario.machine.link.length_eccentricity_m = 0.0005;
  scenario.path = ManoeuvrePath{{{0.0, 1.0, 0.0}}};
  const std::string first = folder.path("first.toml"), second = folder.path("second.toml");
  ASSERT_TRUE(write_scenario(first, scenario).ok());
  const Result<Scenario> back = read_scenario(first);
  ASSERT_TRUE(back.ok()) << back.error().message();
  ASSERT_TRUE(write_scenario(second, *back).ok());
  EXPECT_EQ(text_of(first), text_of(second));
  EXPECT_EQ(true_lengths<Clapper>(back->machine, back->vehicle).truck_b.wheel_radius_left_m, 0.0751);
  EXPECT_EQ(true_lengths<Clapper>(back->machine, back->vehicle).link_length_offset_m, 0.002);
  EXPECT_EQ(std::get<Clapper>(back->vehicle.kind).link_length_offset_m, 0.0);
  EXPECT_EQ(back->machine.link.length_eccentricity_m, 0.0005);
}

TEST(ScenarioToml, OnlyVehiclesThatCanMoveSidewaysAreToldTo) {
  Scene scene;
  EXPECT_EQ(scene.complaint("vehicle = \"vehicles/labmate.toml\"\n[path]\nkind = \"manoeuvres\"\n"
                            "[[path.move]]\nleft_m = 1\n"),
            "s.toml:5: path.move[1].left_m: found 1, expected 0 for a vehicle that cannot move sideways");
}

TEST(ScenarioToml, NamesItsVehicleFileWhereThereIsOne) {
  ScratchFolder folder;
  Scenario scenario;
  scenario.vehicle_file = "labmate.toml";
  ASSERT_TRUE(write_vehicle(folder.path("labmate.toml"), scenario.vehicle).ok());
  ASSERT_TRUE(write_scenario(folder.path("s.toml"), scenario).ok());
  EXPECT_NE(text_of(folder.path("s.toml")).find("vehicle = \"labmate.toml\"\n"), std::string::npos);
  EXPECT_EQ(read_scenario(folder.path("s.toml"))->vehicle_file, "labmate.toml");
  scenario.seed = 1ULL << 63;
  EXPECT_EQ(message_of(write_scenario(folder.path("t.toml"), scenario), folder.path("t.toml")),
            "t.toml: seed: found 9223372036854775808, expected at most 9223372036854775807");
}

}  // namespace
}  // namespace odolab
