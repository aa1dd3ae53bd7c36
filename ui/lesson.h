// What the lesson's panel shows.
#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/lesson/lesson.h"
#include "core/lesson/mystery.h"

namespace odolab::ui {

struct LessonEntry {
  std::string path, title, about;
  int minutes = 0;
};

struct LessonView {
  std::vector<LessonEntry> lessons;
  std::vector<std::string> problems;  // of lessons that cannot be read
  const Lesson* lesson = nullptr;     // null: none is open, choose one
  const LessonProgress* progress = nullptr;
  // A benchmark step.
  bool benchmark = false, can_drive_squares = false, can_apply = false;
  // A mystery step.
  const Diagnosis* diagnosis = nullptr;  // once the tool was asked
  MysteryOutcome outcome;
  std::vector<std::string> verdict;  // of the tool, in words
  std::string answer;                // what was concealed, in words
  bool busy = false;
  std::string job;
  double share_done = 0.0;
  std::string problem;
};

}  // namespace odolab::ui
