// A window with OpenGL and Dear ImGui behind it, seen or hidden. The only place that knows GLFW.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "ui/look/theme.h"

namespace odolab {

enum class Key {
  space,
  left,
  right,
  up,
  down,
  home,
  end,
  page_up,
  page_down,
  plus,
  minus,
  zero,
  one,
  two,
  three,
  four,
  five,
  erase,
  f1,
  f12,
  escape,
  a,
  d,
  e,
  f,
  h,
  o,
  q,
  r,
  s,
  w,
  y,
  z,
  other,
};

struct KeyPress {
  Key key = Key::other;
  bool ctrl = false;
  bool shift = false;
};

class Window {
 public:
  struct Options {
    std::string title;
    int width = 1280, height = 720;
    bool hidden = false;
  };
  static Result<std::unique_ptr<Window>> open(const Options& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  // Pixels for each pixel of a 96 dpi screen, as the monitor says.
  double monitor_scale() const;
  // Loads the fonts at this scale and gives ImGui the theme's look. Not between begin_picture and end_picture.
  ui::Theme use_theme(bool dark, double scale);

  bool wants_to_close() const;
  // `fixed_step_s` above 0 replaces the clock, for pictures that must always be the same.
  // `at_rest`: nothing moves but by a person, so that a picture now and then is enough until there is a person again.
  void begin_picture(double fixed_step_s = 0.0, bool at_rest = false);
  void end_picture(ImU32 background);
  // The picture that has ended but is not yet shown, as a PNG file.
  Result<Done> save_picture(const std::string& path);
  // Brings it before the person's eyes, no faster than the screen can show; in a hidden window nothing happens.
  void show_picture();

  // Since the last picture.
  const std::vector<KeyPress>& key_presses() const;
  const std::vector<std::string>& dropped_files() const;
  bool is_down(Key key) const;
  double seconds() const;  // of a steady clock
  int width() const;
  int height() const;  // at scale 1 and in the window system's units

 private:
  struct Parts;
  explicit Window(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace odolab
