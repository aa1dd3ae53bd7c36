#include "core/io/mismatch_csv.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/io/number_text.h"
#include "core/io/whole_file.h"

namespace odolab {

Result<Done> write_mismatch_csv(const std::string& path, const MismatchOverTime& mismatch, const Track& truth,
                                const Track& simulated, const std::vector<std::pair<double, double>>& stretches) {
  std::string text =
      "time_s,x_m,y_m,heading_rad,simulated_x_m,simulated_y_m,simulated_heading_rad,mismatch_calibrated,"
      "mismatch_with_findings\n";
  const auto cell = [](bool there, double value) { return "," + (there ? number_text(value) : std::string()); };
  std::size_t k = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double t = truth[i].time_s;
    while (k < mismatch.time_s.size() && mismatch.time_s[k] < t - 1e-9) ++k;
    if (!stretches.empty() &&
        std::none_of(stretches.begin(), stretches.end(), [&](const auto& s) { return t >= s.first && t <= s.second; }))
      continue;
    const bool judged = k < mismatch.time_s.size() && std::abs(mismatch.time_s[k] - t) < 1e-9;
    const std::optional<Pose> driven = pose_at(simulated, t);
    const Pose s = driven.value_or(Pose{});
    text += number_text(t);
    for (double v : {truth[i].pose.x_m, truth[i].pose.y_m, truth[i].pose.heading_rad}) text += cell(true, v);
    for (double v : {s.x_m, s.y_m, s.heading_rad}) text += cell(driven.has_value(), v);
    text += cell(judged, judged ? mismatch.before[k] : 0.0);
    text += cell(judged && k < mismatch.after.size(), judged && k < mismatch.after.size() ? mismatch.after[k] : 0.0);
    text += "\n";
  }
  return write_whole_file(path, text);
}

}  // namespace odolab
