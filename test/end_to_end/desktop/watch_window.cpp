// watch_window still [X Y W H]: returns when what is shown there, or on the whole display, has not changed for a while.
// watch_window changed SUM [X Y W H]: returns when it is no longer what had that sum.
// watch_window sum [X Y W H]: returns at once.
// Prints the sum of what is shown. Exit code 1 where that does not happen within WATCH_PATIENCE seconds (30).
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

constexpr int kLook_us = 20000;
constexpr int kStillLooks = 12;  // a quarter of a second: longer than a slow picture takes to draw

struct Place {
  int x = 0, y = 0;
  unsigned width = 0, height = 0;
};

// FNV-1a over the pixels.
std::uint64_t sum_of(Display* display, const Place& place) {
  XImage* image =
      XGetImage(display, DefaultRootWindow(display), place.x, place.y, place.width, place.height, AllPlanes, ZPixmap);
  if (!image) return 0;
  std::uint64_t sum = 14695981039346656037u;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(image->data);
  for (long i = 0; i < long(image->bytes_per_line) * image->height; i += 4) {
    for (int c = 0; c < 3; ++c) sum = (sum ^ bytes[i + c]) * 1099511628211u;
  }
  XDestroyImage(image);
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const int first = what == "changed" ? 3 : 2;
  if ((what != "still" && what != "changed" && what != "sum") || (argc != first && argc != first + 4)) {
    std::fprintf(stderr, "watch_window still|sum|changed SUM [X Y W H]\n");
    return 2;
  }
  Display* display = XOpenDisplay(nullptr);
  if (!display) {
    std::fprintf(stderr, "watch_window: no display\n");
    return 2;
  }
  Place place{0, 0, unsigned(DisplayWidth(display, 0)), unsigned(DisplayHeight(display, 0))};
  if (argc == first + 4)
    place = {std::atoi(argv[first]), std::atoi(argv[first + 1]), unsigned(std::atoi(argv[first + 2])),
             unsigned(std::atoi(argv[first + 3]))};
  const char* patience = std::getenv("WATCH_PATIENCE");
  const long looks = long((patience ? std::atof(patience) : 30.0) * 1e6 / kLook_us);
  const std::uint64_t before = what == "changed" ? std::strtoull(argv[2], nullptr, 10) : 0;

  std::uint64_t sum = sum_of(display, place);
  bool happened = what == "sum";
  int still = 0;
  for (long k = 0; !happened && k < looks; ++k) {
    usleep(kLook_us);
    const std::uint64_t now = sum_of(display, place);
    still = now == sum ? still + 1 : 0;
    sum = now;
    happened = what == "still" ? still >= kStillLooks : sum != before;
  }
  std::printf("%llu\n", static_cast<unsigned long long>(sum));
  XCloseDisplay(display);
  return happened ? 0 : 1;
}
