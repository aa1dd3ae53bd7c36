// A Dear ImGui context without a display, with a mouse that tests move.
#pragma once

#include <imgui.h>

#include <functional>

#include "ui/look/theme.h"

namespace odolab::ui {

class HeadlessScreen {
 public:
  explicit HeadlessScreen(float width = 1280, float height = 720) {
    context_ = ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {width, height};
    unsigned char* pixels = nullptr;
    int w = 0, h = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &w, &h);
    theme = make_theme(false, 1.0f);
    apply(theme);
  }
  ~HeadlessScreen() { ImGui::DestroyContext(context_); }
  HeadlessScreen(const HeadlessScreen&) = delete;
  HeadlessScreen& operator=(const HeadlessScreen&) = delete;

  // One picture with a window of the given place in which `content` draws.
  void picture(const std::function<void()>& content, ImVec2 low = {0, 0}, ImVec2 size = {0, 0}) {
    ImGuiIO& io = ImGui::GetIO();
    io.DeltaTime = 1.0f / 60.0f;
    feed_mouse();
    ImGui::NewFrame();
    ImGui::SetNextWindowPos(low);
    ImGui::SetNextWindowSize(size.x > 0 ? size : io.DisplaySize);
    ImGui::Begin("test", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
    content();
    ImGui::End();
    ImGui::Render();
    wheel_ = 0.0f;
  }

  void move(ImVec2 to) { mouse_ = to; }
  void press(bool down) { down_ = down; }
  void wheel(float by) { wheel_ = by; }

  // Moves there, waits a picture so that the widget under the mouse is known, presses, and lets go.
  void click(ImVec2 at, const std::function<void()>& content, ImVec2 low = {0, 0}, ImVec2 size = {0, 0}) {
    move(at);
    picture(content, low, size);
    press(true);
    picture(content, low, size);
    press(false);
    picture(content, low, size);
  }
  // Presses at one place, moves in steps, and lets go at another.
  void drag(ImVec2 from, ImVec2 to, const std::function<void()>& content, int steps = 8) {
    move(from);
    picture(content);
    press(true);
    picture(content);
    for (int i = 1; i <= steps; ++i) {
      const float u = float(i) / float(steps);
      move({from.x + u * (to.x - from.x), from.y + u * (to.y - from.y)});
      picture(content);
    }
    press(false);
    picture(content);
  }
  // Types characters, one a picture.
  void type(const char* text, const std::function<void()>& content, ImVec2 low = {0, 0}, ImVec2 size = {0, 0}) {
    for (const char* c = text; *c; ++c) {
      ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(*c));
      picture(content, low, size);
    }
  }
  void press_key(ImGuiKey key, const std::function<void()>& content, ImVec2 low = {0, 0}, ImVec2 size = {0, 0}) {
    for (const bool down : {true, false}) {
#if IMGUI_VERSION_NUM >= 18700
      ImGui::GetIO().AddKeyEvent(key, down);
#else
      ImGui::GetIO().KeyMap[key] = int(key) + 1;
      ImGui::GetIO().KeysDown[int(key) + 1] = down;
#endif
      picture(content, low, size);
    }
  }
  void double_click(ImVec2 at, const std::function<void()>& content, ImVec2 low = {0, 0}, ImVec2 size = {0, 0}) {
    click(at, content, low, size);
    click(at, content, low, size);
  }
  // Long enough that two clicks are not taken for a double one.
  void pause(const std::function<void()>& content) {
    for (int i = 0; i < 60; ++i) picture(content);
  }

  Theme theme;

 private:
  void feed_mouse() {
    ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18700
    io.AddMousePosEvent(mouse_.x, mouse_.y);
    io.AddMouseButtonEvent(0, down_);
    if (wheel_ != 0.0f) io.AddMouseWheelEvent(0.0f, wheel_);
#else
    io.MousePos = mouse_;
    io.MouseDown[0] = down_;
    io.MouseWheel = wheel_;
#endif
  }

  ImGuiContext* context_ = nullptr;
  ImVec2 mouse_{-1e6f, -1e6f};
  bool down_ = false;
  float wheel_ = 0.0f;
};

}  // namespace odolab::ui
