#include "gui/widgets/icons.h"

#include <initializer_list>

namespace palace {
namespace {

/// Draws in a box from -1 to 1.
struct Pen {
  ImDrawList* dl;
  ImVec2 c;
  float half;
  ImU32 colour;
  float line;

  ImVec2 At(float x, float y) const { return {c.x + x * half, c.y + y * half}; }
  void Line(float x0, float y0, float x1, float y1) const {
    dl->AddLine(At(x0, y0), At(x1, y1), colour, line);
  }
  void Triangle(float x0, float y0, float x1, float y1, float x2, float y2) const {
    dl->AddTriangleFilled(At(x0, y0), At(x1, y1), At(x2, y2), colour);
  }
  void Box(float x0, float y0, float x1, float y1) const {
    dl->AddRectFilled(At(x0, y0), At(x1, y1), colour);
  }
  void Frame(float x0, float y0, float x1, float y1) const {
    dl->AddRect(At(x0, y0), At(x1, y1), colour, half * 0.15f, 0, line);
  }
  void Ring(float x, float y, float r) const { dl->AddCircle(At(x, y), r * half, colour, 0, line); }
  void Arc(float r, float from_deg, float to_deg) const {
    dl->PathArcTo(c, r * half, from_deg * kPi / 180, to_deg * kPi / 180, 20);
    dl->PathStroke(colour, 0, line);
  }
  static constexpr float kPi = 3.14159265f;
};

void DrawDashedSquare(const Pen& p) {
  for (const float a : {-0.75f, -0.2f, 0.35f}) {
    const float b = a + 0.4f;
    p.Line(a, -0.75f, b, -0.75f);
    p.Line(a, 0.75f, b, 0.75f);
    p.Line(-0.75f, a, -0.75f, b);
    p.Line(0.75f, a, 0.75f, b);
  }
}

void DrawIn(const Pen& p, Icon icon) {
  switch (icon) {
    case Icon::kWarning:
      p.Triangle(0, -0.85f, 0.95f, 0.8f, -0.95f, 0.8f);
      break;
    case Icon::kCaution: {
      const ImVec2 points[4] = {p.At(0, -1), p.At(1, 0), p.At(0, 1), p.At(-1, 0)};
      p.dl->AddConvexPolyFilled(points, 4, p.colour);
      break;
    }
    case Icon::kAdvisory:
      p.dl->AddCircle(p.c, p.half * 0.8f, p.colour, 0, p.half * 0.33f);
      break;
    case Icon::kNormal:
      p.dl->AddCircleFilled(p.c, p.half * 0.67f, p.colour);
      break;
    case Icon::kOff:
      p.Line(-0.8f, 0, 0.8f, 0);
      break;
    case Icon::kProvisional:
      p.Ring(0, 0, 0.75f);
      p.dl->PathArcTo(p.c, p.half * 0.75f, -Pen::kPi / 2, Pen::kPi / 2, 12);
      p.dl->PathFillConvex(p.colour);
      break;
    case Icon::kStale:
      p.Ring(0, 0, 0.85f);
      p.Line(0, 0.05f, 0, -0.5f);
      p.Line(0, 0, 0.4f, 0.15f);
      break;
    case Icon::kDone: {
      const ImVec2 points[3] = {p.At(-0.75f, 0.05f), p.At(-0.2f, 0.6f), p.At(0.8f, -0.6f)};
      p.dl->AddPolyline(points, 3, p.colour, 0, p.line * 1.2f);
      break;
    }
    case Icon::kFails:
      p.Line(-0.65f, -0.65f, 0.65f, 0.65f);
      p.Line(-0.65f, 0.65f, 0.65f, -0.65f);
      break;
    case Icon::kPlay:
      p.Triangle(-0.5f, -0.7f, 0.7f, 0, -0.5f, 0.7f);
      break;
    case Icon::kPause:
      p.Box(-0.5f, -0.65f, -0.15f, 0.65f);
      p.Box(0.15f, -0.65f, 0.5f, 0.65f);
      break;
    case Icon::kStepForward:
      p.Triangle(-0.6f, -0.6f, 0.3f, 0, -0.6f, 0.6f);
      p.Box(0.35f, -0.6f, 0.6f, 0.6f);
      break;
    case Icon::kStepBack:
      p.Triangle(0.6f, -0.6f, 0.6f, 0.6f, -0.3f, 0);
      p.Box(-0.6f, -0.6f, -0.35f, 0.6f);
      break;
    case Icon::kFrameForward:
      p.Frame(-0.75f, -0.5f, 0.05f, 0.5f);
      p.Triangle(0.3f, -0.45f, 0.9f, 0, 0.3f, 0.45f);
      break;
    case Icon::kFrameBack:
      p.Frame(-0.05f, -0.5f, 0.75f, 0.5f);
      p.Triangle(-0.3f, -0.45f, -0.3f, 0.45f, -0.9f, 0);
      break;
    case Icon::kFlag:
      p.Line(-0.5f, -0.8f, -0.5f, 0.8f);
      p.Triangle(-0.45f, -0.75f, 0.65f, -0.35f, -0.45f, 0.05f);
      break;
    case Icon::kSearch:
      p.Ring(-0.15f, -0.15f, 0.5f);
      p.Line(0.22f, 0.22f, 0.75f, 0.75f);
      break;
    case Icon::kReset:
    case Icon::kReplay:
      p.Arc(0.65f, 0, 285);
      p.Triangle(0.1f, -1.05f, 0.8f, -0.65f, 0.1f, -0.2f);
      break;
    case Icon::kChevronDown:
      p.Line(-0.5f, -0.25f, 0, 0.3f);
      p.Line(0, 0.3f, 0.5f, -0.25f);
      break;
    case Icon::kChevronRight:
      p.Line(-0.25f, -0.5f, 0.3f, 0);
      p.Line(0.3f, 0, -0.25f, 0.5f);
      break;
    case Icon::kChevronLeft:
      p.Line(0.25f, -0.5f, -0.3f, 0);
      p.Line(-0.3f, 0, 0.25f, 0.5f);
      break;
    case Icon::kLoop:
      p.Line(-0.75f, 0.15f, -0.75f, -0.4f);
      p.Line(-0.75f, -0.4f, 0.4f, -0.4f);
      p.Triangle(0.35f, -0.75f, 0.8f, -0.4f, 0.35f, -0.05f);
      p.Line(0.75f, -0.15f, 0.75f, 0.4f);
      p.Line(0.75f, 0.4f, -0.4f, 0.4f);
      p.Triangle(-0.35f, 0.05f, -0.8f, 0.4f, -0.35f, 0.75f);
      break;
    case Icon::kScreen:
      p.Frame(-0.8f, -0.6f, 0.8f, 0.4f);
      p.Line(-0.35f, 0.75f, 0.35f, 0.75f);
      break;
    case Icon::kArrowRight:
      p.Line(-0.7f, 0, 0.6f, 0);
      p.Line(0.2f, -0.4f, 0.65f, 0);
      p.Line(0.65f, 0, 0.2f, 0.4f);
      break;
    case Icon::kSimulation:
      DrawDashedSquare(p);
      break;
  }
}

}  // namespace

void DrawIcon(ImDrawList* dl, Icon icon, ImVec2 centre, float size, ImU32 colour) {
  const bool status = icon <= Icon::kDone;
  const Pen pen{dl, centre, size / 2, colour, status ? size * 0.12f : size * 0.09f};
  DrawIn(pen, icon);
}

}  // namespace palace
