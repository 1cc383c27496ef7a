#include "gui/panels/search_map_marks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "gui/panels/course_rose.h"
#include "gui/widgets/draw.h"
#include "gui/widgets/map/projection.h"
#include "gui/widgets/map/site_marks.h"

namespace palace {
namespace {

constexpr int kCirclePoints = 72;
constexpr float kLetter = 9, kTouch = 11;  // half of a letter's disc, and of where it takes clicks

/// Runs of squares that were looked at, row by row.
void DrawSeen(const SeenGround& seen, const MapGround& ground, ImU32 colour) {
  const GridGeometry& g = seen.squares;
  for (int row = 0; row < g.rows; ++row) {
    for (int col = 0; col < g.cols; ++col) {
      const int first = col;
      while (col < g.cols && seen.IsLookedAt({row, col})) {
        ++col;
      }
      if (col > first) {
        const ImVec2 a = ground.At({g.NorthOfRow(row - 0.5), g.EastOfCol(first - 0.5)});
        const ImVec2 b = ground.At({g.NorthOfRow(row + 0.5), g.EastOfCol(col - 0.5)});
        FillRect(Canvas(), {a.x, a.y, b.x - a.x, b.y - a.y}, colour);
      }
    }
  }
}

void DrawLimit(const MissionStatus& m, const MapGround& ground, UiFrame& ui) {
  const Style& s = ui.style;
  std::vector<ImVec2> points;
  if (m.area) {
    points = ground.At(m.area->corners_W);
    points.push_back(points.front());
    Canvas()->AddPolyline(points.data(), static_cast<int>(points.size()), picture::kWhite, 0,
                          s.Fine(1.5F));
    return;
  }
  if (!m.seen) {
    return;
  }
  for (int k = 0; k <= kCirclePoints; ++k) {
    const double turn = 2 * std::numbers::pi * k / kCirclePoints;
    points.push_back(
        ground.At(m.seen->middle_W +
                  SeenGround::kSearched_m * Eigen::Vector2d(std::cos(turn), std::sin(turn))));
  }
  DashedPolyline(Canvas(), points, s.palette.text3, s.Fine(1), s.Px(6), s.Px(4));
}

/// A dart that points where the vehicle does.
void DrawDart(const MapGround& ground, const Eigen::Vector2d& at, double heading_rad, bool filled,
              UiFrame& ui) {
  const Style& s = ui.style;
  const ImVec2 c = ground.At(at);
  const float fx = static_cast<float>(std::sin(heading_rad)),
              fy = -static_cast<float>(std::cos(heading_rad));
  const float l = s.Px(10), w = s.Px(6);
  const ImVec2 points[] = {{c.x + fx * l, c.y + fy * l},
                           {c.x - fx * l - fy * w, c.y - fy * l + fx * w},
                           {c.x - fx * l * 0.5F, c.y - fy * l * 0.5F},
                           {c.x - fx * l + fy * w, c.y - fy * l - fx * w}};
  if (filled) {
    Canvas()->AddTriangleFilled(points[0], points[1], points[2], picture::kWhite);
    Canvas()->AddTriangleFilled(points[0], points[2], points[3], picture::kWhite);
  } else {
    Canvas()->AddPolyline(points, 4, picture::kWhite, ImDrawFlags_Closed, s.Fine(1.5F));
  }
}

/// What a level hover there shows of the ground.
void DrawView(const EngineSnapshot& snap, const MapGround& ground, const RigidTransform& X_WB,
              ImU32 colour, UiFrame& ui) {
  const Style& s = ui.style;
  const auto camera = LeftCamera(snap);
  const auto& seen = snap.flight->mission.seen;
  if (!camera || !snap.sensors->rig || !seen) {
    return;
  }
  const RigidTransform X_WC = X_WB * snap.sensors->rig->X_BC();
  std::vector<ImVec2> view = ground.At(GroundFootprint(*camera, X_WC, seen->ground_m));
  if (view.size() > 2) {
    view.push_back(view.front());
    DashedPolyline(Canvas(), view, colour, s.Fine(1), s.Px(4), s.Px(3));
  }
}

/// Where it is sent, or would look next.
void DrawWay(const EngineSnapshot& snap, const MapGround& ground, const Eigen::Vector3d& from_W,
             const Eigen::Vector3d& to_W, double heading_rad, UiFrame& ui) {
  constexpr double kOnTheSpot_m = 1;
  const Style& s = ui.style;
  if ((to_W - from_W).head<2>().norm() > kOnTheSpot_m) {
    DashedLine(Canvas(), ground.At(from_W.head<2>()), ground.At(to_W.head<2>()), picture::kWhite,
               s.Fine(1.5F), s.Px(4), s.Px(3));
    DrawDart(ground, to_W.head<2>(), heading_rad, false, ui);
  }
  DrawView(snap, ground, {RotationFromEuler({0, 0, heading_rad}), to_W}, picture::kWhite, ui);
}

void DrawVehicle(const EngineSnapshot& snap, const MapGround& ground, UiFrame& ui) {
  const MissionStatus& m = snap.flight->mission;
  const auto& pose = snap.sensors->pose;
  if (!pose) {
    return;
  }
  const RigidTransform& X_WB = pose->X_WB;
  DrawView(snap, ground, X_WB, ui.style.palette.text3, ui);
  if (m.going) {
    DrawWay(snap, ground, X_WB.p, m.going->p_WB, m.going->heading_rad, ui);
  } else if (m.next_look) {
    DrawWay(snap, ground, X_WB.p, m.next_look->p_WB, m.next_look->heading_rad, ui);
  }
  DrawDart(ground, X_WB.p.head<2>(), EulerFromRotation(X_WB.R).yaw_rad, true, ui);
}

/// From the letter to the place that it stands for.
void DrawLeader(const Style& s, const LetterPlace& place) {
  ImDrawList* dl = Canvas();
  dl->AddLine(place.anchor, place.centre(), WithAlpha(picture::kBlack, 0.7F), s.Fine(3));
  dl->AddLine(place.anchor, place.centre(), picture::kWhite, s.Fine(1));
  dl->AddCircleFilled(place.anchor, s.Fine(3), picture::kWhite);
  dl->AddCircle(place.anchor, s.Fine(3), picture::kBlack, 0, s.Fine(1));
}

void DrawSiteLetter(const MissionStatus& m, const LandingSite& site, ImVec2 at, bool offers,
                    UiFrame& ui) {
  LetterLook look{ui.highlighted_site == site.id, m.IsRefused(site.id), kLetter};
  if (offers) {
    look.highlighted |= OfferLetter(ui, "search_map", at, site, m).hovered;
  }
  if (m.armed && m.armed->id == site.id) {
    LetterPlate(ui, at, site.letter, true, 2 * kLetter);
  } else {
    DrawLetterDisc(ui, at, site.letter, look);
  }
}

}  // namespace

std::vector<ImVec2> MapGround::At(const std::vector<Eigen::Vector2d>& places) const {
  std::vector<ImVec2> points;
  for (const Eigen::Vector2d& place : places) {
    points.push_back(At(place));
  }
  return points;
}

void DrawSearchGround(const EngineSnapshot& snap, const MapGround& ground, UiFrame& ui) {
  const MissionStatus& m = snap.flight->mission;
  if (m.seen) {
    DrawSeen(*m.seen, ground, kLookedAt);
  }
  DrawLimit(m, ground, ui);
  DrawCourses(m, ground, ui);
  DrawVehicle(snap, ground, ui);
}

void DrawSearchSites(const EngineSnapshot& snap, const MapGround& ground, const Rect& within,
                     bool offers, std::vector<LetterPlace>& places, UiFrame& ui) {
  const std::vector<LetterPlace> last = std::exchange(places, {});
  const Style& s = ui.style;
  const MissionStatus& m = snap.flight->mission;
  std::vector<const LandingSite*> shown;
  const auto show = [&](const LandingSite& site) {
    const ImVec2 at = ground.At(site.p_WS.head<2>());
    if (ground.rect.Contains(at)) {
      const float half = std::max(s.Px(kTouch), LetterHalfWidth(s, site.letter, kLetter));
      shown.push_back(&site);
      places.push_back({site.id, at, {half, s.Px(kTouch)}});
    }
  };
  if (m.armed && HasCourses(m)) {
    show(*m.armed);  // the others would cover its courses
  } else if (snap.terrain->applied) {
    for (const LandingSite& site : snap.terrain->applied->selection.sites) {
      show(site);
    }
  }
  SpreadLetters(places, last, within);
  for (const LetterPlace& place : places) {
    if (place.moved) {
      DrawLeader(s, place);
    }
  }
  for (std::size_t i = places.size(); i-- > 0;) {  // the best last: it lies on top
    DrawSiteLetter(m, *shown[i], places[i].centre(), offers, ui);
  }
}

void DrawNorth(const Rect& scene, UiFrame& ui) {
  const Style& s = ui.style;
  const float x = scene.right() - s.Px(18), y = scene.bottom() - s.Px(34);
  DrawText(ui, s.caption, s.palette.text2, x, scene.bottom() - s.Px(14), "N", Align::kCentre);
  Canvas()->AddTriangleFilled({x, y - s.Px(7)}, {x - s.Px(4), y + s.Px(5)},
                              {x + s.Px(4), y + s.Px(5)}, s.palette.text2);
}

double SeenArea_m2(const SeenGround& seen) {
  const auto& maps = seen.maps.cells();
  const auto looked_at = std::count_if(
      maps.begin(), maps.end(), [](std::uint8_t made) { return made >= SeenGround::kMapsOfALook; });
  return static_cast<double>(looked_at) * SeenGround::kSquare_m * SeenGround::kSquare_m;
}

}  // namespace palace
