#include "core/diagnosis/generic/contradicted.h"

#include <gtest/gtest.h>

#include "core/diagnosis/effects/effect.h"
#include "test/support/calibrated_model.h"
#include "test/support/missing_physics.h"

namespace odolab {
namespace {

struct NamesAndEvidence {
  std::vector<AcceptedEffect> names;
  std::vector<ScoredCandidate> evidence;
};

NamesAndEvidence named_with(const std::vector<std::pair<const char*, double>>& gains) {
  NamesAndEvidence all;
  for (const auto& [name, gain] : gains) {
    AcceptedEffect a;
    a.effect = catalogue_entry({name, "", {}});
    ScoredCandidate c;
    c.effect = a.effect;
    c.test.statistic = gain;
    all.names.push_back(a);
    all.evidence.push_back(c);
  }
  return all;
}

bool are_too_many(const std::vector<std::pair<const char*, double>>& gains) {
  const NamesAndEvidence all = named_with(gains);
  return what_so_many_names_stand_for(all.names, all.evidence).has_value();
}

// A load that moves the points on which its tyres stand had a patch of floor, two pushes and a load; gusts had a patch,
// two pushes and a creep.
TEST(Contradicted, ThreeNamesOfWhichTwoAreOfPlacesAndMomentsAreOneCauseWithoutAName) {
  EXPECT_TRUE(are_too_many({{"payload_radius_change", 179.0}, {"collision", 66.0}, {"collision", 46.0}}));
  EXPECT_TRUE(are_too_many({{"slip_zone", 54.0}, {"collision", 37.0}, {"floor_slope_creep", 20.0}}));
  const NamesAndEvidence all = named_with({{"slip_zone", 54.0}, {"bump", 37.0}, {"floor_slope_creep", 20.0}});
  const std::optional<Unnamed> of = what_so_many_names_stand_for(all.names, all.evidence);
  ASSERT_TRUE(of);
  EXPECT_EQ(of->gain, 111.0);
  EXPECT_EQ(of->where.regime,
            "what would take 3 causes at once (slip zone, bump, floor slope creep), 2 of them each at a place or a "
            "moment of its own");
}

// A floor with a patch and two sills, each met again and again: none of them is in doubt. Nor are sills alone, nor one
// place beside what acts all along.
TEST(Contradicted, NamesThatAreBeyondDoubtOrOfOneKindStandHoweverManyTheyAre) {
  EXPECT_FALSE(are_too_many({{"slip_zone", 900.0}, {"bump", 300.0}, {"bump", 250.0}}));
  EXPECT_FALSE(are_too_many({{"bump", 90.0}, {"bump", 60.0}, {"bump", 50.0}}));
  EXPECT_FALSE(are_too_many({{"wheel_eccentricity", 90.0}, {"tyre_compression", 60.0}, {"bump", 50.0}}));
  EXPECT_FALSE(are_too_many({{"slip_zone", 54.0}, {"bump", 37.0}}));
}

// A sill that one wheel climbs in its middle and both climb at its edge, beside a castor's kicks.
TEST(Contradicted, TwoBumpsAtOnePlaceAreOneThing) {
  for (const double apart_m : {0.05, 0.5}) {
    NamesAndEvidence all = named_with({{"castor_reversal_kick", 900.0}, {"bump", 117.0}, {"bump", 98.0}});
    for (std::size_t k : {1, 2}) {
      all.names[k].effect =
          catalogue_entry({"bump", k == 1 ? "left_wheel" : "both_wheels", {{"x_m", 0.0}, {"y_m", 0.0}}});
      all.names[k].shape = {-3.0, k == 1 ? 10.0 : 10.0 + apart_m, 0.0};
    }
    EXPECT_EQ(what_so_many_names_stand_for(all.names, all.evidence).has_value(), apart_m > 0.1);
  }
}

// Two pushes beside a drag: in one recording they may be what makes the drag, each in its own they are two pushes.
TEST(Contradicted, APushInEachOfTwoRecordingsIsAPush) {
  for (const double second : {0.0, 1.0}) {
    NamesAndEvidence all = named_with({{"one_sided_drag", 215.0}, {"collision", 690.0}, {"collision", 70.0}});
    all.names[1].shape = {0.0, 30.0, 0.0};
    all.names[2].shape = {second, 40.0, 0.0};
    EXPECT_EQ(what_so_many_names_stand_for(all.names, all.evidence).has_value(), second == 0.0);
  }
}

// The noise that is believed, against the error of dead reckoning: by the noise that there is they agree.
TEST(Contradicted, DeadReckoningThatErrsByMoreThanAllNoiseLacksSomething) {
  test::CaseSettings settings;
  settings.runs = 4;
  settings.duration_s = 120.0;
  const test::Case c = test::generated_case(settings, 9109);
  for (const double believed : {1.0, 0.5}) {
    JointModel joint = test::calibrated_model(c.recordings, c.nominal);
    joint.fit_noise_and_all();
    FittedNoise& noise = joint.model.noise;
    for (double* size : {&noise.wheel_m_per_sqrt_m, &noise.along_m_per_sqrt_m, &noise.turning_m_per_sqrt_m,
                         &noise.sideways_m_per_sqrt_m, &noise.truth_position_m, &noise.truth_heading_rad})
      *size *= believed;
    joint.linearise();
    EXPECT_EQ(what_no_noise_makes(joint, joint).has_value(), believed < 1.0);
  }
}

}  // namespace
}  // namespace odolab
