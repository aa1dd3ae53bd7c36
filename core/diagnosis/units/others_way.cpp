#include "core/diagnosis/units/others_way.h"

#include <algorithm>

#include "core/odometry/cast.h"
#include "core/odometry/differential_drive.h"

namespace odolab {

Vehicle without_mounting(Vehicle vehicle) {
  vehicle.truth = {};
  return vehicle;
}

Result<Track> way_by_others(const Known& known, const std::vector<UnitSample>& samples, std::size_t without) {
  if (const auto* platform = std::get_if<MultiCastor>(&known.vehicle.kind)) {
    std::vector<CastorSample> readings;
    for (const UnitSample& s : samples) {
      CastorSample sample{s.time_s, {}};
      for (std::size_t k = 0; k < s.wheels.size(); ++k) sample.castors.push_back({s.wheels[k], s.joints[k]});
      readings.push_back(std::move(sample));
    }
    CastOptions options;
    options.left_out = without < known.drives.size() ? static_cast<int>(without) + 1 : 0;
    if (const std::string problem = problem_in(options, *platform); !problem.empty())
      return Error{known.vehicle.name + ": " + problem, "", ""};
    return castor_track(readings, *platform, Pose{}, options);
  }
  const std::size_t by = without == 0 ? 1 : 0;
  const Track way = way_of(samples, by, known.drives[by]);
  Track track;
  for (const UnitSample& s : samples)
    track.push_back({s.time_s, *pose_at(way, s.time_s) * inverse(tracked_T_axle(known.vehicle, by, s.joints))});
  unwrap_headings(track);
  return track;
}

bool lasts(const Finding& finding) {
  return std::none_of(finding.parameters.begin(), finding.parameters.end(),
                      [](const FoundParameter& p) { return p.name == "x_m" || p.name == "at_s"; });
}

}  // namespace odolab
