// The lesson that is open, and the lessons there are.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/jobs.h"
#include "core/diagnosis/diagnosis.h"
#include "core/lesson/lesson.h"
#include "ui/lesson.h"

namespace odolab {

class LessonDesk {
 public:
  Result<Done> open(const std::string& path);
  void leave() { lesson_.reset(); }
  void step_to(int step);
  void answer(int choice, int stake);
  // Drives the mystery of the step and diagnoses it, in a job.
  void ask(Jobs& jobs);

  bool is_open() const { return lesson_.has_value(); }
  const Lesson& lesson() const { return *lesson_; }
  const LessonStep& step() const { return lesson_->steps[static_cast<std::size_t>(progress_.step)]; }
  // What the step shows on the floor; null where it has words alone.
  const Scenario* scenario() const;
  const LessonProgress& progress() const { return progress_; }
  ui::LessonView view(const Jobs& jobs) const;

 private:
  void look_for_lessons() const;

  std::optional<Lesson> lesson_;
  LessonProgress progress_;
  std::shared_ptr<const Diagnosis> diagnosis_;
  std::string problem_;
  mutable bool looked_ = false;
  mutable std::vector<ui::LessonEntry> lessons_;
  mutable std::vector<std::string> problems_;
};

}  // namespace odolab
