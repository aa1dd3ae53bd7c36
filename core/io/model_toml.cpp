#include "core/io/model_toml.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/effects/effect.h"
#include "core/io/toml_table.h"
#include "core/io/toml_text.h"
#include "core/io/vehicle_toml.h"
#include "core/io/whole_file.h"
#include "core/scenario/effect_catalogue.h"

namespace odolab {

namespace {

const std::vector<std::string> kModelSchemas = {"odolab.model/1"};

using Parameters = std::vector<std::pair<std::string, double>>;

bool has_parameter(const Parameters& parameters, const std::string& key) {
  return std::any_of(parameters.begin(), parameters.end(), [&](const auto& p) { return p.first == key; });
}

// As in a scenario, but an event that was found at a time need not know its place.
FittedEffect read_fitted_effect(TomlTable& table) {
  FittedEffect effect;
  std::vector<std::string> names;
  for (const EffectEntry& entry : effect_catalogue()) names.push_back(entry.name);
  table.require("effect");
  const EffectEntry& entry = effect_catalogue()[table.index_of_choice("effect", 0, names)];
  effect.active.effect = entry.name;
  if (table.failure()) return effect;
  table.require("component");
  table.field("component", effect.active.component);
  if (!may_act_on(entry, effect.active.component)) table.index_of_choice("component", 0, entry.components);
  table.field("recording", effect.recording);
  const bool at_a_time = table.has("at_s");
  TomlTable errors = table.table("stderr");
  std::vector<std::string> keys;
  for (const EffectParameter& parameter : entry.parameters) {
    if (is_wanted(parameter, at_a_time)) table.require(parameter.name.c_str());
    keys.push_back(parameter.name);
  }
  if (at_a_time) keys.push_back("at_s");
  for (const char* key : {"form", "session_start_s", "at_mps"}) keys.push_back(key);  // core/diagnosis/effects/effect.h
  for (const std::string& key : keys) {
    std::optional<double> value, error;
    table.field(key.c_str(), value);
    errors.field(key.c_str(), error);
    if (value && !has_parameter(effect.active.parameters, key)) effect.active.parameters.emplace_back(key, *value);
    if (error && !has_parameter(effect.stderr_values, key)) effect.stderr_values.emplace_back(key, *error);
  }
  return effect;
}

void read_fitted_recording(TomlTable& table, FittedModel& model) {
  std::string name, of_it;
  std::optional<double> clock_s;
  table.require("name");
  table.field("name", name);
  table.field("fingerprint", of_it);
  table.field("truth_time_offset_s", clock_s);
  if (!of_it.empty()) model.fingerprints.emplace_back(name, of_it);
  if (clock_s) model.truth_clock_s.emplace_back(name, *clock_s);
}

// A form is the number of one that the effect has.
bool has_its_form(const ActiveEffect& active) {
  const Effect* entry = catalogue_entry(active);
  const double form = active.parameter("form");
  return form == std::floor(form) && form >= 0.0 &&
         (form == 0.0 || (entry && form < static_cast<double>(entry->forms.size())));
}

}  // namespace

Result<FittedModel> read_model(const std::string& path) {
  Result<TomlTable> read = TomlTable::read(path);
  if (!read) return read.error();
  TomlTable& top = *read;
  if (!top.has("schema") && top.has("kind"))
    return Error{path, "a vehicle's file", "a model that odolab diagnose --model wrote; --vehicle takes vehicles"};
  top.require("schema");
  top.index_of_choice("schema", 0, kModelSchemas);
  top.require("vehicle");
  FittedModel model;
  if (!top.failure()) {
    TomlTable vehicle = top.table("vehicle");
    model.vehicle = vehicle_from(vehicle, "vehicle.");
    for (TomlTable& element : top.tables("recording")) read_fitted_recording(element, model);
    for (TomlTable& element : top.tables("effect")) {
      model.effects.push_back(read_fitted_effect(element));
      if (has_its_form(model.effects.back().active)) continue;
      const std::string key = "effect[" + std::to_string(model.effects.size()) + "].form";
      top.fail({top.place_of(key) + ": form", "no such form", "the number of a form that the effect has"});
    }
  }
  const Result<Done> done = top.finish();
  if (!done) return done.error();
  return model;
}

std::string model_text(const FittedModel& model) {
  TomlText text;
  text.comment("For odolab predict --model: a vehicle as calibrated, and what else was found on it.");
  text.field("schema", kModelSchemas.front());
  text.table("vehicle");
  write_vehicle_to(text, model.vehicle, "vehicle.");
  for (const auto& [name, clock_s] : model.truth_clock_s) {
    text.table_element("recording");
    text.field("name", name);
    for (const auto& [known, of_it] : model.fingerprints)
      if (known == name) text.field("fingerprint", of_it);
    text.field("truth_time_offset_s", clock_s);
  }
  for (const FittedEffect& effect : model.effects) {
    text.table_element("effect");
    text.field("effect", effect.active.effect);
    text.field("component", effect.active.component);
    if (!effect.recording.empty()) text.field("recording", effect.recording);
    for (const auto& [name, value] : effect.active.parameters) text.field(name.c_str(), value);
    if (effect.stderr_values.empty()) continue;
    text.table("effect.stderr");
    for (const auto& [name, value] : effect.stderr_values) text.field(name.c_str(), value);
  }
  return text.text();
}

Result<Done> write_model(const std::string& path, const FittedModel& model) {
  return write_whole_file(path, model_text(model));
}

}  // namespace odolab
