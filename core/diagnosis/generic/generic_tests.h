// Whether anything is left that the model does not describe, whatever its name: a generic basis in each channel.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/model/joint_model.h"

namespace odolab {

// Values of a group that are cosines and sines of an angle, of once, twice, ... that angle.
struct GenericWave {
  std::string variable;  // "left wheel angle [rad]"
  std::vector<std::size_t> cosine, sine;
};

// What a group comes to along an axis of its own.
struct GenericCurve {
  std::string variable, channel;
  std::vector<double> at;
  std::vector<std::vector<double>> basis;  // of each point by each value of the group
};

// Of the evidence of names that stand, what may stay without a name beside them.
constexpr double kMostLeft = 0.15;

struct GenericTest {
  std::string variable, channel;  // "yaw rate [rad/s]", "turn per metre [rad/m]"
  std::string component = "vehicle";
  CandidateTest test;            // beside all that was let in
  CandidateTest instead;         // and in its place; the same where nothing was
  double under_own_noise = 1.0;  // times so much, where `test` was asked under the noise that the group leaves
  double tests = 1.0;            // that it was chosen from
  double p_value = 1.0;          // of `test`, over all of them
  double p_value_of(const CandidateTest& of) const;
  std::vector<double> at;          // where the hats stand, in units of the variable; empty where it has no axis
  std::vector<GenericWave> waves;  // where it is periodic instead
  std::vector<GenericCurve> curves;
  std::optional<WhereFound::Zone> zone;     // where it asks of a patch of floor alone
  std::shared_ptr<const Effect> as_effect;  // the group as a term that can be let into a model
  // Where a truth that sways within its own error would do the same (`swaying_truth.h`): what it says of it.
  struct Sway {
    double to_either_side_m = 0.0, p_value = 1.0;
    CandidateTest test;
  };
  std::optional<Sway> sway;
  double most_left = kMostLeft;   // more where a name is but its simplest form
  bool of_when_or_where = false;  // of the recording, the time or the place: no form of how a base follows its commands
  bool is_no_rival_of_names = false;  // but of pushes: what a name says at a place, it says as well
  bool is_of_the_clock = false;       // by when the truth is late: no rate of a clock stands beside it
  bool carries_nowhere = false;       // comes and goes so soon: no name is doubted for it
  double times_a_turn = 0.0;  // of a wheel, where it goes with its angle: a cosine and a sine for each recording
};

// Of four channels: forward, sideways and turn, each for each metre of way, and the turn for each radian that is
// turned, as where the wheelbase is another one. Their names, and the motion of one unit of a channel, but the last, in
// a step.
constexpr int kGenericChannels = 4, kTurnOfItself = 3;
// And what one wheel alone does, for each metre that it rolls.
constexpr int kLeftWheelAlone = 4, kRightWheelAlone = 5;
// And the turn for each metre forwards, which in reverse is to the other side, as where one wheel drags.
constexpr int kTurnForwards = 6;
// And the way itself, for each metre forwards and less for each back: of a wheel that slips, or a carpet that gives
// way.
constexpr int kWayItself = 7;
const char* name_of_channel(int channel);
// Of which part a channel says something, by its name: "truth", "left_wheel", "right_wheel"; else "vehicle".
std::string part_of_channel(const std::string& channel);
BodyMotion unit_of_channel(const EffectStep& step, double wheelbase_m, int channel);

// Many columns find whatever direction calibration nearly takes up, and a derivative by smoothed readings is not known
// better than to a fifth where the vehicle speeds up: directions of which less than the square of that is left may be
// its error, and are not tested.
constexpr AskedHow kAskedOfGeneric{.least_surviving = 0.04, .scatters_as_its_like = false, .is_drawn = true};

// A model, and what it comes to with all that was let in and without.
struct AskedModel {
  explicit AskedModel(const JointModel& model);
  const JointModel& joint;
  std::vector<std::shared_ptr<const JointModel::Asked>> with_and_without;  // one where nothing was let in
  bool counts_are_coarse;
  std::vector<std::vector<BodyMotion>> scores;  // of the motion in each step of each run (`score_of_motions`)
};

// Tests a group's term against the model, as one of so many that were looked at.
void ask(GenericTest& test, const AskedModel& asked, std::shared_ptr<const Effect> term, double looked_at,
         const AskedHow& how = kAskedOfGeneric);
// The same of a term of so many amplitudes, with the motion of each in a drive.
using MotionsOfTerm = std::function<std::vector<Motions>(const DriveView&, const std::vector<double>& shape)>;
GenericTest asked_of(const AskedModel& asked, const std::string& variable, const std::string& channel,
                     std::size_t amplitudes, MotionsOfTerm motions, double looked_at,
                     const AskedHow& how = kAskedOfGeneric);

// Hats, harmonics and polynomials of what the vehicle does and where it is, waves (`waves.h`) and what bends the truth
// (`bent_truth.h`). Best first.
std::vector<GenericTest> generic_tests(const JointModel& joint);

}  // namespace odolab
