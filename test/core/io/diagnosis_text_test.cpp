#include "core/io/diagnosis_text.h"

#include <gtest/gtest.h>

#include "core/io/diagnosis_html.h"
#include "core/io/verdict_sentence.h"
#include "test/core/io/files.h"
#include "test/support/diagnosis_by_hand.h"

namespace odolab {
namespace {

TEST(QuantityText, HasAsManyDigitsAsItsErrorBears) {
  EXPECT_EQ(quantity_text(0.0751234, 2.3e-6, "m"), "75.1234 \xC2\xB1 0.0023 mm");
  EXPECT_EQ(quantity_text(0.006, 0.0001, "1"), "0.600 \xC2\xB1 0.010 %");
  EXPECT_EQ(quantity_text(0.0174532925, 0.00174532925, "rad"), "1.00 \xC2\xB1 0.10\xC2\xB0");
  EXPECT_EQ(quantity_text(0.34, 0.0, "m"), "340.0 mm");
  EXPECT_EQ(quantity_text(0.0121, 0.0004, "s"), "0.01210 \xC2\xB1 0.00040 s");
  EXPECT_EQ(quantity_text(0.0, 0.0, "m"), "0.000 mm");
  EXPECT_EQ(quantity_text(2e-5, 1e-6, "1/s"), "0.00200 \xC2\xB1 0.00010 % per s");
  EXPECT_EQ(quantity_text(2e-5, 1e-6, "s"), "2e-05 \xC2\xB1 1.0e-06 s");
  EXPECT_EQ(quantity_text(3.0, std::nan(""), "m/s"), "3000 mm/s");
}

TEST(SizeText, HasTwoDigitsInTheUnitsOfTheReport) {
  EXPECT_EQ(size_text(0.0016871, "1"), "0.17 %");
  EXPECT_EQ(size_text(0.0003079, "m/(m/s2)"), "0.31 mm/(m/s2)");
  EXPECT_EQ(size_text(3.497e-5, "1/s"), "0.0035 % per s");
  EXPECT_EQ(size_text(0.0998, "m"), "100 mm");
}

TEST(VerdictSentence, NamesWhatWasFound) {
  Diagnosis d = test::diagnosis_by_hand();
  EXPECT_EQ(verdict_sentence(d),
            "What the model lacks: wheel eccentricity of the left wheel and slip zone of the floor.");
  d.verdict = Verdict::ambiguous;
  d.findings.resize(1);
  EXPECT_EQ(verdict_sentence(d),
            "Something is missing, and these recordings cannot tell what: wheel eccentricity of the left wheel or "
            "wheel eccentricity of the right wheel.");
  d.findings.clear();
  d.verdict = Verdict::nothing_missing;
  EXPECT_EQ(verdict_sentence(d),
            "Nothing is missing that these drives could show: calibration explains these recordings down to their "
            "noise.");
  d.not_testable.clear();
  EXPECT_EQ(verdict_sentence(d), "Nothing is missing: calibration explains these recordings down to their noise.");
  Finding frozen;
  frozen.effect = "truth_frozen";
  frozen.component = "truth";
  d.findings = {frozen};
  d.verdict = Verdict::found;
  EXPECT_EQ(verdict_sentence(d), "The data are at fault: truth frozen.");
}

TEST(VerdictSentence, SaysWhereWhatIsMissingMattersLittle) {
  Diagnosis d = test::diagnosis_by_hand();
  d.findings.resize(1);
  d.findings[0].moves = MovedTrack{4.2e-5, 1e-4};
  EXPECT_EQ(
      verdict_sentence(d),
      "What the model lacks: wheel eccentricity of the left wheel. It matters little: where it acts it moves each "
      "metre or radian by 0.042 mm, 0.0057\xC2\xB0, in noise of 1.60 mm, 0.126\xC2\xB0.");
  d.findings[0].moves = MovedTrack{4.2e-5, 3e-4};  // over ten metres three milliradians, and by these 15 mm
  EXPECT_EQ(verdict_sentence(d), "What the model lacks: wheel eccentricity of the left wheel.");
}

TEST(VerdictSentence, DoesNotCallNoiseWhatGoesOnFromSampleToSample) {
  Diagnosis d;
  d.verdict = Verdict::nothing_missing;
  d.calibration_alone.innovations_are_correlated = true;
  EXPECT_EQ(verdict_sentence(d),
            "Nothing is found missing, but what calibration leaves is no mere noise: it goes on from one sample of the "
            "truth to the next.");
}

TEST(MergedWarnings, SayOnceWhatHoldsForSeveralRecordings) {
  const std::vector<std::string> merged =
      merged_warnings({"a.csv: its stamps tremble by 0.24 ms", "something else", "b.csv: its stamps tremble by 0.3 ms",
                       "b.csv: it stands still", "c.csv: its stamps tremble by 0.24 ms"});
  const std::vector<std::string> expected = {"a.csv and 2 others like it: its stamps tremble by 0.24 ms",
                                             "something else", "b.csv: it stands still"};
  EXPECT_EQ(merged, expected);
}

TEST(VerdictSentence, TellsAMarkerFromPhysics) {
  Diagnosis d = test::diagnosis_by_hand();
  Finding mounting;
  mounting.effect = "truth_mounting_offset";
  mounting.component = "truth";
  d.findings = {mounting};
  EXPECT_EQ(verdict_sentence(d),
            "No physics is missing. It was measured otherwise than the vehicle's file says: truth mounting offset.");
  Diagnosis of_few = d;
  of_few.cannot_judge = true;
  EXPECT_EQ(verdict_sentence(of_few),
            "These recordings cannot say whether physics is missing. It was measured otherwise than the vehicle's file "
            "says: truth mounting offset.");
  Finding toe;
  toe.effect = "wheel_toe";
  toe.component = "vehicle";
  toe.alternatives = {{"truth_mounting_offset", "truth", 1.0, ""}};
  Finding zone = d.findings[0];
  zone.effect = "slip_zone";
  zone.component = "floor";
  d.findings = {zone, toe};
  d.verdict = Verdict::ambiguous;
  EXPECT_EQ(verdict_sentence(d),
            "What the model lacks: slip zone of the floor. Not told apart by these recordings: wheel toe of "
            "the vehicle or truth mounting offset.");
}

TEST(EffectText, ReadsAsAPersonWouldSayIt) {
  EXPECT_EQ(effect_text("wheel_toe", "both_wheels"), "wheel toe of both wheels");
  EXPECT_EQ(effect_text("wheel_eccentricity", "truck_a.left_wheel"), "wheel eccentricity of the left wheel of truck A");
  EXPECT_EQ(effect_text("one_sided_drag", "castor2"), "one-sided drag of castor 2");
}

TEST(WhereText, SaysOnlyWhatApplies) {
  EXPECT_EQ(where_text({}), "");
  EXPECT_EQ(where_text(test::diagnosis_by_hand().findings[1].where),
            "in run_3.csv at 3.75 to 7.25 s; within 0.70 m of x 2.20, y 0.10 m");
}

TEST(SummaryLines, AreReadInAMinute) {
  Diagnosis d = test::diagnosis_by_hand();
  for (int more = 0; more < 12; ++more) {
    const std::vector<std::string> lines = summary_lines(d);
    EXPECT_LE(lines.size(), 25u);
    EXPECT_EQ(lines.front(), verdict_sentence(d).substr(0, lines.front().size()));
    d.findings.push_back(d.findings[1]);
    d.not_testable.push_back(d.not_testable[0]);
  }
  for (const std::string& line : summary_lines(test::diagnosis_by_hand())) EXPECT_LE(line.size(), 150u) << line;
}

TEST(SummaryLines, HoldEachFindingWholeAndSayHowManyMoreThereAre) {
  Diagnosis d = test::diagnosis_by_hand();
  Finding clocks;
  clocks.effect = "clock_rate";
  clocks.component = "truth";
  clocks.sentence = "the vehicle's clock and the truth's run at different rates, in each recording at one of its own";
  clocks.parameters = {{"rate", -1e-3, 1e-5, "1"}};
  for (int r = 1; r <= 9; ++r) clocks.parameters.push_back({"rate_" + std::to_string(r), -1e-4 * r, 0.0, "1"});
  clocks.where.regime = "grows with the time since the start";
  while (d.findings.size() < 6) d.findings.push_back(clocks);
  std::string all;
  for (const std::string& line : summary_lines(d)) all += line.substr(line.find_first_not_of(' ')) + " ";
  const auto said = count(all, "from recording to recording");
  EXPECT_GT(said, 0u);
  EXPECT_EQ(count(all, "grows with the time since"), said) << all;
  EXPECT_NE(all.find(std::to_string(6 - 2 - said) + " findings more"), std::string::npos) << all;
  EXPECT_NE(all.find("-0.09"), std::string::npos) << all;
}

TEST(Findings, SayTheSpeedAtWhichTheyAreSoLarge) {
  Diagnosis d = test::diagnosis_by_hand();
  d.findings[0].parameters = {{"per_s", 1e-4, 1e-5, "1/s"}, {"at_mps", 0.25, 0.0, "m/s"}};
  std::string summary;
  for (const std::string& line : summary_lines(d)) summary += line.substr(line.find_first_not_of(' ')) + " ";
  EXPECT_EQ(count(summary, "% per s at 250 mm/s;"), 1u) << summary;
}

TEST(Findings, SayInWhichOfSeveralFormsTheyFitBest) {
  Diagnosis d = test::diagnosis_by_hand();
  d.findings[1].form_in_words = "each wheel that is on the patch";
  std::string summary;
  for (const std::string& line : summary_lines(d)) summary += line.substr(line.find_first_not_of(' ')) + " ";
  EXPECT_EQ(count(summary, "its form: each wheel that is on the patch;"), 1u) << summary;
  EXPECT_EQ(count(summary, "its form"), 1u) << "the other has but one: " << summary;
  const std::string page = diagnosis_report(d).text();
  EXPECT_EQ(count(page, "each wheel that is on the patch"), 1u);
}

TEST(Proof, SaysOfATruthAtTheEndsAloneThatErrorsAreNotThoseOfAMetre) {
  Diagnosis d = test::diagnosis_by_hand();
  d.train_over = WindowSize{1.4, 0.6};
  const auto said = [&] {
    std::string all;
    for (const std::string& line : summary_lines(d)) all += line + "\n";
    return all;
  };
  EXPECT_NE(said().find("off over each metre or radian:"), std::string::npos) << said();
  d.train_over = WindowSize{24.2, 30.7};
  EXPECT_NE(said().find("off from one pose of the truth to the next, 24 m and 31 rad in the median:"),
            std::string::npos)
      << said();
  const std::string page = diagnosis_report(d).text();
  EXPECT_EQ(count(page, "gathered over one metre"), 0u);
  EXPECT_EQ(count(page, "Position error from one pose of the truth to the next, 24 m"), 2u);  // drawn, and its name
}

// Of what has no name, and of a truth whose clock is off, no model has more than calibration has by itself.
TEST(Findings, AreNoStepOfTheProofWhereNoneIsPutIntoTheModel) {
  Diagnosis d = test::diagnosis_by_hand();
  const auto said = [&] {
    std::string all;
    for (const std::string& line : summary_lines(d)) all += line.substr(line.find_first_not_of(' ')) + " ";
    return all;
  };
  EXPECT_EQ(count(said(), "with findings"), 3u) << said();
  EXPECT_EQ(count(said(), "% of the mismatch"), 2u) << said();
  d.findings.resize(2);
  d.findings[0].effect = "unknown";
  d.findings[1].effect = "truth_time_offset";
  d.findings[1].share_of_mismatch = 0.0;
  d.verdict = Verdict::unknown_effect;
  EXPECT_EQ(count(said(), "with findings"), 0u) << said();
  EXPECT_EQ(count(said(), "% of the mismatch"), 0u) << said();
  const std::string page = diagnosis_report(d).text();
  EXPECT_EQ(count(page, "calibrated, and what was found"), 0u);
  EXPECT_EQ(count(page, "share of the mismatch"), 0u);
}

TEST(FaultsTogether, SayOnceWhatHappensInSeveralRecordingsAndWheels) {
  std::vector<Finding> findings(7);
  for (std::size_t k = 0; k < findings.size(); ++k) {
    findings[k].effect = k == 0 ? "bump" : k == 6 ? "truth_frozen" : "encoder_data_fault";
    findings[k].component = k == 0 ? "left_wheel" : k == 6 ? "truth" : k % 2 == 0 ? "left_wheel" : "right_wheel";
    findings[k].where.recording = "run_" + std::to_string(k);
    findings[k].where.time_s = {{1.0, 2.0}, {3.0, 3.5}};
  }
  const std::vector<Finding> together = faults_together(findings);
  ASSERT_EQ(together.size(), 3u);
  EXPECT_EQ(together[0].effect, "bump");
  EXPECT_EQ(together[2].effect, "truth_frozen");
  EXPECT_EQ(together[2].where.recording, "run_6") << "one alone stays as it is";
  const Finding& all = together[1];
  EXPECT_EQ(all.sentence.substr(0, 8), "10 times");
  EXPECT_NE(all.where.regime.find("run_1 at 1.00 to 2.00 s, 3.00 to 3.50 s (the right wheel)"), std::string::npos)
      << all.where.regime;
  EXPECT_NE(all.where.regime.find("in one recording or part more"), std::string::npos) << all.where.regime;
  EXPECT_EQ(faults_together({findings.begin(), findings.begin() + 1}).size(), 1u);
}

TEST(DiagnosisReport, IsOnePageWithEveryPart) {
  const std::string html = diagnosis_report(test::diagnosis_by_hand()).text();
  EXPECT_EQ(count(html, "<h1>What the model lacks"), 1u);
  for (const char* part :
       {"What was found", "Where the model and the recordings differ", "What the mismatch depends on", "The evidence",
        "The proof", "could not show", "What to drive next", "Calibration", "To be aware of"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
  // two recordings, each with its track before and after and its residual; a response; evidence; before and after
  EXPECT_EQ(count(html, "<svg "), 2u * 3u + 3u);
  EXPECT_NE(html.find("none would show"), std::string::npos);  // of the effect that no drive here could show
  EXPECT_EQ(html.find("src="), std::string::npos);
  EXPECT_EQ(html.find("href="), std::string::npos);
  EXPECT_EQ(html.find("nan"), std::string::npos);
  EXPECT_LT(html.size(), 1000000u);
  const char* path = std::getenv("ODOLAB_REPORT_OUT");  // to look at it
  if (path) {
    ASSERT_TRUE(write_report(path, diagnosis_report(test::diagnosis_by_hand())));
  }
}

// Of what has no name nothing can be switched on.
TEST(DiagnosisReport, SaysNothingOfASimulatorInWhichNothingWasSwitchedOn) {
  Diagnosis d = test::diagnosis_by_hand();
  EXPECT_NE(diagnosis_report(d).text().find("with what was found switched on"), std::string::npos);
  d.simulation.with_findings = d.simulation.calibrated;
  EXPECT_EQ(diagnosis_report(d).text().find("with what was found switched on"), std::string::npos);
  EXPECT_NE(diagnosis_report(d).text().find("Simulator: calibrated"), std::string::npos);
  for (const std::string& line : summary_lines(d))
    if (line.find("simulator:") != std::string::npos) {
      EXPECT_EQ(line.find("with findings"), std::string::npos) << line;
    }
}

TEST(DiagnosisReport, DrawsNoErrorsWhereNoneCouldBeGathered) {
  // As of a truth without headings: chi-square is known, the error over a metre is not.
  Diagnosis d = test::diagnosis_by_hand();
  const FitFigures not_gathered{0.0, 0.0, 1.1};
  d.train = d.held_out = {};
  d.train.calibrated = d.train.with_findings = d.simulation.calibrated = d.simulation.with_findings = not_gathered;
  const std::string html = diagnosis_report(d).text();
  EXPECT_NE(html.find("not measured"), std::string::npos);
  EXPECT_EQ(html.find("position error [mm]"), std::string::npos);
}

TEST(DiagnosisReport, SaysToItsEndHowLikelyUnseenRecordingsAre) {
  Diagnosis d = test::diagnosis_by_hand();
  d.unseen_gain = -12587.5;
  EXPECT_NE(
      diagnosis_report(d).text().find("less likely by 12587.5 in log-likelihood with what was found than with the "
                                      "calibration alone."),
      std::string::npos);
}

TEST(DiagnosisReport, AnEmptyDiagnosisHasAPageToo) {
  const std::string html = diagnosis_report({}).text();
  EXPECT_NE(html.find("cannot say"), std::string::npos);
  EXPECT_EQ(count(html, "<svg "), 0u);
}

}  // namespace
}  // namespace odolab
