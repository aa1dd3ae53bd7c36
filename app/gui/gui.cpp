#include "app/gui/gui.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>

#include "app/gui/keys.h"
#include "app/gui/screen.h"
#include "app/gui/session.h"
#include "app/gui/settings.h"
#include "app/gui/window.h"
#include "core/io/file_kind.h"

namespace odolab {

namespace {

constexpr double kPictureStep = 1.0 / 60.0;    // s for the widgets, where no clock is read
constexpr double kSimulatedPerPicture = 0.75;  // s simulated for each picture of a screenshot
constexpr double kTimeForSimulation = 0.012;   // s of a picture's time that the simulation may take
constexpr double kMostBehind = 0.5;            // s of a picture that are caught up with

int fail(const Error& error) {
  std::fprintf(stderr, "odolab: %s\n", error.message().c_str());
  return 2;
}

std::optional<ui::Mode> mode_named(const std::string& name) {
  if (name == "drive") return ui::Mode::drive;
  if (name == "calibrate") return ui::Mode::calibrate;
  if (name == "compare") return ui::Mode::compare;
  if (name == "diagnose") return ui::Mode::diagnose;
  if (name == "learn") return ui::Mode::learn;
  return std::nullopt;
}

std::string picture_name() {
  char text[64];
  const std::time_t now = std::time(nullptr);
  std::strftime(text, sizeof text, "odolab-%Y%m%d-%H%M%S.png", std::localtime(&now));
  return text;
}

ScreenState screen_state_of(const Settings& settings) {
  ScreenState state;
  state.choices.dark = settings.dark;
  state.choices.scale = settings.scale;
  state.left_width = settings.left_width;
  state.right_width = settings.right_width;
  state.bottom_height = settings.bottom_height;
  state.recent_files = settings.recent_files;
  return state;
}

Settings settings_of(const ScreenState& state, const Window& window, double scale) {
  Settings s;
  s.dark = state.choices.dark;
  s.scale = state.choices.scale;
  s.left_width = state.left_width;
  s.right_width = state.right_width;
  s.bottom_height = state.bottom_height;
  s.welcome_seen = !state.welcome.open;
  s.recent_files = state.recent_files;
  s.width = int(std::lround(window.width() / std::max(1.0, scale)));
  s.height = int(std::lround(window.height() / std::max(1.0, scale)));
  return s;
}

void remember_files(const Session& session, std::size_t& known, ScreenState& state) {
  for (; known < session.opened_files().size(); ++known) {
    std::error_code ignored;
    const std::string path =
        std::filesystem::absolute(session.opened_files()[known], ignored).lexically_normal().string();
    std::vector<std::string>& recent = state.recent_files;
    recent.erase(std::remove(recent.begin(), recent.end(), path), recent.end());
    recent.insert(recent.begin(), path);
    if (recent.size() > 8) recent.resize(8);
  }
}

// The scenarios that come with the project.
std::vector<std::string> example_files() {
  std::vector<std::string> files;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(ODOLAB_ASSETS) + "/scenarios", none))
    if (entry.path().extension() == ".toml") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

// Draws a given number of pictures with a clock of its own and writes the last one.
int run_for_picture(const GuiOptions& options, Session& session, Window& window) {
  ScreenState state;
  state.choices.dark = options.dark;
  const double scale = options.scale > 0.0 ? options.scale : 1.0;
  const ui::Theme theme = window.use_theme(options.dark, scale);
  state.welcome.open = options.files.empty();
  state.example_files = example_files();
  if (session.mode() == ui::Mode::drive) session.execute(ui::Play{});
  if (session.mode() == ui::Mode::calibrate &&
      !session.guide().shown()) {  // the picture shows what a click on both buttons leads to
    const std::optional<Benchmark>& asked = session.run().scenario().benchmark;
    session.execute(ui::StartBenchmark{asked ? asked->runs_each_way : 5, asked.has_value()});
    if (!asked || !asked->extended)
      session.execute(ui::ApplyCalibration{});  // what cables do no vehicle is changed for
  }
  if (session.mode() == ui::Mode::compare && !session.comparison().loaded() && options.files.empty())
    session.execute(ui::RecordSimulatedRun{});
  if (session.mode() == ui::Mode::diagnose && !session.diagnosis().runs().empty()) {  // all that its buttons lead to
    session.advance(0.0, [] { return false; });
    session.execute(ui::InDiagnosis{ui::FindMissing{}});
    session.advance(0.0, [] { return false; });
    const std::size_t findings = session.diagnosis().switched_on().size();
    for (std::size_t k = 0; k < findings; ++k) {
      session.execute(ui::InDiagnosis{ui::SwitchFinding{k, true}});
      session.advance(0.0, [] { return false; });
    }
  }
  session.advance(0.0, [] { return false; });  // takes in what opening the files has begun
  if (session.comparison().nominal() && session.comparison().can_be_calibrated()) {
    session.execute(ui::CalibrateFromRecording{});
    session.execute(ui::ReplayWith{ui::ReplayVehicle::nominal});
  }
  for (int i = 0; i < std::max(1, options.frames); ++i) {
    window.begin_picture(kPictureStep);
    session.advance(kSimulatedPerPicture, [] { return true; });
    draw_screen(session, state, theme);
    window.end_picture(theme.panel);
  }
  const Result<Done> saved = window.save_picture(options.screenshot_path);
  return saved ? 0 : fail(saved.error());
}

int run_for_person(const GuiOptions& options, Session& session, Window& window, const Settings& settings) {
  ScreenState state = screen_state_of(settings);
  if (options.scale > 0.0) state.choices.scale = options.scale;
  state.guide.export_folder = state.diagnosis.export_folder = std::filesystem::current_path().string();
  state.welcome.open = options.files.empty() && !settings.welcome_seen;
  state.example_files = example_files();
  std::size_t known_files = 0;
  double scale = 0.0;
  bool dark = false;
  ui::Theme theme;
  if (session.mode() == ui::Mode::drive) session.execute(ui::Play{});
  double last = window.seconds();
  while (!window.wants_to_close() && !session.wants_to_quit()) {
    const double wanted_scale = state.choices.scale > 0.0 ? state.choices.scale : window.monitor_scale();
    if (wanted_scale != scale || state.choices.dark != dark) theme = window.use_theme(state.choices.dark, wanted_scale);
    scale = wanted_scale;
    dark = state.choices.dark;

    const bool moves = session.playing() || session.jobs().running() || session.diagnosis().moving();
    window.begin_picture(0.0, !moves);
    for (const std::string& path : window.dropped_files()) session.execute(ui::OpenFile{path});
    for (const KeyPress& press : window.key_presses())  // however briefly, and whatever has the keyboard
      if (press.key == Key::escape && asks_for_path(state))
        close_dialogs(state);
      else if (press.key == Key::f12 && asks_for_path(state))
        session.execute(ui::SavePicture{});
    const bool keys_are_free = !ImGui::GetIO().WantTextInput && !asks_for_path(state);
    if (keys_are_free)
      for (const KeyPress& press : window.key_presses())
        for (const ui::Action& action : actions_of(press, session, state)) session.execute(action);
    if (std::holds_alternative<HandPath>(session.run().scenario().path) && keys_are_free)
      session.execute(hand_command(window, session.run().scenario()));
    const double now = window.seconds();
    session.advance(std::min(now - last, kMostBehind), [&] { return window.seconds() - now < kTimeForSimulation; });
    last = now;
    for (const ui::Action& action : draw_screen(session, state, theme)) session.execute(action);
    window.end_picture(theme.panel);
    if (session.take_picture_wish()) {
      const std::string path = picture_name();
      const Result<Done> saved = window.save_picture(path);
      if (saved)
        session.say_for_a_while("Picture saved as " + std::filesystem::absolute(path).string());
      else
        session.say(saved.error().message(), true);
    }
    window.show_picture();
    remember_files(session, known_files, state);
  }
  write_settings(settings_path(), settings_of(state, window, window.monitor_scale()));
  return 0;
}

}  // namespace

int run_gui(const GuiOptions& options) {
  const bool for_picture = !options.screenshot_path.empty();
  std::optional<ui::Mode> mode = mode_named(options.mode);
  if (!options.mode.empty() && !mode)
    return fail({"--mode", "\"" + options.mode + "\"", "drive, calibrate, compare, diagnose or learn"});
  const std::string data = for_picture ? "" : data_folder();
  Session session(!for_picture, data.empty() ? "" : data + "/guides",
                  data.empty() ? "" : data + "/edited_scenario.toml");
  if (options.files.empty()) session.take_up_edits();
  const auto recordings = std::count_if(options.files.begin(), options.files.end(), [](const std::string& file) {
    const FileKind kind = file_kind(file);
    return kind == FileKind::recording || kind == FileKind::foreign_recording;
  });
  if (options.mystery >= 0 || (!mode && recordings > 1)) mode = ui::Mode::diagnose;  // which has a list of them
  if (mode == ui::Mode::diagnose) session.execute(ui::SetMode{*mode});               // what is opened belongs to it
  for (const std::string& file : options.files)
    if (!session.open(file) && for_picture) {  // a person reads it in the window, a script on the terminal
      std::fprintf(
          stderr, "odolab: %s\n",
          (mode == ui::Mode::diagnose ? session.diagnosis().problem() : session.messages().back().text).c_str());
      return 2;
    }
  if (mode) session.execute(ui::SetMode{*mode});
  if (options.mystery >= 0) session.execute(ui::InDiagnosis{ui::DrawMystery{std::uint64_t(options.mystery)}});

  const Settings settings = for_picture ? Settings{} : read_settings(settings_path());
  Window::Options how;
  how.title = "OdoLab";
  how.hidden = for_picture;
  how.width = for_picture ? options.width : settings.width;
  how.height = for_picture ? options.height : settings.height;
  Result<std::unique_ptr<Window>> window = Window::open(how);
  if (!window) return fail(window.error());
  return for_picture ? run_for_picture(options, session, **window)
                     : run_for_person(options, session, **window, settings);
}

}  // namespace odolab
