#include "physics/experiments/concealed/drawn_effect.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/geometry/angles.h"
#include "physics/experiments/concealed/own_effects.h"

namespace odolab::concealed {

namespace {

enum class On { wheel, wheel_or_both, vehicle, floor };

struct Form {
  const char* name;
  On on;
  const char* amplitude;
  double medium;   // the size that matters in practice
  double largest;  // factor on it
  bool signed_size;
};

// A collision, a load and what has a direction are drawn below.
const Form kForms[] = {
    {"wheel_eccentricity", On::wheel, "amplitude", 0.005, 10.0, false},
    {"encoder_missed_counts", On::wheel, "fraction", 0.01, 20.0, false},
    {"drivetrain_backlash", On::wheel_or_both, "gap_rad", 0.03, 10.0, false},
    {"castor_reversal_kick", On::vehicle, "kick_rad", 0.01, 15.0, true},
    {"radius_drift", On::wheel_or_both, "per_s", 1e-4, 10.0, true},
    {"tyre_compression", On::vehicle, "radius_change_m_per_mps2", 5e-4, 15.0, false},
    {"speed_dependent_radius", On::wheel_or_both, "per_mps", 0.02, 10.0, true},
    {"payload_radius_change", On::vehicle, "left", 0.004, 8.0, true},
    {"lateral_slip", On::vehicle, "m_per_s_per_mps2", 0.02, 10.0, false},
    {"traction_slip", On::vehicle, "per_mps2", 0.02, 10.0, false},
    {"turn_scrub", On::vehicle, "per_radps", 0.01, 15.0, false},
    {"one_sided_drag", On::vehicle, "rad_per_m", 0.01, 10.0, true},
    {"bump", On::wheel, "extra_distance_m", 0.005, 3.5, false},
    {"slip_zone", On::floor, "slip", 0.05, 10.0, false},
    {"floor_slope_creep", On::floor, "creep_mps", 0.001, 20.0, false},
    {"collision", On::vehicle, "dheading_rad", 0.03, 8.0, true},
    {"turn_speed_loss", On::vehicle, "per_radps", 0.02, 10.0, false},
    {"clock_rate", On::vehicle, "rate", 5e-4, 40.0, true},
};

std::string component(Random& random, On on) {
  const double u = random.uniform();
  switch (on) {
    case On::wheel:
      return u < 0.5 ? "left_wheel" : "right_wheel";
    case On::wheel_or_both:
      return u < 0.4 ? "left_wheel" : u < 0.8 ? "right_wheel" : "both_wheels";
    case On::floor:
      return "floor";
    case On::vehicle:
      break;
  }
  return "vehicle";
}

void draw_form(Random& random, DrawnEffect& drawn, const std::string& name, double size, int given_runs) {
  auto& p = drawn.active.parameters;
  const auto some_run = [&] { return std::min(given_runs - 1, static_cast<int>(random.uniform() * given_runs)); };
  if (name == "wheel_eccentricity") p.push_back({"phase_rad", random.uniform(-kPi, kPi)});
  if (name == "encoder_missed_counts") p.push_back({"above_radps", random.uniform(2.0, 5.0)});
  if (name == "floor_slope_creep") p.push_back({"direction_rad", random.uniform(-kPi, kPi)});
  if (name == "payload_radius_change") {
    p.push_back({"right", size * random.uniform(0.3, 1.5)});
    drawn.amplitudes.push_back("right");
    drawn.only_in_run = some_run();
  }
  if (name == "collision") {
    const double direction = random.uniform(-kPi, kPi), way_m = 0.6 * std::abs(size);
    p.push_back({"dx_m", way_m * std::cos(direction)});
    p.push_back({"dy_m", way_m * std::sin(direction)});
    drawn.amplitudes.insert(drawn.amplitudes.end(), {"dx_m", "dy_m"});
    drawn.only_in_run = some_run();
  }
  if (name == "slip_zone") p.push_back({"radius_m", random.uniform(0.25, 0.6)});
  if (name == "bump") p.push_back({"radius_m", 0.1});
  if (name == "drivetrain_backlash" && random.uniform() < 0.5)  // of a wheel that runs easily
    p.push_back({"drag_mps2", random.uniform(0.05, 0.4)});
  drawn.at_a_place = name == "slip_zone" || name == "bump";
}

}  // namespace

DrawnEffect DrawnEffect::scaled(double factor) const {
  DrawnEffect out = *this;
  for (auto& [name, value] : out.active.parameters)
    if (std::find(amplitudes.begin(), amplitudes.end(), name) != amplitudes.end()) value *= factor;
  out.largest /= factor;
  return out;
}

const std::vector<std::string>& drawable_effects() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Form& form : kForms) list.emplace_back(form.name);
    return list;
  }();
  return names;
}

DrawnEffect drawn_effect(Random& random, const std::string& name, int given_runs) {
  DrawnEffect drawn;
  if (const OutsideEffect* outside = outside_effect(name)) {
    drawn.outside = true;
    drawn.at_a_place = outside->at_a_place;
    drawn.amplitudes = {"amplitude"};
    drawn.largest = 20.0;
    const double sign = random.uniform() < 0.5 ? -1.0 : 1.0;
    drawn.active = {name,
                    "vehicle",
                    {{"amplitude", sign * outside->medium},
                     {"x_m", random.uniform(-0.8, 0.8)},
                     {"y_m", random.uniform(-0.8, 0.8)},
                     {"direction_rad", random.uniform(-kPi, kPi)},
                     {"length_m", random.uniform(0.6, 1.5)},
                     {"period_s", random.uniform(5.0, 12.0)},
                     {"cools_s", random.uniform(8.0, 20.0)}}};
    return drawn;
  }
  const Form* form = std::find_if(std::begin(kForms), std::end(kForms), [&](const Form& f) { return name == f.name; });
  assert(form != std::end(kForms));
  const double sign = form->signed_size && random.uniform() < 0.5 ? -1.0 : 1.0;
  const double size = sign * form->medium;
  drawn.active = {name, component(random, form->on), {{form->amplitude, size}}};
  drawn.amplitudes = {form->amplitude};
  drawn.largest = form->largest;
  draw_form(random, drawn, name, size, given_runs);
  return drawn;
}

}  // namespace odolab::concealed
