#include "app/gui/lesson_desk.h"

#include <algorithm>
#include <filesystem>

#include "core/io/diagnosis_text.h"
#include "core/io/lesson_toml.h"
#include "core/io/verdict_sentence.h"
#include "physics/confirmed_diagnosis.h"

namespace odolab {

Result<Done> LessonDesk::open(const std::string& path) {
  Result<Lesson> read = read_lesson(path);
  if (!read) return read.error();
  lesson_ = std::move(*read);
  progress_ = begun(*lesson_);
  diagnosis_.reset();
  problem_.clear();
  return Done{};
}

void LessonDesk::step_to(int step) {
  if (!lesson_) return;
  progress_.step = std::clamp(step, 0, static_cast<int>(lesson_->steps.size()) - 1);
  diagnosis_.reset();
  problem_.clear();
}

void LessonDesk::answer(int choice, int stake) {
  if (lesson_) odolab::answer(progress_, *lesson_, choice, stake);
}

const Scenario* LessonDesk::scenario() const {
  if (!lesson_) return nullptr;
  if (step().mystery) return &step().mystery->drives.front();
  return step().scenario ? &*step().scenario : nullptr;
}

void LessonDesk::ask(Jobs& jobs) {
  if (!lesson_ || !step().mystery) return;
  const Mystery mystery = *step().mystery;
  const auto found = std::make_shared<std::optional<Result<Diagnosis>>>();
  jobs.start(
      "driving and diagnosing the mystery",
      [mystery, found](const Progress& progress, const Jobs::Deliver&) { *found = diagnosed(mystery, progress); },
      [this, found](bool cancelled) {
        if (cancelled || !lesson_ || !step().mystery) return;
        if (*found && **found)
          diagnosis_ = std::make_shared<const Diagnosis>(***found);
        else
          problem_ = (*found)->error().message();
      });
}

void LessonDesk::look_for_lessons() const {
  looked_ = true;
  std::vector<Lesson> lessons;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(ODOLAB_ASSETS) + "/lessons", none)) {
    if (entry.path().extension() != ".toml") continue;
    Result<Lesson> lesson = read_lesson(entry.path().string());
    if (lesson)
      lessons.push_back(std::move(*lesson));
    else
      problems_.push_back(lesson.error().message());
  }
  std::sort(lessons.begin(), lessons.end(),
            [](const Lesson& a, const Lesson& b) { return a.order != b.order ? a.order < b.order : a.file < b.file; });
  for (const Lesson& l : lessons) lessons_.push_back({l.file, l.title, l.about, l.minutes});
}

ui::LessonView LessonDesk::view(const Jobs& jobs) const {
  if (!looked_) look_for_lessons();
  ui::LessonView v;
  v.lessons = lessons_;
  v.problems = problems_;
  v.busy = jobs.running();
  v.job = jobs.name();
  v.share_done = jobs.share_done();
  v.problem = problem_;
  if (!lesson_) return v;
  v.lesson = &*lesson_;
  v.progress = &progress_;
  if (step().mystery) v.answer = effect_text(step().mystery->effect, step().mystery->component) + ".";
  if (diagnosis_) {
    v.diagnosis = diagnosis_.get();
    v.outcome = judged(*step().mystery, *diagnosis_);
    v.verdict.push_back(verdict_sentence(*diagnosis_));
    for (const Finding& f : diagnosis_->findings) v.verdict.push_back(f.sentence);
  }
  return v;
}

}  // namespace odolab
