#include "core/scenario/effect_catalogue.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/base/formatted.h"
#include "core/diagnosis/effects/forms.h"

namespace odolab {

namespace {

const std::vector<std::string> kWheels = {"left_wheel", "right_wheel", "both_wheels"};
const std::vector<std::string> kVehicle = {"vehicle"};
const std::vector<std::string> kVehicleOrWheels = {"vehicle", "both_wheels"};
const std::vector<std::string> kVehicleOrAnyWheel = {"vehicle", "left_wheel", "right_wheel", "both_wheels"};
const std::vector<std::string> kTruth = {"truth"};

constexpr double kFar = 1e6;      // metres or seconds
constexpr double kEver_s = 1e11;  // stamps may count from 1970
constexpr bool kRequired = true;

const std::vector<EffectParameter> kWhen = {
    {"at_s", -kEver_s, kEver_s}, {"every_s", 1e-3, kFar}, {"lasts_s", 0.0, kFar}};

std::vector<EffectParameter> with_when(std::vector<EffectParameter> parameters) {
  parameters.insert(parameters.end(), kWhen.begin(), kWhen.end());
  return parameters;
}

// The number of one of its ways of showing (core/diagnosis/effects/README.md).
EffectParameter number_of_form(std::size_t forms) { return {"form", 0.0, static_cast<double>(forms) - 1.0}; }

bool gives(const ActiveEffect& active, const std::string& name) {
  return std::any_of(active.parameters.begin(), active.parameters.end(),
                     [&](const auto& given) { return given.first == name; });
}

std::string joined_by_or(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
  return text;
}

bool is_one_of(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_part(const std::string& word) {
  if (word == "truck_a" || word == "truck_b" || word == "trailer") return true;
  return word.size() == 7 && word.rfind("castor", 0) == 0 && word[6] >= '1' && word[6] <= '9';
}

// The largest number of a form, which of a bump goes by where and when it is.
double largest_form(const ActiveEffect& active, const EffectParameter& form) {
  if (active.effect != "bump") return form.at_most;
  if (gives(active, "length_m")) return static_cast<double>(std::size(effects::kCablesClimbed)) - 1.0;
  if (!gives(active, "at_s")) return form.at_most;
  const std::size_t forms =
      active.component == "both_wheels" ? std::size(effects::kBumpsOfBoth) : std::size(effects::kBumpsOnce);
  return static_cast<double>(forms) - 1.0;
}

void check_given(const ActiveEffect& active, const EffectEntry& entry, const std::string& key,
                 std::vector<std::string>& problems) {
  for (const auto& [name, value] : active.parameters) {
    const auto known = std::find_if(entry.parameters.begin(), entry.parameters.end(),
                                    [&, &wanted = name](const EffectParameter& p) { return p.name == wanted; });
    if (known == entry.parameters.end()) {
      std::vector<std::string> names;
      for (const EffectParameter& p : entry.parameters) names.push_back(p.name);
      problems.push_back(key + "." + name + ": found a parameter that " + entry.name + " does not have, expected " +
                         joined_by_or(names));
    } else if (name == "form") {
      const double most = largest_form(active, *known);
      if (!(value >= 0.0 && value <= most && value == std::floor(value)))
        problems.push_back(key + formatted(".form: found %g, expected a whole number from 0 to %g", value, most));
    } else if (!(value >= known->at_least && value <= known->at_most)) {
      problems.push_back(key + "." + name +
                         formatted(": found %g, expected %g to %g", value, known->at_least, known->at_most));
    }
  }
}

void check_parameters(const ActiveEffect& active, const EffectEntry& entry, const std::string& key,
                      std::vector<std::string>& problems) {
  check_given(active, entry, key, problems);
  for (const EffectParameter& p : entry.parameters)
    if (is_wanted(p, gives(active, "at_s")) && !gives(active, p.name))
      problems.push_back(key + "." + p.name + ": found nothing, expected a number");
}

}  // namespace

bool is_wanted(const EffectParameter& parameter, bool at_a_time) {
  const bool is_of_a_place = parameter.name == "x_m" || parameter.name == "y_m";
  return parameter.required && !(at_a_time && is_of_a_place);
}

const std::vector<EffectEntry>& effect_catalogue() {
  static const std::vector<EffectEntry> entries = {
      {"wheel_eccentricity", kWheels, {{"amplitude", 0.0, 0.5, kRequired}, {"phase_rad"}}},
      {"encoder_missed_counts",
       kWheels,
       {{"fraction", 0.0, 0.99, kRequired},
        {"above_radps", 0.0, 1e4},
        number_of_form(std::size(effects::kMissedForms))}},
      {"drivetrain_backlash",
       kWheels,
       {{"gap_rad", 0.0, 3.0, kRequired}, {"drag_mps2", 0.0, 100.0}, number_of_form(std::size(effects::kPlayForms))}},
      {"wheel_toe", kVehicleOrWheels, {{"sideways_per_metre", -0.5, 0.5, kRequired}}},
      {"castor_reversal_kick",
       kVehicle,
       {{"kick_rad", -1.0, 1.0, kRequired}, {"over_m", 1e-3, 1.0}, number_of_form(std::size(effects::kKickForms))}},
      {"radius_drift",
       kWheels,
       {{"per_s", -0.1, 0.1, kRequired},
        {"time_constant_s", 1e-3, kFar},
        {"at_mps", 1e-3, 1e3},
        number_of_form(std::size(effects::kDriftForms))}},
      {"tyre_compression",
       kVehicleOrAnyWheel,
       {{"radius_change_m_per_mps2", -0.1, 0.1, kRequired}, number_of_form(std::size(effects::kTyreForms))}},
      {"speed_dependent_radius",
       kWheels,
       {{"per_mps", -0.5, 0.5, kRequired}, {"at_mps", 1e-3, 1e3}, number_of_form(std::size(effects::kSpeedForms))}},
      {"payload_radius_change",
       kVehicleOrWheels,
       {{"left", -0.5, 0.5}, {"right", -0.5, 0.5}, {"at_s", -kEver_s, kEver_s, kRequired}}},
      {"lateral_slip",
       kVehicleOrWheels,
       {{"m_per_s_per_mps2", -1.0, 1.0, kRequired},
        {"at_mps", 1e-3, 1e3},
        number_of_form(std::size(effects::kLateralSlipForms))}},
      {"traction_slip",
       kVehicleOrAnyWheel,
       {{"per_mps2", -1.0, 1.0, kRequired}, number_of_form(std::size(effects::kTractionForms))}},
      {"turn_scrub", kVehicleOrWheels, {{"per_radps", -0.5, 0.5, kRequired}, number_of_form(2)}},
      {"one_sided_drag", kVehicle, {{"rad_per_m", -1.0, 1.0, kRequired}}},
      {"bump",
       kWheels,
       {{"extra_distance_m", 0.0, 0.04, kRequired},
        {"left_more_m", -0.04, 0.04},
        {"x_m", -kFar, kFar, kRequired},
        {"y_m", -kFar, kFar, kRequired},
        {"radius_m", 1e-3, kFar},
        {"direction_rad"},
        {"length_m", 1e-2, kFar},
        {"at_s", -kEver_s, kEver_s},
        number_of_form(std::size(effects::kBumpsLying))}},
      {"slip_zone",
       {"floor", "vehicle", "both_wheels"},
       {{"slip", 0.0, 1.0, kRequired},
        {"x_m", -kFar, kFar, kRequired},
        {"y_m", -kFar, kFar, kRequired},
        {"radius_m", 1e-3, kFar, kRequired},
        number_of_form(3)}},
      {"floor_slope_creep",
       {"floor", "vehicle"},
       {{"direction_rad"}, {"creep_mps", -1.0, 1.0, kRequired}, number_of_form(2)}},
      {"collision",
       kVehicle,
       {{"dx_m", -20.0, 20.0},
        {"dy_m", -20.0, 20.0},
        {"dheading_rad", -4.0, 4.0},
        {"at_s", -kEver_s, kEver_s, kRequired},
        {"lasts_s", 0.01, 10.0},
        number_of_form(std::size(effects::kCollisionLasts_s))}},
      {"turn_speed_loss", kVehicleOrWheels, {{"per_radps", -3.0, 3.0, kRequired}}},
      {"clock_rate", {"vehicle", "both_wheels", "truth"}, {{"rate", -0.5, 0.5, kRequired}}},
      {"truth_frozen", kTruth, kWhen},
      {"encoder_data_fault", kWheels, with_when({{"backward_rad", 0.0, 1e4}})},
      {"truth_time_offset", kTruth, {{"offset_s", -10.0, 10.0, kRequired}}},
      {"truth_mounting_offset", kTruth, {{"x_m", -10.0, 10.0}, {"y_m", -10.0, 10.0}, {"heading_rad", -4.0, 4.0}}},
      {"truth_smoothing", kTruth, {{"width_s", 0.0, 2.0, kRequired}}},
      {"actuator_lag", kVehicle, {{"time_constant_s", 0.0, 10.0, kRequired}}},
      {"actuator_delay", kVehicle, {{"delay_s", 0.0, 10.0, kRequired}}},
      {"link_angle_bias", {"truck_a", "truck_b", "trailer"}, {{"bias_rad", -1.0, 1.0, kRequired}}},
      {"link_length_bias", {"link"}, {{"bias_m", -0.1, 0.1, kRequired}}},
      {"pivot_angle_bias",
       {"castor1", "castor2", "castor3", "castor4", "castor5", "castor6"},
       {{"bias_rad", -1.0, 1.0, kRequired}}},
  };
  return entries;
}

PartComponent part_component(const std::string& component) {
  const std::size_t dot = component.find('.');
  if (dot != std::string::npos) return {component.substr(0, dot), component.substr(dot + 1)};
  if (is_part(component)) return {component, "vehicle"};
  return {"", component};
}

bool may_act_on(const EffectEntry& entry, const std::string& component) {
  if (is_one_of(entry.components, component)) return true;
  const PartComponent of = part_component(component);
  const bool is_wheel = of.component == "left_wheel" || of.component == "right_wheel" || of.component == "both_wheels";
  const bool words_fit = component.find('.') == std::string::npos ? of.component == "vehicle" : is_wheel;
  return is_part(of.part) && words_fit && is_one_of(entry.components, of.component);
}

std::vector<ActiveEffect> effects_of_part(const std::vector<ActiveEffect>& effects, const std::string& part) {
  std::vector<ActiveEffect> own;
  for (ActiveEffect active : effects) {
    if (is_bias_of_a_joint(active.effect)) continue;
    const PartComponent of = part_component(active.component);
    const bool of_all = active.effect == "floor_slope_creep";
    if (!of_all && (of.part.empty() || of.part != part)) continue;
    active.component = of.component;
    own.push_back(std::move(active));
  }
  return own;
}

const EffectEntry* effect_entry(const std::string& name) {
  for (const EffectEntry& entry : effect_catalogue())
    if (entry.name == name) return &entry;
  return nullptr;
}

std::vector<std::string> problems_in(const std::vector<ActiveEffect>& effects) {
  std::vector<std::string> problems;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const ActiveEffect& active = effects[i];
    const std::string key = "effect[" + std::to_string(i + 1) + "]";
    const EffectEntry* entry = effect_entry(active.effect);
    if (!entry) {
      problems.push_back(key + ".effect: found '" + active.effect + "', expected an effect of a differential drive");
      continue;
    }
    if (!may_act_on(*entry, active.component))
      problems.push_back(key + ".component: found '" + active.component + "', expected " +
                         joined_by_or(entry->components));
    check_parameters(active, *entry, key, problems);
  }
  return problems;
}

namespace {

// With the parameters that a scenario knows.
ActiveEffect in_its_words(const ActiveEffect& fitted, const EffectEntry& entry) {
  ActiveEffect active{fitted.effect, fitted.component, {}};
  for (const EffectParameter& p : entry.parameters)
    if (p.name == "form")  // a model leaves out that of the catalogue's own
      active.parameters.emplace_back("form", fitted.parameter("form"));
    else if (gives(fitted, p.name))
      active.parameters.emplace_back(p.name, fitted.parameter(p.name));
  return active;
}

}  // namespace

bool can_be_played(const ActiveEffect& fitted) {
  const EffectEntry* entry = effect_entry(fitted.effect);
  std::vector<std::string> problems;
  if (entry) check_given(in_its_words(fitted, *entry), *entry, "", problems);
  return entry && problems.empty();
}

std::optional<ActiveEffect> as_in_a_scenario(const ActiveEffect& fitted) {
  // What is in the calibrated vehicle already would act twice; and no simulated truth has to be smoothed.
  const EffectEntry* entry = is_of_the_truth(fitted.effect) ? nullptr : effect_entry(fitted.effect);
  if (!entry) return std::nullopt;
  ActiveEffect active = in_its_words(fitted, *entry);
  if (!problems_in(std::vector<ActiveEffect>{active}).empty()) return std::nullopt;
  return active;
}

}  // namespace odolab
