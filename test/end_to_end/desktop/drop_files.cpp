// drop_files X Y FILE...: drags files onto the window at that place of the display and lets go, as a file manager does.
// The source's side of XDND (freedesktop.org, "Drag-and-Drop Protocol for the X Window System", version 5). Exit code 1
// where the window takes no files, refuses these, or does not answer.
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace {

constexpr double kPatience_s = 20.0;
constexpr long kVersion = 5;

// Files as text/uri-list has them (RFC 2483): what is not plain in a URI is escaped.
std::string uri_list(const std::vector<std::string>& files) {
  std::string list;
  for (const std::string& file : files) {
    list += "file://";
    for (const char c : std::filesystem::absolute(file).string()) {
      char text[4];
      const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '/' ||
                         c == '.' || c == '-' || c == '_';
      std::snprintf(text, sizeof text, plain ? "%c" : "%%%02X", plain ? c : c & 0xff);
      list += text;
    }
    list += "\r\n";
  }
  return list;
}

class Drag {
 public:
  Drag(Display* display, std::string files) : display_(display), files_(std::move(files)) {
    source_ = XCreateSimpleWindow(display_, DefaultRootWindow(display_), -10, -10, 1, 1, 0, 0, 0);
    XSetSelectionOwner(display_, atom("XdndSelection"), source_, CurrentTime);
  }

  // Null where no window below that place takes files.
  Window target_at(int x, int y) const {
    Window window = DefaultRootWindow(display_), below = window;
    while (below != None && !takes_files(below)) {
      window = below;
      int ignored_x = 0, ignored_y = 0;
      if (!XTranslateCoordinates(display_, DefaultRootWindow(display_), window, x, y, &ignored_x, &ignored_y, &below))
        return None;
    }
    return below;
  }

  bool let_go(Window target, int x, int y) {
    send(target, "XdndEnter", kVersion << 24, long(atom("text/uri-list")), 0, 0);
    send(target, "XdndPosition", 0, long(x) << 16 | y, CurrentTime, long(atom("XdndActionCopy")));
    const bool accepted = wait_for("XdndStatus") & 1;
    if (!accepted) {
      send(target, "XdndLeave", 0, 0, 0, 0);
      std::fprintf(stderr, "drop_files: the window refused the files\n");
      return false;
    }
    send(target, "XdndDrop", 0, CurrentTime, 0, 0);
    const bool taken = wait_for("XdndFinished") != 0;  // the protocol has bit 0; GLFW says how many bytes it read
    if (!taken) std::fprintf(stderr, "drop_files: the window did not take the files\n");
    return taken;
  }

 private:
  Atom atom(const char* name) const { return XInternAtom(display_, name, False); }

  bool takes_files(Window window) const {
    Atom type = None;
    int bits = 0;
    unsigned long count = 0, left = 0;
    unsigned char* value = nullptr;
    XGetWindowProperty(display_, window, atom("XdndAware"), 0, 1, False, AnyPropertyType, &type, &bits, &count, &left,
                       &value);
    if (value) XFree(value);
    return type != None;
  }

  void send(Window target, const char* message, long a, long b, long c, long d) {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = target;
    event.xclient.message_type = atom(message);
    event.xclient.format = 32;
    const long values[] = {long(source_), a, b, c, d};
    for (int i = 0; i < 5; ++i) event.xclient.data.l[i] = values[i];
    XSendEvent(display_, target, False, NoEventMask, &event);
    XFlush(display_);
  }

  // What the target answers in its second word; hands the files out where it asks for them. Zero: no answer.
  long wait_for(const char* message) {
    const Atom awaited = atom(message);
    for (double waited_s = 0.0; waited_s < kPatience_s;) {
      if (!XPending(display_)) {
        usleep(5000);
        waited_s += 0.005;
        continue;
      }
      XEvent event;
      XNextEvent(display_, &event);
      if (event.type == SelectionRequest) hand_out(event.xselectionrequest);
      if (event.type == ClientMessage && event.xclient.message_type == awaited) return event.xclient.data.l[1];
    }
    std::fprintf(stderr, "drop_files: no %s within %.0f s\n", message, kPatience_s);
    return 0;
  }

  void hand_out(const XSelectionRequestEvent& asked) {
    XEvent answer{};
    answer.xselection.type = SelectionNotify;
    answer.xselection.requestor = asked.requestor;
    answer.xselection.selection = asked.selection;
    answer.xselection.target = asked.target;
    answer.xselection.time = asked.time;
    if (asked.target == atom("text/uri-list")) {
      XChangeProperty(display_, asked.requestor, asked.property, asked.target, 8, PropModeReplace,
                      reinterpret_cast<const unsigned char*>(files_.data()), int(files_.size()));
      answer.xselection.property = asked.property;
    }
    XSendEvent(display_, asked.requestor, False, NoEventMask, &answer);
    XFlush(display_);
  }

  Display* display_;
  std::string files_;
  Window source_ = None;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "drop_files X Y FILE...\n");
    return 2;
  }
  const int x = std::atoi(argv[1]), y = std::atoi(argv[2]);
  Display* display = XOpenDisplay(nullptr);
  if (!display) {
    std::fprintf(stderr, "drop_files: no display\n");
    return 2;
  }
  Drag drag(display, uri_list({argv + 3, argv + argc}));
  const Window target = drag.target_at(x, y);
  if (target == None) std::fprintf(stderr, "drop_files: nothing at %d, %d takes files\n", x, y);
  const bool taken = target != None && drag.let_go(target, x, y);
  XCloseDisplay(display);
  return taken ? 0 : 1;
}
