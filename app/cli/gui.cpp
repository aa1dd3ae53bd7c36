#include "app/cli/command.h"
#include "app/cli/terminal.h"
#ifdef ODOLAB_HAS_GUI
#include "app/gui/gui.h"
#endif

namespace odolab {

#ifdef ODOLAB_HAS_GUI

Command gui_command() {
  const auto options = std::make_shared<GuiOptions>();
  Command command;
  command.name = "gui";
  command.about = "Opens the window, with these scenarios, recordings or vehicles loaded";
  command.example = "odolab gui assets/scenarios/square_with_cable.toml";
  command.declare = [options](Arguments& arguments) {
    arguments.files("FILE", options->files, "scenarios, recordings or vehicle files to open", false);
    arguments.option("--screenshot", options->screenshot_path, "draw without a person and write this picture (PNG)");
    arguments.option("--frames", options->frames,
                     "with --screenshot: pictures drawn before it is taken; each plays 0.75 s of the run (default 60)");
    arguments.option("--width", options->width, "width of the window in pixels");
    arguments.option("--height", options->height, "height of the window in pixels");
    arguments.option("--scale", options->scale,
                     "size of text and controls, 1 for an ordinary screen; 0: the monitor's");
    arguments.option("--mode", options->mode, "drive, calibrate, compare, diagnose or learn");
    arguments.option("--mystery", options->mystery,
                     "in Diagnose: a robot whose missing physics is concealed, by number");
    arguments.flag("--dark", options->dark, "with --screenshot: light on dark");
  };
  command.execute = [options] {
    if (options->mystery < -1) return bad_input({"--mystery", std::to_string(options->mystery), "a number from 0"});
    for (const auto& [name, pixels] : {std::pair{"--width", options->width}, {"--height", options->height}})
      if (pixels < 1) return bad_input({name, std::to_string(pixels), "1 pixel or more"});
    if (options->frames < 0) return bad_input({"--frames", std::to_string(options->frames), "0 or more"});
    if (!(options->scale >= 0.0)) return bad_input({"--scale", std::to_string(options->scale), "0 or more"});
    return run_gui(*options);
  };
  return command;
}

#else

Command gui_command() {
  Command command;
  command.name = "gui";
  command.about = "Opens the window (this program was built without it)";
  command.example = "odolab gui";
  command.declare = [](Arguments&) {};
  command.execute = [] {
    return bad_input({"odolab gui", "a program built without the window", "one built with ODOLAB_GUI=ON"});
  };
  return command;
}

#endif

}  // namespace odolab
