#include "core/io/picture/svg.h"

#include <charconv>
#include <cmath>
#include <cstdint>

#include "core/base/valid_utf8.h"

namespace odolab {

namespace {

// A tenth of a pixel is finer than any screen shows.
void append_pixels(std::string& text, double value) {
  char buffer[32];
  const double rounded = std::round(value * 10.0) / 10.0;
  const std::to_chars_result end = std::to_chars(buffer, buffer + sizeof buffer, rounded == 0.0 ? 0.0 : rounded);
  text.append(buffer, end.ptr);
}

// Stands for the picture's own name until all of it is drawn; escaped text never holds it.
constexpr char kName = '\x01';

// FNV-1a: the same picture has the same name in every run, and others on the same page have another.
std::string name_by_content(const std::string& body) {
  std::uint64_t hash = 1469598103934665603ULL;
  for (char c : body) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  char buffer[20];
  buffer[0] = 'p';
  return {buffer, std::to_chars(buffer + 1, buffer + sizeof buffer, hash, 36).ptr};
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (char c : valid_utf8(text)) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (static_cast<unsigned char>(c) >= 0x20 || c == '\n')
      result += c;
  }
  return result;
}

Stroke stroke_of(Look look) {
  switch (look) {
    case Look::truth:
      return {ink::kTruth, 1.8, ""};
    case Look::estimate:
      return {ink::kOrange, 1.8, "7 4"};
    case Look::second:
      return {ink::kBlue, 1.8, "2.5 3"};
    case Look::third:
      return {ink::kGreen, 1.8, "10 3 2 3"};
    case Look::fourth:
      return {ink::kPurple, 1.8, "4 2"};
    case Look::fifth:
      return {ink::kSky, 1.8, ""};
  }
  return {};
}

Svg::Svg(double width, double height, const std::string& title) : width_(width), height_(height) {
  body_.append("<title>").append(escaped(title)).append("</title>\n");
  rectangle({0.0, 0.0}, width, height, ink::kGround);
}

void Svg::open(const char* element) { body_ += std::string("<") + element; }

void Svg::attribute(const char* name, double value) {
  body_ += std::string(" ") + name + "=\"";
  append_pixels(body_, value);
  body_ += '"';
}

void Svg::attribute(const char* name, std::string_view value) {
  body_ += std::string(" ") + name + "=\"" + std::string(value) + "\"";
}

void Svg::stroke(const Stroke& stroke) {
  if (stroke.colour.empty()) return;
  attribute("stroke", stroke.colour);
  attribute("stroke-width", stroke.width);
  if (!stroke.dashes.empty()) attribute("stroke-dasharray", stroke.dashes);
}

void Svg::points(const std::vector<Point>& points) {
  body_ += " points=\"";
  for (const Point& p : points) {
    append_pixels(body_, p.x);
    body_ += ',';
    append_pixels(body_, p.y);
    body_ += ' ';
  }
  if (!points.empty()) body_.pop_back();
  body_ += '"';
}

void Svg::line(Point a, Point b, const Stroke& with) {
  open("line");
  attribute("x1", a.x);
  attribute("y1", a.y);
  attribute("x2", b.x);
  attribute("y2", b.y);
  stroke(with);
  body_ += "/>\n";
}

void Svg::polyline(const std::vector<Point>& through, const Stroke& with) {
  if (through.size() < 2) return;
  open("polyline");
  points(through);
  attribute("fill", "none");
  attribute("stroke-linejoin", "round");
  stroke(with);
  body_ += "/>\n";
}

void Svg::polygon(const std::vector<Point>& through, const std::string& fill, const Stroke& with) {
  open("polygon");
  points(through);
  attribute("fill", fill);
  stroke(with);
  body_ += "/>\n";
}

void Svg::rectangle(Point corner, double width, double height, const std::string& fill, const Stroke& with) {
  open("rect");
  attribute("x", corner.x);
  attribute("y", corner.y);
  attribute("width", width);
  attribute("height", height);
  attribute("fill", fill);
  stroke(with);
  body_ += "/>\n";
}

void Svg::circle(Point centre, double radius, const std::string& fill, const Stroke& with) {
  open("circle");
  attribute("cx", centre.x);
  attribute("cy", centre.y);
  attribute("r", radius);
  attribute("fill", fill);
  stroke(with);
  body_ += "/>\n";
}

void Svg::cross(Point centre, double radius, const Stroke& with) {
  line({centre.x - radius, centre.y - radius}, {centre.x + radius, centre.y + radius}, with);
  line({centre.x - radius, centre.y + radius}, {centre.x + radius, centre.y - radius}, with);
}

void Svg::text(Point at, std::string_view words, Anchor anchor, double size, const std::string& colour, bool bold) {
  open("text");
  attribute("x", at.x);
  attribute("y", at.y);
  attribute("font-size", size);
  attribute("fill", colour);
  if (anchor != Anchor::start) attribute("text-anchor", anchor == Anchor::middle ? "middle" : "end");
  if (bold) attribute("font-weight", "bold");
  body_.append(">").append(escaped(words)).append("</text>\n");
}

void Svg::text_upward(Point at, std::string_view words, double size) {
  body_ += "<text transform=\"translate(";
  append_pixels(body_, at.x);
  body_ += ' ';
  append_pixels(body_, at.y);
  body_ += ") rotate(-90)\"";
  attribute("font-size", size);
  attribute("fill", ink::kText);
  attribute("text-anchor", "middle");
  body_.append(">").append(escaped(words)).append("</text>\n");
}

void Svg::begin_clip(Point corner, double width, double height) {
  const std::string name = std::string(1, kName) + "c" + std::to_string(clips_++);
  body_ += "<clipPath id=\"" + name + "\">";
  open("rect");
  attribute("x", corner.x);
  attribute("y", corner.y);
  attribute("width", width);
  attribute("height", height);
  body_ += "/></clipPath>\n<g clip-path=\"url(#" + name + ")\">\n";
}

void Svg::end_clip() { body_ += "</g>\n"; }

std::string Svg::hatching() {
  const std::string name = std::string(1, kName) + "h";
  if (!hatched_)
    body_ += "<defs><pattern id=\"" + name +
             "\" width=\"8\" height=\"8\" patternUnits=\"userSpaceOnUse\" patternTransform=\"rotate(45)\">"
             "<rect width=\"8\" height=\"8\" fill=\"#56B4E9\" fill-opacity=\"0.13\"/>"
             "<line x1=\"0\" y1=\"0\" x2=\"0\" y2=\"8\" stroke=\"#56B4E9\" stroke-width=\"2\"/></pattern></defs>\n";
  hatched_ = true;
  return "url(#" + name + ")";
}

std::string Svg::finished() const {
  std::string size;
  append_pixels(size, width_);
  std::string height;
  append_pixels(height, height_);
  const std::string name = name_by_content(body_);
  std::string body;
  body.reserve(body_.size() + 256);
  for (char c : body_) c == kName ? body += name : body += c;
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + size + " " + height + "\" width=\"" + size +
         "\" height=\"" + height + "\" font-family=\"DejaVu Sans, Verdana, sans-serif\">\n" + body + "</svg>\n";
}

}  // namespace odolab
