#include "ui/look/icons.h"

#include <cmath>
#include <initializer_list>

namespace odolab::ui {

namespace {

// Places points given in a square from -1 to 1, y downward.
struct Brush {
  ImDrawList& draw;
  ImVec2 centre;
  float half;
  ImU32 colour;
  float thickness;

  ImVec2 at(float x, float y) const { return {centre.x + half * x, centre.y + half * y}; }
  void triangle(float x1, float y1, float x2, float y2, float x3, float y3) const {
    draw.AddTriangleFilled(at(x1, y1), at(x2, y2), at(x3, y3), colour);
  }
  void bar(float x1, float y1, float x2, float y2) const {
    draw.AddRectFilled(at(x1, y1), at(x2, y2), colour, half * 0.08f);
  }
  void line(float x1, float y1, float x2, float y2) const { draw.AddLine(at(x1, y1), at(x2, y2), colour, thickness); }
  void circle(float x, float y, float r) const { draw.AddCircle(at(x, y), half * r, colour, 0, thickness); }
  void dot(float x, float y, float r) const { draw.AddCircleFilled(at(x, y), half * r, colour); }
};

}  // namespace

void draw_icon(ImDrawList& draw, Icon icon, ImVec2 centre, float size, ImU32 colour) {
  const Brush b{draw, centre, 0.5f * size, colour, std::fmax(1.0f, size * 0.10f)};
  switch (icon) {
    case Icon::play:
      b.triangle(-0.55f, -0.8f, 0.85f, 0.0f, -0.55f, 0.8f);
      break;
    case Icon::pause:
      b.bar(-0.6f, -0.75f, -0.15f, 0.75f);
      b.bar(0.15f, -0.75f, 0.6f, 0.75f);
      break;
    case Icon::step_forward:
      b.triangle(-0.7f, -0.7f, 0.3f, 0.0f, -0.7f, 0.7f);
      b.bar(0.4f, -0.7f, 0.7f, 0.7f);
      break;
    case Icon::step_back:
      b.triangle(0.7f, 0.7f, -0.3f, 0.0f, 0.7f, -0.7f);
      b.bar(-0.7f, -0.7f, -0.4f, 0.7f);
      break;
    case Icon::to_start:
      b.triangle(0.1f, 0.7f, -0.65f, 0.0f, 0.1f, -0.7f);
      b.triangle(0.85f, 0.7f, 0.1f, 0.0f, 0.85f, -0.7f);
      b.bar(-0.9f, -0.7f, -0.66f, 0.7f);
      break;
    case Icon::to_end:
      b.triangle(-0.1f, -0.7f, 0.65f, 0.0f, -0.1f, 0.7f);
      b.triangle(-0.85f, -0.7f, -0.1f, 0.0f, -0.85f, 0.7f);
      b.bar(0.66f, -0.7f, 0.9f, 0.7f);
      break;
    case Icon::restart:
      draw.PathArcTo(centre, b.half * 0.68f, -0.9f, 4.3f, 24);
      draw.PathStroke(colour, 0, b.thickness);
      b.triangle(0.02f, -0.95f, 0.02f, -0.32f, -0.55f, -0.63f);
      break;
    case Icon::pointer: {
      const ImVec2 outline[] = {b.at(-0.5f, -0.85f), b.at(0.6f, 0.15f), b.at(0.05f, 0.22f), b.at(-0.5f, 0.7f)};
      draw.AddConvexPolyFilled(outline, 3, colour);
      b.triangle(-0.5f, -0.85f, 0.05f, 0.22f, -0.5f, 0.7f);
      b.line(0.0f, 0.15f, 0.3f, 0.8f);
      break;
    }
    case Icon::cable: {
      const ImVec2 p[] = {b.at(-0.9f, 0.45f), b.at(-0.3f, 0.45f), b.at(-0.12f, -0.4f),
                          b.at(0.12f, -0.4f), b.at(0.3f, 0.45f),  b.at(0.9f, 0.45f)};
      draw.AddPolyline(p, 6, colour, 0, b.thickness);
      break;
    }
    case Icon::disc:
      b.circle(0, 0, 0.75f);
      b.line(-0.4f, 0.4f, 0.4f, -0.4f);
      b.line(-0.65f, 0.1f, 0.1f, -0.65f);
      b.line(-0.1f, 0.65f, 0.65f, -0.1f);
      break;
    case Icon::rectangle:
      draw.AddRect(b.at(-0.8f, -0.6f), b.at(0.8f, 0.6f), colour, 0, 0, b.thickness);
      b.line(-0.4f, 0.6f, 0.5f, -0.6f);
      b.line(-0.8f, 0.2f, -0.2f, -0.6f);
      b.line(0.2f, 0.6f, 0.8f, -0.2f);
      break;
    case Icon::fit:
      for (const float sx : {-1.0f, 1.0f})
        for (const float sy : {-1.0f, 1.0f}) {
          b.line(0.75f * sx, 0.75f * sy, 0.3f * sx, 0.75f * sy);
          b.line(0.75f * sx, 0.75f * sy, 0.75f * sx, 0.3f * sy);
        }
      b.dot(0, 0, 0.2f);
      break;
    case Icon::follow:
      b.circle(0, 0, 0.5f);
      b.line(-0.9f, 0, -0.25f, 0);
      b.line(0.9f, 0, 0.25f, 0);
      b.line(0, -0.9f, 0, -0.25f);
      b.line(0, 0.9f, 0, 0.25f);
      break;
    case Icon::lens:
      b.circle(-0.15f, -0.15f, 0.55f);
      b.line(0.28f, 0.28f, 0.85f, 0.85f);
      break;
    case Icon::exaggerate:
      b.line(-0.85f, 0.6f, 0.85f, 0.6f);
      b.line(-0.85f, 0.6f, 0.85f, -0.65f);
      b.line(0.55f, -0.05f, 0.55f, 0.35f);
      b.triangle(0.4f, -0.02f, 0.7f, -0.02f, 0.55f, -0.28f);
      break;
    case Icon::layers:
      for (const float y : {-0.35f, 0.05f, 0.45f}) {
        b.line(-0.8f, y, 0.0f, y + 0.4f);
        b.line(0.0f, y + 0.4f, 0.8f, y);
      }
      b.line(-0.8f, -0.35f, 0.0f, -0.75f);
      b.line(0.0f, -0.75f, 0.8f, -0.35f);
      break;
    case Icon::close:
      b.line(-0.5f, -0.5f, 0.5f, 0.5f);
      b.line(-0.5f, 0.5f, 0.5f, -0.5f);
      break;
    case Icon::brush:  // a dashed frame about a way
      for (const float side : {-0.75f, 0.75f})
        for (const float from : {-0.75f, -0.15f, 0.45f}) {
          b.line(from, side, from + 0.3f, side);
          b.line(side, from, side, from + 0.3f);
        }
      b.line(-0.45f, 0.3f, 0.0f, -0.25f);
      b.line(0.0f, -0.25f, 0.45f, 0.1f);
      break;
  }
}

}  // namespace odolab::ui
