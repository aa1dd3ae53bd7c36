#include "app/gui/keys.h"

#include "core/guide/guide.h"

namespace odolab {

namespace {

// The next of the speeds that the transport bar offers.
double next_speed(double speed, int direction) {
  static const double kSpeeds[] = {0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 50.0, 0.0};
  constexpr int kCount = int(sizeof kSpeeds / sizeof kSpeeds[0]);
  int here = 3;
  for (int i = 0; i < kCount; ++i)
    if (kSpeeds[i] == speed) here = i;
  const int next = here + direction;
  return next < 0 || next >= kCount ? speed : kSpeeds[next];
}

// To the page of a guide or the step of a lesson after this one or before it, as its buttons would.
ui::Actions turned(const Session& session, int by) {
  if (session.jobs().running()) return {};
  if (session.mode() == ui::Mode::learn && session.lesson().is_open()) {
    const int to = session.lesson().progress().step + by;
    if (to == int(session.lesson().lesson().steps.size())) return {ui::LeaveLesson{}};
    return to < 0 ? ui::Actions{} : ui::Actions{ui::LessonStepTo{to}};
  }
  if (!session.guide_in_hand()) return {};
  GuideSession guide = session.guide().session();
  const int to = guide.page + by;
  if (to < 0 || to >= int(guide_of(guide.kind).pages.size()) || (by > 0 && !still_to_do(guide).empty())) return {};
  turn_to(guide, to);
  return {ui::ChangeGuide{guide, ui::GuideEdit::page}};
}

}  // namespace

ui::Actions actions_of(const KeyPress& press, const Session& session, ScreenState& state) {
  using namespace ui;
  WindowChoices& choices = state.choices;
  const bool by_hand = session.mode() == Mode::drive && std::holds_alternative<HandPath>(session.run().scenario().path);
  if (press.ctrl) {
    switch (press.key) {
      case Key::o:
        choices.show_open = true;
        return {};
      case Key::s:
        if (press.shift)
          choices.show_save_curves = has_curves(session);
        else
          choices.show_save_recording = session.mode() != Mode::diagnose;  // there it is taken away by buttons
        return {};
      case Key::q:
        return {Quit{}};
      case Key::y:
        return {Redo{}};
      case Key::z:
        return press.shift ? Actions{Redo{}} : Actions{Undo{}};
      default:
        return {};
    }
  }
  switch (press.key) {
    case Key::space:
      return session.playing() ? Actions{Pause{}} : Actions{Play{}};
    case Key::right:
      return by_hand ? Actions{} : Actions{StepForward{}};
    case Key::left:
      return by_hand ? Actions{} : Actions{StepBack{}};
    case Key::home:
      return {ToStart{}};
    case Key::end:
      return {ToEnd{}};
    case Key::r:
      return {Restart{}};
    case Key::page_down:
      return turned(session, 1);
    case Key::page_up:
      return turned(session, -1);
    case Key::plus:
      return {SetSpeed{next_speed(session.speed(), 1)}};
    case Key::minus:
      return {SetSpeed{next_speed(session.speed(), -1)}};
    case Key::zero:
      return {SetSpeed{1.0}};
    case Key::one:
      return {SetMode{Mode::drive}};
    case Key::two:
      return {SetMode{Mode::calibrate}};
    case Key::three:
      return {SetMode{Mode::compare}};
    case Key::four:
      return {SetMode{Mode::diagnose}};
    case Key::five:
      return {SetMode{Mode::learn}};
    case Key::f:
      choices.fit_view = true;
      return {};
    case Key::h:
      choices.hide_interface = !choices.hide_interface;
      return {};
    case Key::f1:
      choices.show_keys = !choices.show_keys;
      return {};
    case Key::f12:
      return {SavePicture{}};
    case Key::escape:
      choices.show_keys = false;
      choices.hide_interface = false;
      state.diagnosis.brush.clear();
      state.diagnosis.lit.reset();
      state.diagnosis_floor.tool = FloorTool::pointer;
      state.drive_floor.tool = FloorTool::pointer;
      state.drive_floor.selected.reset();
      return {};
    case Key::erase: {
      const Floor& floor = session.run().scenario().floor;
      if (session.mode() != Mode::drive || !state.drive_floor.selected || !exists(floor, *state.drive_floor.selected))
        return {};
      Actions actions{SetFloor{removed(floor, *state.drive_floor.selected), true}};
      state.drive_floor.selected.reset();
      return actions;
    }
    default:
      return {};
  }
}

ui::DriveByHand hand_command(const Window& window, const Scenario& scenario) {
  const auto either = [&](Key a, Key b) { return window.is_down(a) || window.is_down(b) ? 1.0 : 0.0; };
  const double forward = either(Key::up, Key::w) - either(Key::down, Key::s);
  const double turn = either(Key::left, Key::a) - either(Key::right, Key::d);
  const double left = moves_sideways(scenario.vehicle.kind) ? either(Key::q, Key::q) - either(Key::e, Key::e) : 0.0;
  return {forward * scenario.driving.speed_mps, turn * scenario.driving.turn_rate_radps,
          left * scenario.driving.speed_mps};
}

}  // namespace odolab
