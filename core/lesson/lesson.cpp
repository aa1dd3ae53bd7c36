#include "core/lesson/lesson.h"

#include <algorithm>

#include "core/scenario/effect_catalogue.h"

namespace odolab {

std::vector<std::string> problems_in(const Lesson& lesson) {
  std::vector<std::string> problems;
  if (lesson.steps.empty()) problems.push_back("step: found none, expected one or more");
  for (std::size_t i = 0; i < lesson.steps.size(); ++i) {
    const LessonStep& step = lesson.steps[i];
    const auto problem = [&](const std::string& words) {
      problems.push_back("step " + std::to_string(i + 1) + ": " + words);
    };
    if (step.text.empty()) problem("text: found none, expected what the student reads");
    if (step.question) {
      const auto& answers = step.question->answers;
      if (answers.size() < 2) problem("question.answer: found fewer than two, expected two or more");
      if (std::none_of(answers.begin(), answers.end(), [](const LessonAnswer& a) { return a.right; }))
        problem("question.answer: found none that is right, expected one");
    }
    if (step.mystery) {
      if (step.scenario) problem("found a scenario and a mystery, expected one of them");
      if (step.mystery->drives.empty()) problem("mystery.drive: found none, expected one or more");
      const auto& catalogue = effect_catalogue();
      if (std::none_of(catalogue.begin(), catalogue.end(),
                       [&](const EffectEntry& e) { return e.name == step.mystery->effect; }))
        problem("mystery.effect: found '" + step.mystery->effect + "', expected one of the catalogue of effects");
    }
    if (!step.checks.empty() && !step.scenario && !step.mystery)
      problem("check: found one, expected a scenario or a mystery that it is about");
    if (step.speed < 0.0) problem("speed: found one below 0, expected times real time, 0 for as fast as possible");
  }
  return problems;
}

LessonProgress begun(const Lesson& lesson) {
  LessonProgress progress;
  progress.answers.assign(lesson.steps.size(), -1);
  return progress;
}

void answer(LessonProgress& progress, const Lesson& lesson, int choice, int stake) {
  const std::size_t step = static_cast<std::size_t>(progress.step);
  const std::optional<LessonQuestion>& question = lesson.steps[step].question;
  if (!question || progress.answers[step] >= 0 || choice < 0 || choice >= static_cast<int>(question->answers.size()))
    return;
  progress.answers[step] = choice;
  if (!question->bet) return;
  stake = std::clamp(stake, 0, progress.points);
  progress.points += question->answers[static_cast<std::size_t>(choice)].right ? stake : -stake;
}

const LessonAnswer* given_answer(const LessonProgress& progress, const Lesson& lesson) {
  const std::size_t step = static_cast<std::size_t>(progress.step);
  const int choice = progress.answers[step];
  return choice < 0 ? nullptr : &lesson.steps[step].question->answers[static_cast<std::size_t>(choice)];
}

}  // namespace odolab
