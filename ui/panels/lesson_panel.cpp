#include "ui/panels/lesson_panel.h"

#include <algorithm>

#include "core/base/formatted.h"
#include "ui/look/widgets.h"

namespace odolab::ui {

namespace {

Actions list(const LessonView& view, const Theme& theme) {
  Actions actions;
  heading("Lessons", theme);
  note("Six to ten minutes each: something to watch, a question, and why.", theme);
  const float width = ImGui::GetContentRegionAvail().x;
  for (const LessonEntry& entry : view.lessons) {
    ImGui::Dummy({1, theme.px(3)});
    ImGui::PushID(entry.path.c_str());
    ButtonLook look;
    look.tip = entry.about;
    ImGui::PushStyleVar(ImGuiStyleVar_ButtonTextAlign, ImVec2(0.0f, 0.5f));
    if (text_button(wrapped_at(entry.title, width - theme.px(20)).c_str(), theme, look, width))
      actions.push_back(OpenLesson{entry.path});
    ImGui::PopStyleVar();
    ImGui::PopID();
  }
  for (const std::string& problem : view.problems) warning(problem, theme);
  if (view.lessons.empty() && view.problems.empty()) note("There are no lessons here.", theme);
  return actions;
}

// Paragraphs are parted by blank lines; other line ends are only the file's.
void prompt(const std::string& text, const Theme& theme) {
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find("\n\n", at), text.size());
    std::string paragraph = text.substr(at, end - at);
    std::replace(paragraph.begin(), paragraph.end(), '\n', ' ');
    words(paragraph, theme.ink);
    ImGui::Dummy({1, theme.px(2)});
    at = end + 2;
  }
}

Actions question(const LessonView& view, LessonPanelState& state, const Theme& theme) {
  Actions actions;
  const LessonQuestion& q = *view.lesson->steps[std::size_t(view.progress->step)].question;
  const int given = view.progress->answers[std::size_t(view.progress->step)];
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::Dummy({1, theme.px(2)});
  {
    WithFont strong(theme.strong);
    words(q.text, theme.ink);
  }
  if (q.bet && given < 0) {
    state.stake = std::clamp(state.stake, 0, view.progress->points);
    count_row("Your bet", "##stake", state.stake, 0, std::max(0, view.progress->points),
              "Points that you win or lose with your answer.", theme);
  }
  for (std::size_t i = 0; i < q.answers.size(); ++i) {
    const LessonAnswer& a = q.answers[i];
    ImGui::PushID(int(i));
    ButtonLook look;
    look.enabled = given < 0;
    look.toggled = given == int(i);
    ImGui::PushStyleVar(ImGuiStyleVar_ButtonTextAlign, ImVec2(0.0f, 0.5f));
    if (text_button(wrapped_at(a.text, width - theme.px(20)).c_str(), theme, look, width))
      actions.push_back(AnswerLesson{int(i), state.stake});
    ImGui::PopStyleVar();
    ImGui::PopID();
  }
  if (const LessonAnswer* a = given_answer(*view.progress, *view.lesson)) {
    ImGui::Dummy({1, theme.px(2)});
    {
      WithFont strong(theme.strong);
      words(a->right ? "Right." : "No.", a->right ? theme.green : theme.error);
    }
    if (!a->reply.empty()) words(a->reply, theme.ink);
  }
  return actions;
}

Actions mystery(const LessonView& view, const LessonStep& step, const Theme& theme) {
  Actions actions;
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::Dummy({1, theme.px(2)});
  if (!view.diagnosis) {
    ButtonLook ask;
    const bool answered = !step.question || view.progress->answers[std::size_t(view.progress->step)] >= 0;
    ask.primary = true;
    ask.enabled = answered && !view.busy;
    ask.why_disabled = view.busy ? "Busy " + view.job + "." : "Guess first.";
    const std::string tip =
        formatted("%zu drives are simulated and diagnosed as recordings would be.", step.mystery->drives.size());
    ask.tip = tip;
    if (text_button("Ask the tool", theme, ask, width)) actions.push_back(AskMystery{});
    return actions;
  }
  heading("What the tool says", theme);
  for (const std::string& line : view.verdict) words(line, theme.ink);
  heading("What was concealed", theme);
  words(view.answer, theme.ink);
  words(view.outcome.named_first ? "The tool found it."
        : view.outcome.named     ? "The tool found it, among others."
                                 : "The tool did not find it.",
        view.outcome.named ? theme.green : theme.error);
  return actions;
}

Actions squares(const LessonView& view, const Theme& theme) {
  Actions actions;
  const float width = ImGui::GetContentRegionAvail().x;
  ButtonLook look;
  look.primary = true;
  look.enabled = !view.busy;
  look.why_disabled = "Busy " + view.job + ".";
  if (view.can_drive_squares && text_button("Drive the squares", theme, look, width))
    actions.push_back(StartBenchmark{0, true});
  if (view.can_apply && text_button("Calibrate and drive again", theme, look, width))
    actions.push_back(ApplyCalibration{});
  return actions;
}

void progress_bar(const LessonView& view, Actions& actions, const Theme& theme) {
  if (!view.busy) return;
  ImGui::Dummy({1, theme.px(2)});
  if (job_progress(view.share_done, theme)) actions.push_back(CancelJob{});
}

}  // namespace

Actions lesson_panel(const LessonView& view, LessonPanelState& state, const Theme& theme) {
  if (!view.lesson) return list(view, theme);
  Actions actions;
  const Lesson& lesson = *view.lesson;
  const int at = view.progress->step;
  const LessonStep& step = lesson.steps[std::size_t(at)];
  {
    WithFont strong(theme.strong);
    words(lesson.title, theme.ink);
  }
  const std::string where = formatted("step %d of %zu", at + 1, lesson.steps.size());
  bool bets = false;
  for (const LessonStep& s : lesson.steps) bets = bets || (s.question && s.question->bet);
  note(bets ? std::string(where) + ", " + std::to_string(view.progress->points) + " points" : where, theme);
  ImGui::Dummy({1, theme.px(4)});
  {
    WithFont large(theme.large);
    words(step.title, theme.ink);
  }
  prompt(step.text, theme);
  if (!step.look_at.empty()) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, pad = theme.px(9);
    draw.ChannelsSplit(2);
    draw.ChannelsSetCurrent(1);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + theme.px(5));
    ImGui::Indent(pad);
    words("Look at: " + step.look_at, theme.ink, width - 2.0f * pad);
    ImGui::Unindent(pad);
    const float bottom = ImGui::GetItemRectMax().y + theme.px(5);
    draw.ChannelsSetCurrent(0);
    draw.AddRectFilled(low, {low.x + width, bottom}, theme.note_paper, theme.px(4));
    draw.ChannelsMerge();
    ImGui::Dummy({1, theme.px(5)});
  }
  if (view.benchmark) append(actions, squares(view, theme));
  if (step.question) append(actions, question(view, state, theme));
  if (step.mystery) append(actions, mystery(view, step, theme));
  progress_bar(view, actions, theme);
  if (!view.problem.empty()) warning(view.problem, theme);

  ImGui::Dummy({1, theme.px(8)});
  const float width = ImGui::GetContentRegionAvail().x, gap = theme.px(8), half = 0.5f * (width - gap);
  ButtonLook back, next;
  back.enabled = at > 0 && !view.busy;
  if (text_button("Back", theme, back, half)) actions.push_back(LessonStepTo{at - 1});
  ImGui::SameLine(0.0f, gap);
  const bool last = at + 1 == int(lesson.steps.size());
  next.enabled = !view.busy;
  next.why_disabled = "Busy " + view.job + ".";
  next.primary = !step.question || view.progress->answers[std::size_t(at)] >= 0;
  if (text_button(last ? "Finish" : "Next", theme, next, half)) {
    if (last)
      actions.push_back(LeaveLesson{});
    else
      actions.push_back(LessonStepTo{at + 1});
  }
  ButtonLook leave;
  leave.enabled = !view.busy;
  if (!last && text_button("Leave the lesson", theme, leave, width)) actions.push_back(LeaveLesson{});
  return actions;
}

}  // namespace odolab::ui
