// A lesson: steps that a student goes through, each with words, something to watch, and perhaps a question.
// Data; assets/lessons/README.md tells a teacher how to write one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/scenario/scenario.h"

namespace odolab {

struct LessonAnswer {
  std::string text;
  bool right = false;
  std::string reply;  // what is said to who chose it
};

struct LessonQuestion {
  std::string text;
  std::vector<LessonAnswer> answers;  // one of them right, or several
  bool bet = false;                   // points are put on the answer
};

// A robot whose missing physics is concealed: it drives all of this, and the diagnosis is asked.
struct Mystery {
  std::vector<Scenario> drives;  // of one vehicle; each has the concealed effect switched on
  std::vector<std::string> drive_names;
  std::string effect, component;  // the answer, in the catalogue's words
};

struct LessonStep {
  std::string title;
  std::string text;     // the prompt; blank lines part its paragraphs
  std::string look_at;  // where the point can be seen, in one sentence
  std::optional<Scenario> scenario;
  std::string scenario_path;  // that the scenario's own files are relative to
  bool plot_heading = false;  // below the floor, instead of the position gap
  double speed = 1.0;         // times real time, 0: as fast as possible
  std::optional<LessonQuestion> question;
  std::optional<Mystery> mystery;
  std::vector<Expectation> checks;  // of the scenario's run, or of the mystery's diagnosis
};

struct Lesson {
  std::string title;
  std::string about;
  int order = 1000;  // in the list of lessons
  int minutes = 10;
  std::string file;
  std::vector<LessonStep> steps;
};

// Everything that makes a lesson unusable, as sentences that begin with the step: "step 2: …".
std::vector<std::string> problems_in(const Lesson& lesson);

// How a student has come through a lesson so far.
struct LessonProgress {
  int step = 0;  // counted from 0
  int points = 100;
  std::vector<int> answers;  // of each step, -1 where none was given
};

LessonProgress begun(const Lesson& lesson);

// Answers the question of the present step, once. A bet is won or lost; without one nothing is. `stake` is brought to
// between 0 and the points there are.
void answer(LessonProgress& progress, const Lesson& lesson, int choice, int stake);

// The step's given answer; none before.
const LessonAnswer* given_answer(const LessonProgress& progress, const Lesson& lesson);

}  // namespace odolab
