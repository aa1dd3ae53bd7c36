// A robot whose missing physics is concealed, drawn from a seed: for whoever wants to find it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/advice/advised_drive.h"
#include "core/diagnosis/fitted_model.h"
#include "physics/experiments/concealed/drawn_case.h"

namespace odolab {

// What was drawn. Most have one effect of the catalogue; about one in seven has none, and one in seven has one that
// stands in no list.
struct DrawnMystery {
  std::uint64_t seed = 0;
  Vehicle nominal;                    // the vehicle's file, wrong by a few per cent
  std::vector<Recording> recordings;  // four to six runs
  concealed::Kind kind = concealed::Kind::nothing;
  ActiveEffect effect;       // of Kind::one; of Kind::outside its own name
  concealed::RunPlan robot;  // to be driven again
};

// The same seed gives the same mystery to the bit. Takes a few seconds; none where `progress` stops it.
std::optional<DrawnMystery> drawn_mystery(std::uint64_t seed, const Progress& progress = {});

// What a person may guess: "" for nothing, kOutsideGuess for what is in no list, else names of the catalogue.
inline const std::string kOutsideGuess = "outside";
std::vector<std::string> mystery_guesses();
// What would have been right to guess.
std::string right_guess(const DrawnMystery& mystery);

// A robot as a model says that it is, with the noise that was fitted: to be driven in the planar world.
concealed::RunPlan robot_of(const FittedModel& model, const FittedNoise& noise);

// The drive that was advised, as that robot records it, from that start of the axle. Events of other runs do not act.
Recording advised_run(const concealed::RunPlan& robot, const std::vector<DriveLeg>& legs, const Pose& start,
                      const std::string& name, std::uint64_t seed);
// The way it should go.
std::vector<Vec2> advised_path(const DifferentialDrive& drive, const std::vector<DriveLeg>& legs, const Pose& start);

}  // namespace odolab
