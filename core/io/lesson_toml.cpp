#include "core/io/lesson_toml.h"

#include "core/io/scenario_toml.h"
#include "core/io/toml_table.h"

namespace odolab {

namespace {

void read_question(TomlTable table, LessonQuestion& question) {
  table.require("text");
  table.field("text", question.text);
  table.field("bet", question.bet);
  for (TomlTable& element : table.tables("answer")) {
    LessonAnswer& answer = question.answers.emplace_back();
    element.require("text");
    element.field("text", answer.text);
    element.field("right", answer.right);
    element.field("reply", answer.reply);
  }
}

// A scenario that stands in the lesson, or is named by it.
Result<Scenario> read_named_or_inside(TomlTable& table, const char* key, const std::string& path,
                                      std::string& scenario_path) {
  scenario_path = path;
  if (table.has_table(key)) {
    TomlTable inside = table.table(key);
    return scenario_from(inside, path);
  }
  std::string named;
  table.field(key, named);
  scenario_path = beside(path, named);
  return read_scenario(scenario_path);
}

Result<Done> read_mystery(TomlTable table, const std::string& path, Mystery& mystery) {
  table.require("effect");
  table.field("effect", mystery.effect);
  table.require("component");
  table.field("component", mystery.component);
  for (TomlTable& element : table.tables("drive")) {
    std::string scenario_path;
    element.require("scenario");
    Result<Scenario> drive = read_named_or_inside(element, "scenario", path, scenario_path);
    if (!drive) return drive.error();
    mystery.drive_names.push_back(drive->name);
    mystery.drives.push_back(std::move(*drive));
  }
  return Done{};
}

Result<Done> read_step(TomlTable& table, const std::string& path, LessonStep& step) {
  table.require("title");
  table.field("title", step.title);
  table.require("text");
  table.field("text", step.text);
  table.field("look_at", step.look_at);
  table.field("speed", step.speed);
  std::size_t plot = table.index_of_choice("plot", 0, {"position", "heading"});
  step.plot_heading = plot == 1;
  if (table.has("scenario")) {
    Result<Scenario> scenario = read_named_or_inside(table, "scenario", path, step.scenario_path);
    if (!scenario) return scenario.error();
    step.scenario = std::move(*scenario);
  }
  if (TomlTable question = table.table("question"); question.present())
    read_question(question, step.question.emplace());
  if (TomlTable mystery = table.table("mystery"); mystery.present())
    if (Result<Done> done = read_mystery(mystery, path, step.mystery.emplace()); !done) return done.error();
  for (TomlTable& element : table.tables("check")) {
    Expectation& check = step.checks.emplace_back();
    element.require("figure");
    element.field("figure", check.figure);
    element.field("at_least", check.at_least);
    element.field("at_most", check.at_most);
    if (!element.has("at_least")) element.require("at_most");
  }
  return Done{};
}

}  // namespace

Result<Lesson> read_lesson(const std::string& path) {
  Result<TomlTable> read = TomlTable::read(path);
  if (!read) return read.error();
  TomlTable& top = *read;
  Lesson lesson;
  lesson.file = path;
  top.require("lesson");
  top.field("lesson", lesson.title);
  top.field("about", lesson.about);
  top.field("order", lesson.order);
  top.field("minutes", lesson.minutes);
  for (TomlTable& element : top.tables("step"))
    if (Result<Done> done = read_step(element, path, lesson.steps.emplace_back()); !done) return done.error();
  const Result<Done> done = top.finish();
  if (!done) return done.error();
  for (const std::string& problem : problems_in(lesson)) return Error{path + ": " + problem, "", ""};
  return lesson;
}

}  // namespace odolab
