#include "core/io/diagnosis_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "test/support/diagnosis_by_hand.h"

namespace odolab {
namespace {

nlohmann::json parsed(const Diagnosis& diagnosis) { return nlohmann::json::parse(to_text(diagnosis_json(diagnosis))); }

// The example of the published schema, shortened to the values that stand in it.
TEST(DiagnosisJson, SaysWhatTheSchemasExampleSays) {
  const nlohmann::json json = parsed(test::diagnosis_by_hand());
  EXPECT_EQ(json["schema"], "odolab.diagnosis/1");
  EXPECT_EQ(json["verdict"], "found");
  EXPECT_EQ(json["calibration"]["wheel_radius_left_m"]["value"], 0.0751);
  EXPECT_EQ(json["calibration"]["wheel_radius_left_m"]["stderr"], 2e-6);
  EXPECT_TRUE(json["calibration"].contains("wheel_radius_right_m"));
  EXPECT_TRUE(json["calibration"].contains("wheelbase_m"));
  ASSERT_EQ(json["findings"].size(), 2u);
  const nlohmann::json& eccentric = json["findings"][0];
  EXPECT_EQ(eccentric["effect"], "wheel_eccentricity");
  EXPECT_EQ(eccentric["component"], "left_wheel");
  EXPECT_EQ(eccentric["parameters"]["amplitude"],
            (nlohmann::json{{"value", 0.006}, {"stderr", 0.0001}, {"unit", "1"}}));
  EXPECT_EQ(eccentric["evidence"], (nlohmann::json{{"log_likelihood_gain", 412.0}, {"p_value", 1e-12}}));
  EXPECT_EQ(eccentric["alternatives"][0]["log_likelihood_gain"], 3.1);
  EXPECT_EQ(eccentric["alternatives"][0]["effect"], "wheel_eccentricity");
  EXPECT_EQ(eccentric["alternatives"][0]["told_apart_by"], "arcs, which de-phase the wheels");
  EXPECT_EQ(eccentric["share_of_mismatch"], 0.83);
  EXPECT_EQ(eccentric["moves"], (nlohmann::json{{"position_rms_m", 0.0021}, {"heading_rms_rad", 0.0087}}));
  EXPECT_FALSE(json["findings"][1].contains("moves"));
  for (const char* part : {"train", "held_out"})
    for (const char* step : {"nominal", "calibrated", "with_findings", "noise_floor"})
      for (const char* figure : {"position_rms_m", "heading_rms_rad", "normalised_chi2"})
        EXPECT_TRUE(json["fit"][part][step][figure].is_number()) << part << " " << step << " " << figure;
  EXPECT_EQ(json["fit"]["held_out"]["with_findings"]["position_rms_m"], 0.0019);
  EXPECT_EQ(json["simulation"]["before"]["normalised_chi2"], 8.8);
  EXPECT_EQ(json["simulation"]["after"]["normalised_chi2"], 1.2);
  EXPECT_EQ(json["not_testable_here"][0]["effect"], "lateral_slip");
  EXPECT_TRUE(json["not_testable_here"][0]["because"].is_string());
  EXPECT_TRUE(json["not_testable_here"][0]["drive_this"].is_string());
  EXPECT_TRUE(json["next_drive"].is_string());
}

TEST(DiagnosisJson, SaysOfEveryEffectThatWasAskedForOnlyWhatIsKnown) {
  EXPECT_EQ(parsed(test::diagnosis_by_hand())["asked"], nlohmann::json::parse(R"([{
      "effect": "lateral_slip", "component": "vehicle", "named": false, "log_likelihood_gain": 1.5,
      "log_likelihood_gain_beside_findings": 0.25, "p_value": 1.0, "survives_calibration": 0.004,
      "bends_calibration": {"parameter": "truth_mounting.x_m", "value": 0.0031, "unit": "m"}}])"));
}

TEST(DiagnosisJson, TellsInWhichOtherRecordingsItWasFoundToo) {
  Diagnosis d = test::diagnosis_by_hand();
  EXPECT_FALSE(parsed(d)["findings"][1]["where"].contains("other_recordings"));
  d.findings[1].where.other_recordings = {"run_4.csv", "run_7.csv"};
  const nlohmann::json where = parsed(d)["findings"][1]["where"];
  EXPECT_EQ(where["recording"], "run_3.csv");
  EXPECT_EQ(where["other_recordings"], (nlohmann::json{"run_4.csv", "run_7.csv"}));
}

TEST(DiagnosisJson, WhereHoldsOnlyWhatApplies) {
  const nlohmann::json json = parsed(test::diagnosis_by_hand());
  EXPECT_EQ(json["findings"][0]["where"],
            (nlohmann::json{{"regime", "once in each turn of the wheel, at every speed"}}));
  EXPECT_EQ(json["findings"][1]["where"], (nlohmann::json::parse(R"({"time_s": [[3.75, 7.25]], "recording": "run_3.csv",
                                           "zone": {"x_m": 2.2, "y_m": 0.1, "radius_m": 0.7}})")));
}

TEST(DiagnosisJson, SaysTheFormWhereAnEffectHasSeveral) {
  Diagnosis d = test::diagnosis_by_hand();
  d.findings[1].form_in_words = "each wheel that is on the patch";
  const nlohmann::json json = parsed(d);
  EXPECT_FALSE(json["findings"][0].contains("form"));
  EXPECT_EQ(json["findings"][1]["form"], "each wheel that is on the patch");
}

TEST(DiagnosisJson, KnowsEveryVerdictByTheSchemasWord) {
  const std::pair<Verdict, const char*> words[] = {{Verdict::found, "found"},
                                                   {Verdict::nothing_missing, "nothing_missing"},
                                                   {Verdict::unknown_effect, "unknown_effect"},
                                                   {Verdict::ambiguous, "ambiguous"},
                                                   {Verdict::cannot_say, "cannot_say"}};
  for (const auto& [verdict, word] : words) {
    Diagnosis diagnosis;
    diagnosis.verdict = verdict;
    EXPECT_EQ(parsed(diagnosis)["verdict"], word);
  }
}

TEST(DiagnosisJson, AnEmptyDiagnosisHasEveryKey) {
  const nlohmann::json json = parsed(Diagnosis{});
  for (const char* key :
       {"schema", "verdict", "calibration", "findings", "fit", "simulation", "not_testable_here", "next_drive"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_TRUE(json["findings"].is_array());
  EXPECT_TRUE(json["not_testable_here"].is_array());
  EXPECT_TRUE(json["fit"]["held_out"].is_object());
  EXPECT_TRUE(json["simulation"].is_object());
}

TEST(DiagnosisJson, WhatIsNotDeterminedHasNoError) {
  const nlohmann::json json = parsed(test::diagnosis_by_hand());
  EXPECT_TRUE(json["calibration"]["truth_mounting.x_m"]["stderr"].is_null());
  EXPECT_EQ(json["calibration"]["truth_mounting.x_m"]["value"], 0.0);
}

// Straights to and fro tell how the wheels differ, and not how large they are.
TEST(DiagnosisJson, ALengthOfWhichOnlyTheRatioShowsIsAsUncertainAsTheVehiclesFile) {
  Diagnosis diagnosis = test::diagnosis_by_hand();
  diagnosis.calibration.scale_is_open = true;
  const nlohmann::json radius = parsed(diagnosis)["calibration"]["wheel_radius_left_m"];
  EXPECT_NEAR(radius["stderr"].get<double>(), 0.1 * radius["value"].get<double>(), 1e-6);
  EXPECT_TRUE(radius["only_its_ratio_shows"].get<bool>());
}

TEST(DiagnosisJson, ErrorsThatATruthWithoutHeadingsDoesNotTellAreNull) {
  Diagnosis diagnosis = test::diagnosis_by_hand();
  diagnosis.held_out.calibrated = FitFigures{0.0, 0.0, 3.2};
  const nlohmann::json held_out = parsed(diagnosis)["fit"]["held_out"];
  EXPECT_TRUE(held_out["calibrated"]["position_rms_m"].is_null());
  EXPECT_TRUE(held_out["calibrated"]["heading_rms_rad"].is_null());
  EXPECT_EQ(held_out["calibrated"]["normalised_chi2"], 3.2);
  EXPECT_EQ(held_out["with_findings"]["position_rms_m"], 0.0019);
}

TEST(DiagnosisJson, SaysOverWhichWayErrorsAreGathered) {
  Diagnosis diagnosis = test::diagnosis_by_hand();
  EXPECT_FALSE(parsed(diagnosis)["fit"]["train"]["calibrated"].contains("window_m"));
  diagnosis.train_over = WindowSize{24.0, 31.0};
  diagnosis.held_out_over = WindowSize{1.03, 0.4};
  const nlohmann::json json = parsed(diagnosis);
  for (const auto& [entry, way_m] : {std::pair{json["fit"]["train"]["calibrated"], 24.0},
                                     {json["fit"]["held_out"]["noise_floor"], 1.03},
                                     {json["simulation"]["after"], 24.0}})
    EXPECT_EQ(entry["window_m"], way_m);
  EXPECT_EQ(json["fit"]["held_out"]["nominal"]["window_rad"], 0.4);
}

TEST(DiagnosisJson, AChanceBelowAllNumbersIsNotZero) {
  Diagnosis diagnosis = test::diagnosis_by_hand();
  diagnosis.findings[0].log_likelihood_gain = 6788.0;
  diagnosis.findings[0].p_value = diagnosis.asked[0].p_value = 0.0;
  const nlohmann::json json = parsed(diagnosis);
  EXPECT_EQ(json["findings"][0]["evidence"], (nlohmann::json{{"log_likelihood_gain", 6788.0}, {"p_value", 1e-300}}));
  EXPECT_EQ(json["asked"][0]["p_value"], 1e-300);
}

}  // namespace
}  // namespace odolab
