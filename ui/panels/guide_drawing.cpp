#include "ui/panels/guide_drawing.h"

#include <cmath>
#include <string>

#include "ui/look/units.h"

namespace odolab::ui {

namespace {

struct Pen {
  ImDrawList& draw;
  const Theme& theme;

  void arrow(ImVec2 from, ImVec2 to, ImU32 colour, float width = 2.0f) const {
    const float dx = to.x - from.x, dy = to.y - from.y, n = std::max(1.0f, std::hypot(dx, dy));
    const float ux = dx / n, uy = dy / n, s = theme.px(8);
    draw.AddLine(from, {to.x - ux * s, to.y - uy * s}, colour, theme.px(width));
    draw.AddTriangleFilled(to, {to.x - ux * s - uy * 0.5f * s, to.y - uy * s + ux * 0.5f * s},
                           {to.x - ux * s + uy * 0.5f * s, to.y - uy * s - ux * 0.5f * s}, colour);
  }
  // A robot from above that looks along `angle` (screen, clockwise positive).
  void robot(ImVec2 at, float size, float angle, ImU32 colour, bool filled) const {
    const float c = std::cos(angle), s = std::sin(angle);
    const auto place = [&](float x, float y) { return ImVec2(at.x + c * x - s * y, at.y + s * x + c * y); };
    const ImVec2 body[] = {place(-0.5f * size, -0.4f * size), place(0.5f * size, -0.4f * size),
                           place(0.7f * size, 0.0f), place(0.5f * size, 0.4f * size), place(-0.5f * size, 0.4f * size)};
    if (filled) draw.AddConvexPolyFilled(body, 5, faded(colour, 0.18f));
    draw.AddPolyline(body, 5, colour, ImDrawFlags_Closed, theme.px(1.6f));
    for (const float side : {-1.0f, 1.0f})
      draw.AddLine(place(-0.2f * size, side * 0.47f * size), place(0.2f * size, side * 0.47f * size), colour,
                   theme.px(4));
  }
  void words(ImVec2 at, const std::string& text, ImU32 colour, float along = 0.0f) const {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    draw.AddText({std::round(at.x - along * size.x), std::round(at.y - 0.5f * size.y)}, colour, text.c_str());
  }
};

// A square from its start at the lower left, driven one way.
void square(const Pen& pen, ImVec2 low, float side, bool clockwise, double side_m, bool bumps) {
  const Theme& theme = pen.theme;
  const ImU32 colour = clockwise ? theme.orange : theme.blue;
  const float gap = theme.px(7);
  // The first side goes to the right; clockwise turns down, counter-clockwise up.
  const float y0 = clockwise ? low.y : low.y + side, y1 = clockwise ? low.y + side : low.y;
  const ImVec2 a{low.x, y0}, b{low.x + side, y0}, c{low.x + side, y1}, d{low.x, y1};
  const float way = clockwise ? 1.0f : -1.0f;
  pen.arrow({a.x + gap, a.y}, {b.x - gap, b.y}, colour);
  pen.arrow({b.x, b.y + way * gap}, {c.x, c.y - way * gap}, colour);
  pen.arrow({c.x - gap, c.y}, {d.x + gap, d.y}, colour);
  pen.arrow({d.x, d.y - way * gap}, {a.x, a.y + way * gap * 3.2f}, colour);
  if (bumps)
    for (int k = 1; k <= 10; ++k) {
      const float x = a.x + side * 0.09f * float(k), y = a.y + way * theme.px(6);
      pen.draw.AddLine({x, y - way * theme.px(4)}, {x, y + way * theme.px(9)}, theme.bump_edge, theme.px(3));
    }
  pen.robot(a, theme.px(26), 0.0f, theme.ink, true);
  const ImVec2 middle{low.x + 0.5f * side, low.y + 0.5f * side};
  const char* name = clockwise ? "clockwise" : "counter-clockwise";
  if (ImGui::CalcTextSize(name).x > side - theme.px(8)) name = clockwise ? "cw" : "ccw";
  pen.words({middle.x, middle.y - theme.px(10)}, name, colour, 0.5f);
  pen.words({middle.x, middle.y + theme.px(10)}, clockwise ? "turns right" : "turns left", theme.muted, 0.5f);
  pen.words({middle.x, clockwise ? a.y - theme.px(26) : a.y + theme.px(28)}, shown(side_m, kMetres) + " and turn",
            theme.muted, 0.5f);
}

// What is measured at the end: the start mark, and where the robot really stands.
void corner(const Pen& pen, ImVec2 low, float width, float height, bool heading) {
  const Theme& theme = pen.theme;
  const ImVec2 mark{low.x + 0.22f * width, low.y + 0.74f * height};
  const ImVec2 stands{low.x + 0.62f * width, low.y + 0.36f * height};
  pen.draw.AddRectFilled(low, {low.x + width, low.y + height}, theme.paper, theme.px(4));
  pen.draw.AddRect(low, {low.x + width, low.y + height}, theme.line, theme.px(4));
  pen.robot(mark, theme.px(44), 0.0f, theme.muted, false);
  pen.draw.AddCircleFilled(mark, theme.px(3), theme.ink);
  pen.robot(stands, theme.px(44), -0.2f, theme.ink, true);
  pen.draw.AddCircleFilled(stands, theme.px(3), theme.ink);
  pen.arrow(mark, {stands.x, mark.y}, theme.green);
  pen.arrow({stands.x, mark.y}, {stands.x, stands.y + theme.px(3)}, theme.purple);
  pen.words({0.5f * (mark.x + stands.x), mark.y + theme.px(13)}, "x", theme.green, 0.5f);
  pen.words({stands.x + theme.px(8), 0.5f * (mark.y + stands.y) + theme.px(6)}, "y, left", theme.purple);
  pen.words({mark.x, mark.y + theme.px(34)}, "start mark", theme.muted, 0.5f);
  pen.words({stands.x, stands.y - theme.px(36)}, heading ? "where it stands and looks" : "where it really stands",
            theme.ink, 0.5f);
}

void castors(const Pen& pen, ImVec2 low, float width, float height) {
  const Theme& theme = pen.theme;
  const ImVec2 centre{low.x + 0.5f * width, low.y + 0.52f * height};
  const float r = 0.3f * height;
  ImVec2 pivot[3];
  for (int k = 0; k < 3; ++k) {
    const float angle = 2.0943951f * float(k) - 1.5707963f;
    pivot[k] = {centre.x + r * std::cos(angle), centre.y + r * std::sin(angle)};
  }
  pen.draw.AddTriangleFilled(pivot[0], pivot[1], pivot[2], faded(theme.ink, 0.10f));
  pen.draw.AddTriangle(pivot[0], pivot[1], pivot[2], theme.ink, theme.px(1.6f));
  const float reach = std::hypot(pivot[1].x - pivot[0].x, pivot[1].y - pivot[0].y);
  for (const bool clockwise : {true, false}) {
    const ImU32 colour = clockwise ? theme.orange : theme.blue;
    const float from = clockwise ? 2.25f : 0.89f, way = clockwise ? 1.0f : -1.0f;
    ImVec2 before{}, at{};
    for (int i = 0; i <= 14; ++i) {
      before = at;
      const float angle = from + way * 0.05f * float(i);
      at = {pivot[0].x + reach * 1.0f * std::cos(angle), pivot[0].y + reach * std::sin(angle)};
      if (i > 0 && i < 14) pen.draw.AddLine(before, at, colour, theme.px(2));
    }
    pen.arrow(before, at, colour);
  }
  for (int k = 0; k < 3; ++k) {
    pen.draw.AddCircleFilled(pivot[k], theme.px(9), k == 0 ? theme.ink : theme.paper);
    pen.draw.AddCircle(pivot[k], theme.px(9), theme.ink, 0, theme.px(1.6f));
    const bool left = pivot[k].x < centre.x - 1.0f;
    pen.words({pivot[k].x + theme.px(left ? -14 : 14), pivot[k].y},
              "castor " + std::to_string(k + 1) + (k == 0 ? ", held still" : ""), k == 0 ? theme.ink : theme.muted,
              left ? 1.0f : 0.0f);
  }
  pen.words({centre.x, low.y + height - theme.px(10)},
            "the others drive round it, both ways; then castor 2, then castor 3", theme.muted, 0.5f);
}

void trucks(const Pen& pen, ImVec2 low, float width, float height) {
  const Theme& theme = pen.theme;
  struct Move {
    const char* words;
    float truck_angle, dx, dy;
  };
  const Move moves[] = {
      {"forward", 0.0f, 1.0f, 0.0f}, {"sideways", -1.5707963f, 0.0f, -1.0f}, {"about itself", 1.5707963f, 0.0f, 0.0f}};
  const float cell = width / 3.0f, size = std::min(theme.px(38), 0.2f * cell);
  for (int k = 0; k < 3; ++k) {
    const ImVec2 centre{low.x + cell * (float(k) + 0.5f), low.y + 0.48f * height};
    const float half = 0.26f * cell;
    const ImVec2 b{centre.x - half, centre.y}, a{centre.x + half, centre.y};
    pen.draw.AddLine(b, a, theme.muted, theme.px(3));
    const bool spin = k == 2;
    pen.robot(a, size, spin ? -1.5707963f : moves[k].truck_angle, theme.ink, true);
    pen.robot(b, size, moves[k].truck_angle, theme.ink, true);
    const float reach = theme.px(46);
    for (const ImVec2 p : {a, b}) {
      if (k == 0 && p.x < centre.x) continue;
      const float dy = spin ? (p.x > centre.x ? -1.0f : 1.0f) : moves[k].dy;
      pen.arrow({p.x + moves[k].dx * 0.6f * reach, p.y + dy * 0.7f * reach},
                {p.x + moves[k].dx * 1.3f * reach, p.y + dy * 1.6f * reach}, theme.orange);
    }
    pen.words({centre.x, low.y + height - theme.px(14)}, moves[k].words, theme.muted, 0.5f);
  }
}

}  // namespace

void guide_drawing(const GuideSession& session, float height, const Theme& theme) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const Pen pen{*ImGui::GetWindowDrawList(), theme};
  switch (session.kind) {
    case GuideKind::umbmark:
    case GuideKind::extended_umbmark: {
      // In a narrow window what is measured stands below what is driven.
      const bool bumps = session.kind == GuideKind::extended_umbmark, narrow = width < theme.px(560);
      const float side = std::min(height - theme.px(80), (narrow ? 0.36f : 0.21f) * width);
      const float y = at.y + 0.5f * (height - side), gap = (narrow ? 0.12f : 0.07f) * width;
      square(pen, {at.x + theme.px(28), y}, side, true, session.side_m, bumps);
      square(pen, {at.x + theme.px(28) + side + gap, y}, side, false, session.side_m, bumps);
      if (narrow) {
        corner(pen, {at.x, at.y + height}, width, height - theme.px(12), bumps);
        ImGui::Dummy({width, height});
      } else {
        const float x = at.x + theme.px(28) + 2.0f * side + gap + 0.06f * width;
        corner(pen, {x, at.y + theme.px(6)}, at.x + width - x, height - theme.px(12), bumps);
      }
      break;
    }
    case GuideKind::castors:
      castors(pen, at, width, height);
      break;
    case GuideKind::linked:
      trucks(pen, at, width, height);
      break;
  }
  ImGui::Dummy({width, height});
}

}  // namespace odolab::ui
