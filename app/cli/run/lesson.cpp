#include "app/cli/run/lesson.h"

#include <cstdio>

#include "app/cli/command.h"
#include "app/cli/overwriting.h"
#include "app/cli/run/judge.h"
#include "app/cli/run/outputs.h"
#include "app/cli/terminal.h"
#include "core/io/lesson_toml.h"
#include "core/io/verdict_sentence.h"
#include "core/lesson/mystery.h"
#include "physics/confirmed_diagnosis.h"

namespace odolab {

namespace {

Result<RunOutputs> mystery_outputs(const Mystery& mystery, const Progress& progress) {
  const Result<Diagnosis> diagnosis = diagnosed(mystery, progress);
  if (!diagnosis) return diagnosis.error();
  const MysteryOutcome outcome = judged(mystery, *diagnosis);
  RunOutputs out;
  out.figure("named", outcome.named ? 1.0 : 0.0);
  out.figure("named_first", outcome.named_first ? 1.0 : 0.0);
  out.figure("findings", outcome.findings);
  out.sentences.push_back(verdict_sentence(*diagnosis));
  return out;
}

}  // namespace

int run_lesson(const std::string& path, const std::string& out, bool check) {
  const Result<Lesson> lesson = read_lesson(path);
  if (!lesson) return bad_input(lesson.error());
  if (!out.empty())
    if (const std::optional<Error> unusable = unusable_output({out + "/summary.json"}, {})) return bad_input(*unusable);
  bool all_hold = true;
  Json summary = Json::object();
  summary["lesson"] = lesson->title;
  std::printf("%s\n", lesson->title.c_str());
  for (std::size_t i = 0; i < lesson->steps.size(); ++i) {
    const LessonStep& step = lesson->steps[i];
    std::printf("step %zu, %s\n", i + 1, step.title.c_str());
    if (!step.scenario && !step.mystery) continue;
    const std::string words = "step " + std::to_string(i + 1);
    const Result<RunOutputs> outputs =
        step.mystery ? mystery_outputs(*step.mystery, terminal_progress(words.c_str()))
                     : run_outputs(*step.scenario, step.scenario_path, terminal_progress(words.c_str()));
    if (!outputs) return bad_input(outputs.error());
    std::vector<Expectation> expected = step.checks;
    if (step.scenario)
      expected.insert(expected.end(), step.scenario->expectations.begin(), step.scenario->expectations.end());
    const Result<Judgement> judgement = judge(expected, outputs->figures, path + ": " + words + ": check");
    if (!judgement) return bad_input(judgement.error());
    for (const std::string& sentence : outputs->sentences) std::printf("%s\n", sentence.c_str());
    if (check) std::printf("%s", judgement->lines.c_str());
    all_hold = all_hold && judgement->all_hold;
    Json figures = Json::object();
    figures["step"] = step.title;
    for (const auto& [name, value] : outputs->figures) figures["figures"][name] = value;
    summary["steps"].push_back(figures);
  }
  if (interrupted()) return stopped_before_its_end();
  if (!out.empty())
    if (Result<Done> written = write_json(out + "/summary.json", summary); !written) return bad_input(written.error());
  return check && !all_hold ? kCheckFailed : kDone;
}

}  // namespace odolab
