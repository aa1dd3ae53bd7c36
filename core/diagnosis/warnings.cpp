#include "core/diagnosis/warnings.h"

#include <cmath>

#include "core/base/formatted.h"
#include "core/base/two_digits.h"
#include "core/geometry/angles.h"

namespace odolab {

namespace {

std::string ripple_in_words(const Adequacy::Ripple& r) {
  return "the " + r.channel.substr(0, r.channel.find(" per metre")) +
         formatted(" comes and goes %.3g times a turn, by ", r.times_a_turn) +
         formatted("%.2g %% of it, as a gear before it makes it do; it adds up to nothing over any way",
                   100.0 * r.amplitude);
}

std::string ripple_in_words(const Adequacy::Sway& sway) {
  return "the vehicle, or the truth by itself, comes and goes by " + two_digits(1e3 * sway.to_either_side_m) +
         " mm to either side with " + sway.wave +
         ": no more than one sample of the truth errs, so which of both it is cannot be told; a stop of "
         "two such waves would tell";
}

std::string lasting_in_words(const FittedNoise& noise) {
  const double spread = std::sqrt(0.5 * noise.wander_lasts_s);
  const double off_rad = spread * noise.heading_wander_rad_per_sqrt_s;
  return formatted("the truth's error lasts for about %.2g s: ", noise.wander_lasts_s) +
         two_digits(1e3 * spread * noise.wander_m_per_sqrt_s) + " mm" +
         (off_rad > 0.0 ? formatted(" and %.2g degrees", off_rad * 180.0 / kPi) : "") + " of it, beside " +
         two_digits(1e3 * noise.truth_position_m) + " mm from one sample to the next; this is reckoned with";
}

}  // namespace

std::vector<std::string> warnings_beside(const JointModel& joint, const Adequacy& adequacy) {
  std::vector<std::string> warnings;
  if (adequacy.something_small_is_left)
    warnings.push_back(
        "beside the names given something small is left that no name describes, or the truth's noise is not white");
  for (const Adequacy::Ripple& r : adequacy.ripples) warnings.push_back(ripple_in_words(r));
  constexpr double kUneven_s = 0.02;
  if (const double timing_s = joint.model.noise.command_timing_s; timing_s > kUneven_s)
    warnings.push_back(
        formatted("the base acts on each change of its command %.2g s sooner or later than on another, as "
                  "where it asks for commands every so often: that is taken for noise",
                  timing_s));
  if (const FittedNoise noise = joint.noise_as_recorded(); noise.wander_lasts_s > 0.0)
    warnings.push_back(lasting_in_words(noise));
  if (adequacy.sway) warnings.push_back(ripple_in_words(*adequacy.sway));
  return warnings;
}

}  // namespace odolab
