// A vector picture that is drawn element by element, and the look that all pictures share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace odolab {

// Colours that are told apart by all eyes (Okabe and Ito).
namespace ink {
inline constexpr const char* kTruth = "#1a1a1a";
inline constexpr const char* kOrange = "#D55E00";
inline constexpr const char* kBlue = "#0072B2";
inline constexpr const char* kGreen = "#009E73";
inline constexpr const char* kPurple = "#CC79A7";
inline constexpr const char* kSky = "#56B4E9";
inline constexpr const char* kYellow = "#F0E442";
inline constexpr const char* kText = "#333333";
inline constexpr const char* kAxis = "#8a8a8a";
inline constexpr const char* kGrid = "#e3e3e0";
inline constexpr const char* kMarked = "#fbf3b4";  // a pale yellow, as of a text marker
inline constexpr const char* kShaded = "#f0f0ee";  // the ground of every second stretch
inline constexpr const char* kGround = "#fbfbf9";
}  // namespace ink

// How a line of data is drawn: the truth solid, what is estimated dashed and coloured.
enum class Look { truth, estimate, second, third, fourth, fifth };

struct Stroke {
  std::string colour;
  double width = 1.0;
  std::string dashes;  // as in SVG, empty: solid
};

Stroke stroke_of(Look look);

struct Point {
  double x = 0.0;
  double y = 0.0;
};

enum class Anchor { start, middle, end };

// Picture coordinates are pixels, x to the right, y down.
class Svg {
 public:
  Svg(double width, double height, const std::string& title);

  void line(Point a, Point b, const Stroke& stroke);
  void polyline(const std::vector<Point>& points, const Stroke& stroke);
  void polygon(const std::vector<Point>& points, const std::string& fill, const Stroke& stroke);
  void rectangle(Point corner, double width, double height, const std::string& fill, const Stroke& stroke = {});
  void circle(Point centre, double radius, const std::string& fill, const Stroke& stroke);
  void cross(Point centre, double radius, const Stroke& stroke);
  void text(Point at, std::string_view words, Anchor anchor = Anchor::start, double size = 12.0,
            const std::string& colour = ink::kText, bool bold = false);
  void text_upward(Point at, std::string_view words, double size = 12.0);

  // What follows is drawn inside this rectangle only, until the end.
  void begin_clip(Point corner, double width, double height);
  void end_clip();

  // A fill of slanted lines.
  std::string hatching();

  // A whole <svg> element, which is also a whole SVG file.
  std::string finished() const;

 private:
  void open(const char* element);
  void attribute(const char* name, double value);
  void attribute(const char* name, std::string_view value);
  void stroke(const Stroke& stroke);
  void points(const std::vector<Point>& points);

  double width_, height_;
  std::string body_;
  int clips_ = 0;
  bool hatched_ = false;
};

// Text made safe inside XML and HTML.
std::string escaped(std::string_view text);

}  // namespace odolab
