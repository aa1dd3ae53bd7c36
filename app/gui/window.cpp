#include "app/gui/window.h"

#define GL_SILENCE_DEPRECATION
#include <GLFW/glfw3.h>
#include <imgui.h>
#if __has_include(<imgui_impl_glfw.h>)
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>
#else
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#endif
#include <stb/stb_image_write.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

namespace odolab {

namespace {

constexpr double kRest_s = 0.08;   // between pictures in which nothing moves
constexpr double kAwake_s = 0.5;   // after a key or the mouse, for what answers them
constexpr double kScreen_hz = 60;  // of a screen that does not say
constexpr double kDrawn_hz = 25;   // where the processor draws: it has a simulation to run

// The last thing GLFW complained about; its callback has no place for a user pointer.
std::string& last_complaint() {
  static std::string text;
  return text;
}

struct NamedKey {
  int glfw;
  Key key;
};

constexpr NamedKey kKeys[] = {{GLFW_KEY_SPACE, Key::space},
                              {GLFW_KEY_LEFT, Key::left},
                              {GLFW_KEY_RIGHT, Key::right},
                              {GLFW_KEY_UP, Key::up},
                              {GLFW_KEY_DOWN, Key::down},
                              {GLFW_KEY_HOME, Key::home},
                              {GLFW_KEY_END, Key::end},
                              {GLFW_KEY_PAGE_UP, Key::page_up},
                              {GLFW_KEY_PAGE_DOWN, Key::page_down},
                              {GLFW_KEY_EQUAL, Key::plus},
                              {GLFW_KEY_KP_ADD, Key::plus},
                              {GLFW_KEY_MINUS, Key::minus},
                              {GLFW_KEY_KP_SUBTRACT, Key::minus},
                              {GLFW_KEY_0, Key::zero},
                              {GLFW_KEY_1, Key::one},
                              {GLFW_KEY_2, Key::two},
                              {GLFW_KEY_3, Key::three},
                              {GLFW_KEY_4, Key::four},
                              {GLFW_KEY_5, Key::five},
                              {GLFW_KEY_DELETE, Key::erase},
                              {GLFW_KEY_BACKSPACE, Key::erase},
                              {GLFW_KEY_F1, Key::f1},
                              {GLFW_KEY_F12, Key::f12},
                              {GLFW_KEY_ESCAPE, Key::escape},
                              {GLFW_KEY_A, Key::a},
                              {GLFW_KEY_D, Key::d},
                              {GLFW_KEY_E, Key::e},
                              {GLFW_KEY_F, Key::f},
                              {GLFW_KEY_H, Key::h},
                              {GLFW_KEY_O, Key::o},
                              {GLFW_KEY_Q, Key::q},
                              {GLFW_KEY_R, Key::r},
                              {GLFW_KEY_S, Key::s},
                              {GLFW_KEY_W, Key::w},
                              {GLFW_KEY_Y, Key::y},
                              {GLFW_KEY_Z, Key::z}};

// Letters go by what is written on the keyboard, wherever it stands.
Key key_named(int glfw_key, int scancode) {
  const char* written = glfwGetKeyName(glfw_key, scancode);
  if (written && written[0] && !written[1]) {
    if (written[0] == '+') return Key::plus;
    if (written[0] == '-') return Key::minus;
    const int letter = written[0] >= 'a' && written[0] <= 'z' ? GLFW_KEY_A + (written[0] - 'a') : glfw_key;
    glfw_key = letter;
  }
  for (const NamedKey& k : kKeys)
    if (k.glfw == glfw_key) return k.key;
  return Key::other;
}

std::string font_file(const char* name) {
  static const char* kFolders[] = {"/usr/share/fonts/truetype/dejavu/", "/usr/share/fonts/dejavu/",
                                   "/usr/share/fonts/dejavu-sans-fonts/", "/usr/share/fonts/TTF/"};
  for (const char* folder : kFolders) {
    const std::string path = std::string(folder) + name;
    if (std::FILE* file = std::fopen(path.c_str(), "rb")) {
      std::fclose(file);
      return path;
    }
  }
  return "";
}

ImFont* add_font(const std::string& path, float pixels) {
  // Latin, Greek, punctuation, sub- and superscripts, arrows, mathematics, shapes.
  static const ImWchar kRanges[] = {0x20,   0xFF,   0x370,  0x3FF,  0x2010, 0x2044, 0x2070, 0x209C,
                                    0x2190, 0x21FF, 0x2200, 0x22FF, 0x25A0, 0x25FF, 0};
  if (path.empty()) return nullptr;
  return ImGui::GetIO().Fonts->AddFontFromFileTTF(path.c_str(), std::round(pixels), nullptr, kRanges);
}

}  // namespace

struct Window::Parts {
  GLFWwindow* window = nullptr;
  bool renderer_ready = false;
  bool hidden = false;
  double picture_s = 0.0;      // that the screen takes for one
  double shown_at_s = 0.0;     // the last
  double awake_until_s = 0.0;  // of the clock of seconds()
  std::vector<KeyPress> keys, keys_of_picture;
  std::vector<std::string> dropped, dropped_of_picture;

  static Parts& of(GLFWwindow* w) { return *static_cast<Parts*>(glfwGetWindowUserPointer(w)); }
};

Result<std::unique_ptr<Window>> Window::open(const Options& options) {
  glfwSetErrorCallback([](int, const char* words) { last_complaint() = words; });
  const char* hint = "a display; without one use: odolab run, or xvfb-run";
  if (!glfwInit()) return Error{"window", last_complaint(), hint};
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 2);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_VISIBLE, options.hidden ? GLFW_FALSE : GLFW_TRUE);
  glfwWindowHint(GLFW_SAMPLES, 4);
  int width = options.width, height = options.height;
  if (!options.hidden) {
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    // Never larger than the screen.
    int x = 0, y = 0, w = 0, h = 0;
    if (GLFWmonitor* monitor = glfwGetPrimaryMonitor()) glfwGetMonitorWorkarea(monitor, &x, &y, &w, &h);
    if (w > 0) width = std::min(width, w);
    if (h > 0) height = std::min(height, h);
  }
  auto parts = std::make_unique<Parts>();
  parts->hidden = options.hidden;
  parts->window = glfwCreateWindow(width, height, options.title.c_str(), nullptr, nullptr);
  if (!parts->window) {
    glfwTerminate();
    return Error{"window", last_complaint(), "OpenGL 3.2 or later on the display"};
  }
  glfwSetWindowUserPointer(parts->window, parts.get());
  glfwSetKeyCallback(parts->window, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
    if (action == GLFW_RELEASE) return;
    Parts::of(w).keys.push_back(
        {key_named(key, scancode), (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_SHIFT) != 0});
  });
  glfwSetDropCallback(parts->window, [](GLFWwindow* w, int count, const char** paths) {
    for (int i = 0; i < count; ++i) Parts::of(w).dropped.push_back(paths[i]);
  });
  glfwMakeContextCurrent(parts->window);
  glfwSwapInterval(options.hidden ? 0 : 1);
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* screen = monitor ? glfwGetVideoMode(monitor) : nullptr;
  parts->picture_s = 0.9 / (screen && screen->refreshRate > 0 ? screen->refreshRate : kScreen_hz);
  const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string drawn_by = renderer ? renderer : "";
  if (drawn_by.find("llvmpipe") != std::string::npos || drawn_by.find("softpipe") != std::string::npos)
    parts->picture_s = 1.0 / kDrawn_hz;
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui_ImplGlfw_InitForOpenGL(parts->window, true);
  ImGui_ImplOpenGL3_Init("#version 150");
  parts->renderer_ready = true;
  return std::unique_ptr<Window>(new Window(std::move(parts)));
}

Window::Window(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

Window::~Window() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(parts_->window);
  glfwTerminate();
}

double Window::monitor_scale() const {
  float x = 1.0f, y = 1.0f;
  glfwGetWindowContentScale(parts_->window, &x, &y);
  return std::clamp(double(x), 0.5, 4.0);
}

ui::Theme Window::use_theme(bool dark, double scale) {
  ui::Theme theme = ui::make_theme(dark, float(scale));
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.Clear();
  theme.text = add_font(font_file("DejaVuSans.ttf"), 15.0f * theme.scale);
  theme.strong = add_font(font_file("DejaVuSans-Bold.ttf"), 15.0f * theme.scale);
  theme.large = add_font(font_file("DejaVuSans.ttf"), 24.0f * theme.scale);
  if (!theme.text) {
    ImFontConfig config;
    config.SizePixels = 13.0f * theme.scale;
    fonts.AddFontDefault(&config);
  }
#if IMGUI_VERSION_NUM < 19200
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
#endif
  ui::apply(theme);
  return theme;
}

bool Window::wants_to_close() const { return glfwWindowShouldClose(parts_->window); }

void Window::begin_picture(double fixed_step_s, bool at_rest) {
  const double asked_s = seconds();
  if (at_rest && asked_s > parts_->awake_until_s) {
    glfwWaitEventsTimeout(kRest_s);
    if (seconds() - asked_s < 0.9 * kRest_s) parts_->awake_until_s = seconds() + kAwake_s;
  } else {
    glfwPollEvents();
  }
  parts_->keys_of_picture = std::move(parts_->keys);
  parts_->keys.clear();
  parts_->dropped_of_picture = std::move(parts_->dropped);
  parts_->dropped.clear();
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  if (fixed_step_s > 0.0) {
    ImGuiIO& io = ImGui::GetIO();
    io.DeltaTime = float(fixed_step_s);
#if IMGUI_VERSION_NUM >= 18700
    io.AddMousePosEvent(-1e6f, -1e6f);
#else
    io.MousePos = {-1e6f, -1e6f};
#endif
  }
  ImGui::NewFrame();
}

void Window::end_picture(ImU32 background) {
  ImGui::Render();
  int w = 0, h = 0;
  glfwGetFramebufferSize(parts_->window, &w, &h);
  const ImVec4 c = ImGui::ColorConvertU32ToFloat4(background);
  glViewport(0, 0, w, h);
  glClearColor(c.x, c.y, c.z, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Window::show_picture() {
  if (parts_->hidden) return;
  glfwSwapBuffers(parts_->window);
  const double early_s = parts_->shown_at_s + parts_->picture_s - seconds();  // where the swap did not wait
  if (early_s > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(early_s));
  parts_->shown_at_s = seconds();
}

Result<Done> Window::save_picture(const std::string& path) {
  int w = 0, h = 0;
  glfwGetFramebufferSize(parts_->window, &w, &h);
  std::vector<unsigned char> pixels(std::size_t(w) * std::size_t(h) * 3);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glFinish();
  glReadBuffer(GL_BACK);  // after a swap its content is anyone's guess
  glReadPixels(0, 0, w, h, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  std::vector<unsigned char> upright(pixels.size());
  const std::size_t row = std::size_t(w) * 3;
  for (int y = 0; y < h; ++y)
    std::copy_n(pixels.begin() + long(row * std::size_t(h - 1 - y)), row, upright.begin() + long(row * std::size_t(y)));
  if (!stbi_write_png(path.c_str(), w, h, 3, upright.data(), w * 3))
    return Error{path, "a place that cannot be written to", "a file that can be written"};
  return Done{};
}

const std::vector<KeyPress>& Window::key_presses() const { return parts_->keys_of_picture; }
const std::vector<std::string>& Window::dropped_files() const { return parts_->dropped_of_picture; }

bool Window::is_down(Key key) const {
  for (const NamedKey& k : kKeys)
    if (k.key == key && glfwGetKey(parts_->window, k.glfw) == GLFW_PRESS) return true;
  return false;
}

double Window::seconds() const { return glfwGetTime(); }

int Window::width() const {
  int w = 0, h = 0;
  glfwGetWindowSize(parts_->window, &w, &h);
  return w;
}

int Window::height() const {
  int w = 0, h = 0;
  glfwGetWindowSize(parts_->window, &w, &h);
  return h;
}

}  // namespace odolab
