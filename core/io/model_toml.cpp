#include "core/io/model_toml.h"

#include "core/io/toml_table.h"
#include "core/io/toml_text.h"
#include "core/io/vehicle_toml.h"
#include "core/io/whole_file.h"

namespace odolab {

namespace {

const std::vector<std::string> kSchemas = {"odolab.model/1"};

FittedEffect read_effect(TomlTable& table) {
  FittedEffect effect;
  table.require("effect");
  table.field("effect", effect.active.effect);
  table.require("component");
  table.field("component", effect.active.component);
  TomlTable errors = table.table("stderr");
  table.other_fields(effect.active.parameters);
  for (const auto& [name, value] : effect.active.parameters) {
    std::optional<double> error;
    errors.field(name.c_str(), error);
    if (error) effect.stderr_values.emplace_back(name, *error);
  }
  return effect;
}

}  // namespace

Result<FittedModel> read_model(const std::string& path) {
  Result<TomlTable> read = TomlTable::read(path);
  if (!read) return read.error();
  TomlTable& top = *read;
  top.require("schema");
  top.index_of_choice("schema", 0, kSchemas);
  top.require("vehicle");
  FittedModel model;
  if (!top.failure()) {
    TomlTable vehicle = top.table("vehicle");
    model.vehicle = vehicle_from(vehicle, "vehicle.");
    for (TomlTable& element : top.tables("effect")) model.effects.push_back(read_effect(element));
  }
  const Result<Done> done = top.finish();
  if (!done) return done.error();
  return model;
}

std::string model_text(const FittedModel& model) {
  TomlText text;
  text.comment("For odolab predict --model: a vehicle as calibrated, and what else was found on it.");
  text.field("schema", kSchemas.front());
  text.table("vehicle");
  write_vehicle_to(text, model.vehicle, "vehicle.");
  for (const FittedEffect& effect : model.effects) {
    text.table_element("effect");
    text.field("effect", effect.active.effect);
    text.field("component", effect.active.component);
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
