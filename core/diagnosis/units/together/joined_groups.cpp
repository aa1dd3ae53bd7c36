#include "core/diagnosis/units/together/joined_groups.h"

#include <algorithm>
#include <cmath>

#include "core/calibration/smoothed_readings.h"
#include "core/diagnosis/generic/generic_tests.h"
#include "core/diagnosis/generic/groups.h"
#include "core/diagnosis/units/joint_errors.h"
#include "core/vehicle/key_words.h"

namespace odolab {

namespace {

std::vector<Motions> motions_of_group(const Group& group, const DriveView& view, int channel) {
  std::vector<std::vector<double>> values;
  group.values(view, values);
  std::vector<Motions> all(values.size(), Motions(view.steps.size()));
  for (std::size_t f = 0; f < values.size(); ++f)
    for (std::size_t i = 0; i < view.steps.size(); ++i) {
      const BodyMotion unit = unit_of_channel(view.steps[i], view.drive.wheelbase_m, channel);
      all[f][i] = {values[f][i] * unit.forward_m, values[f][i] * unit.sideways_m, values[f][i] * unit.turn_rad};
    }
  return all;
}

// What goes with a reading must not go with what that reading errs by.
std::vector<UnitSample> with_smooth_joints(std::vector<UnitSample> samples) {
  for (std::size_t j = 0; j < samples.front().joints.size(); ++j) {
    std::vector<WheelSample> readings;
    for (const UnitSample& s : samples) readings.push_back({s.time_s, s.joints[j], 0.0});
    const std::vector<WheelSample> smooth = smoothed(readings);
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i].joints[j] = smooth[i].left_rad;
  }
  return samples;
}

std::size_t functions_of(const Group& group, const DriveView& view) {
  std::vector<std::vector<double>> values;
  group.values(view, values);
  return values.size();
}

}  // namespace

std::vector<JoinedGroup> joined_groups(const JoinedModel& model) {
  std::vector<JoinedGroup> all;
  const std::vector<VehicleUnit> units = units_of(model.vehicle());
  for (std::size_t u = 0; u < units.size(); ++u) {
    const std::vector<DriveView>& views = model.views(u);
    const std::string component = units[u].name.empty() ? "vehicle" : units[u].name;
    for (const Group& group : groups_of(views, shaken_by_wheels(views))) {
      const std::size_t functions = functions_of(group, views.front());
      for (int channel = 0; channel < kTurnOfItself; ++channel)
        all.push_back({component,
                       std::string(name_of_channel(channel)) + " of " +
                           (units[u].name.empty() ? "the towing vehicle" : part_words(units[u].name)) + " goes with " +
                           group.variable,
                       [=](const JoinedModel& m) {
                         return m.columns_of(
                             [&](const DriveView& view) { return motions_of_group(group, view, channel); }, functions,
                             {u});
                       },
                       {}});
    }
  }
  for (JoinedGroup& of_joint : groups_of_joints(model)) all.push_back(std::move(of_joint));
  return all;
}

std::vector<JoinedGroup> groups_of_joints(const JoinedModel& model) {
  std::vector<JoinedGroup> all;
  std::vector<std::vector<UnitSample>> samples;
  for (const JoinedRun& run : model.given()) samples.push_back(with_smooth_joints(run.samples));
  for (std::size_t u = 0; u < model.units(); ++u) {
    const auto errors = joint_errors(samples, model.names(), model.vehicle(), u);
    if (!errors) continue;
    for (const TruthError& error : *errors) {
      // Without a truth the wheels' size is the file's, and a length that goes with it may be read truly.
      if (!model.follows_truth() && error.variable == kWhatItReads && error.is_of_a_length) continue;
      all.push_back({error.component, error.channel + " goes with " + error.variable,
                     [term = error.term, u](const JoinedModel& m) {
                       return m.columns_of([&](const DriveView& view) { return term->motions(view, {}); },
                                           term->amplitudes.size(), {u});
                     },
                     error.is_more_than_rounding});
    }
  }
  return all;
}

}  // namespace odolab
