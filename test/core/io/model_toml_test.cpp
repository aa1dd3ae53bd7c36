#include "core/io/model_toml.h"

#include "core/diagnosis/effects/effect.h"
#include "test/core/io/files.h"

namespace odolab {
namespace {

FittedModel eccentric_robot() {
  FittedModel model;
  model.vehicle.name = "robot \"7\"";
  DifferentialDrive drive;
  drive.wheel_radius_left_m = 0.1 / 3.0;
  drive.wheel_radius_right_m = 0.0333;
  drive.wheelbase_m = 0.34127;
  drive.gear_ratio = 3.7;
  drive.counter_bits = 16;
  model.vehicle.kind = drive;
  model.vehicle.truth = {{0.01, -0.02, 1.0 / 7.0}, -0.0123};
  model.effects.push_back({{"wheel_eccentricity", "left_wheel", {{"amplitude", 0.0061}, {"phase_rad", -1.0 / 3.0}}},
                           {{"amplitude", 1e-4}, {"phase_rad", 0.02}},
                           ""});
  model.effects.push_back(
      {{"slip_zone", "floor", {{"slip", 0.1}, {"x_m", 2.0}, {"y_m", -0.5}, {"radius_m", 0.7}}}, {{"slip", 0.002}}, ""});
  model.truth_clock_s = {{"run_3.csv", 1.0 / 30.0}, {"run_4.csv", -0.02}};
  model.fingerprints = {{"run_4.csv", "0123456789abcdef"}};
  model.effects.push_back({{"collision", "vehicle", {{"dx_m", 0.02}, {"at_s", 12.5}}}, {}, "run_3.csv"});
  return model;
}

TEST(ModelToml, ReadsBackWhatItWroteToTheBit) {
  const ScratchFolder folder;
  const FittedModel model = eccentric_robot();
  ASSERT_TRUE(write_model(folder.path("m.toml"), model));
  const Result<FittedModel> read = read_model(folder.path("m.toml"));
  ASSERT_TRUE(read) << read.error().message();
  const auto& drive = std::get<DifferentialDrive>(read->vehicle.kind);
  EXPECT_EQ(drive.wheel_radius_left_m, 0.1 / 3.0);
  EXPECT_EQ(drive.counter_bits, 16);
  EXPECT_EQ(read->vehicle.truth.axle_T_tracked.heading_rad, 1.0 / 7.0);
  EXPECT_EQ(read->vehicle.truth.time_offset_s, -0.0123);
  ASSERT_EQ(read->effects.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(read->effects[i].active.effect, model.effects[i].active.effect);
    EXPECT_EQ(read->effects[i].active.component, model.effects[i].active.component);
    EXPECT_EQ(read->effects[i].active.parameters, model.effects[i].active.parameters);
    EXPECT_EQ(read->effects[i].recording, model.effects[i].recording);
    EXPECT_EQ(read->effects[i].stderr_values, model.effects[i].stderr_values);
  }
  EXPECT_EQ(read->truth_clock_s, model.truth_clock_s);
  EXPECT_EQ(read->fingerprints, model.fingerprints);
  EXPECT_EQ(model_text(*read), model_text(model));
}

TEST(ModelToml, IsReadBackWhateverBytesTheNameOfARecordingHas) {
  const ScratchFolder folder;
  FittedModel model = eccentric_robot();
  model.truth_clock_s = {{"caf\xE9.csv", 0.02}};
  model.effects.back().recording = "caf\xE9.csv";
  ASSERT_TRUE(write_model(folder.path("m.toml"), model));
  const Result<FittedModel> read = read_model(folder.path("m.toml"));
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_EQ(read->truth_clock_s.front().first, "caf\xEF\xBF\xBD.csv");
  EXPECT_EQ(read->effects.back().recording, "caf\xEF\xBF\xBD.csv");
}

TEST(ModelToml, AVehicleWithoutFindingsIsAModelToo) {
  const ScratchFolder folder;
  ASSERT_TRUE(write_model(folder.path("m.toml"), {}));
  const Result<FittedModel> read = read_model(folder.path("m.toml"));
  ASSERT_TRUE(read) << read.error().message();
  EXPECT_TRUE(read->effects.empty());
}

TEST(ModelToml, RefusesWhatItDoesNotKnow) {
  const ScratchFolder folder;
  const std::string good = model_text(eccentric_robot());
  const auto message_with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    const std::string path = folder.write("m.toml", text);
    return message_of(read_model(path), path);
  };
  EXPECT_EQ(
      message_of(read_model(ODOLAB_SOURCE_DIR "/assets/vehicles/labmate.toml"),
                 ODOLAB_SOURCE_DIR "/assets/vehicles/labmate.toml"),
      "labmate.toml: found a vehicle's file, expected a model that odolab diagnose --model wrote; --vehicle takes "
      "vehicles");
  EXPECT_NE(message_with("model/1", "model/2").find("m.toml:2: schema: found 'odolab.model/2'"), std::string::npos)
      << message_with("model/1", "model/2");
  EXPECT_NE(message_with("wheelbase_m", "wheelbas_m").find("wheelbase_m"), std::string::npos);
  EXPECT_NE(message_with("[effect.stderr]\n", "[effect.stderr]\nphase = 1.0\n").find("the key 'phase'"),
            std::string::npos)
      << message_with("[effect.stderr]\n", "[effect.stderr]\nphase = 1.0\n");
  EXPECT_NE(message_with("amplitude = 0.0061", "amplitude = \"much\"").find("amplitude: found 'much'"),
            std::string::npos)
      << message_with("amplitude = 0.0061", "amplitude = \"much\"");
  EXPECT_NE(message_with("amplitude = 0.0061", "amplitud = 0.0061")
                .find("the key 'amplitud', expected a known key; the nearest is 'amplitude'"),
            std::string::npos)
      << message_with("amplitude = 0.0061", "amplitud = 0.0061");
  EXPECT_NE(message_with("amplitude = 0.0061", "amplitude = 0.0061\nform = 99").find("form: found no such form"),
            std::string::npos)
      << message_with("amplitude = 0.0061", "amplitude = 0.0061\nform = 99");
  EXPECT_NE(message_with("\"wheel_eccentricity\"", "\"wheel_excentricity\"").find("m.toml:"), std::string::npos);
  EXPECT_NE(message_with("component = \"left_wheel\"\n", "").find("component"), std::string::npos);
  EXPECT_NE(message_with("[vehicle]", "[vehicles]").find("no key 'kind'"), std::string::npos);
}

TEST(ModelToml, HoldsEveryEffectThatADiagnosisCanName) {
  const ScratchFolder folder;
  for (const Effect& entry : catalogue()) {
    FittedEffect effect{{entry.name, entry.component, {}}, {}, ""};
    const std::vector<double> ones(entry.amplitudes.size(), 0.01);
    if (entry.to_parameters)
      for (const FoundParameter& p : entry.to_parameters(ones, ones))
        effect.active.parameters.emplace_back(p.name, p.value);
    else
      for (const Effect::Amplitude& a : entry.amplitudes) effect.active.parameters.emplace_back(a.name, 0.01);
    if (!entry.shape_follows_amplitude)
      for (std::size_t k = 0; k < entry.shapes.size(); ++k)
        if (entry.shapes[k].name != "recording") effect.active.parameters.emplace_back(entry.shapes[k].name, 0.5);
    if (entry.forms.size() > 1) effect.active.parameters.emplace_back("form", 1.0);
    FittedModel model;
    model.effects = {effect};
    ASSERT_TRUE(write_model(folder.path("m.toml"), model));
    const Result<FittedModel> read = read_model(folder.path("m.toml"));
    ASSERT_TRUE(read) << entry.name << " of " << entry.component << ": " << read.error().message();
    EXPECT_EQ(read->effects[0].active.parameters.size(), effect.active.parameters.size()) << entry.name;
  }
}

TEST(FittedModel, KeepsAnEventToItsRecording) {
  EXPECT_EQ(eccentric_robot().effects_in("run_3.csv").size(), 3u);
  EXPECT_EQ(eccentric_robot().effects_in("run_4.csv").size(), 2u);
}

TEST(FittedModel, IsRefusedBesideAnotherVehicle) {
  const FittedModel model = eccentric_robot();
  Vehicle vehicle = model.vehicle;
  std::get<DifferentialDrive>(vehicle.kind).wheelbase_m = 0.3;  // a fit changes that
  EXPECT_TRUE(fits(model, vehicle));
  std::get<DifferentialDrive>(vehicle.kind).encoder_counts_per_revolution = 512;
  EXPECT_FALSE(fits(model, vehicle));
}

}  // namespace
}  // namespace odolab
