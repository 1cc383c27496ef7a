#include "gui/panels/search_map.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <numbers>

#include "engine/core/units.h"
#include "engine/model/mission/refused_lately.h"
#include "gui/panels/map_views.h"
#include "gui/panels/way_button.h"
#include "gui/widgets/button.h"
#include "gui/widgets/map/projection.h"
#include "gui/widgets/map/site_marks.h"
#include "gui/widgets/number_text.h"
#include "gui/widgets/panel_frame.h"

namespace palace {
namespace {

constexpr double kNearest_m = 15, kFarthest_m = 250;  // half sides
constexpr double kArrow_m = 2;
constexpr double kCeilingStep_m = 5, kCeilingAbove_m = 20;
constexpr float kSnap_px = 10;  // to the first corner
constexpr int kCirclePoints = 72;

/// Where places lie on the screen: north up.
struct Ground {
  Rect rect;
  Eigen::Vector2d middle;
  double per_px;  // metres

  ImVec2 At(const Eigen::Vector2d& place) const {
    return {rect.x + rect.w / 2 + static_cast<float>((place.y() - middle.y()) / per_px),
            rect.y + rect.h / 2 - static_cast<float>((place.x() - middle.x()) / per_px)};
  }
  Eigen::Vector2d Place(ImVec2 at) const {
    return {middle.x() - static_cast<double>(at.y - rect.y - rect.h / 2) * per_px,
            middle.y() + static_cast<double>(at.x - rect.x - rect.w / 2) * per_px};
  }
};

Ground GroundOf(const EngineSnapshot& snap, const Rect& scene, const SearchMapState& state) {
  const auto& seen = snap.flight->mission.seen;
  const auto& pose = snap.sensors->pose;
  const Eigen::Vector2d middle = seen   ? seen->middle_W
                                 : pose ? Eigen::Vector2d(pose->X_WB.p.head<2>())
                                        : Eigen::Vector2d(0, 0);
  const double px = std::max(1.0, static_cast<double>(std::min(scene.w, scene.h)));
  return {scene, middle, 2 * state.half_m / px};
}

/// Runs of squares that were looked at, row by row.
void DrawSeen(const SeenGround& seen, const Ground& ground, ImU32 colour) {
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

double SeenArea_m2(const SeenGround& seen) {
  const auto& maps = seen.maps.cells();
  const auto looked_at = std::count_if(
      maps.begin(), maps.end(), [](std::uint8_t made) { return made >= SeenGround::kMapsOfALook; });
  return static_cast<double>(looked_at) * SeenGround::kSquare_m * SeenGround::kSquare_m;
}

std::vector<ImVec2> OnScreen(const std::vector<Eigen::Vector2d>& places, const Ground& ground) {
  std::vector<ImVec2> points;
  for (const Eigen::Vector2d& place : places) {
    points.push_back(ground.At(place));
  }
  return points;
}

void DrawLimit(const MissionStatus& m, const Ground& ground, UiFrame& ui) {
  const Style& s = ui.style;
  std::vector<ImVec2> points;
  if (m.area) {
    points = OnScreen(m.area->corners_W, ground);
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
void DrawDart(const Ground& ground, const Eigen::Vector2d& at, double heading_rad, bool filled,
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
void DrawView(const EngineSnapshot& snap, const Ground& ground, const RigidTransform& X_WB,
              ImU32 colour, UiFrame& ui) {
  const Style& s = ui.style;
  const auto camera = LeftCamera(snap);
  const auto& seen = snap.flight->mission.seen;
  if (!camera || !snap.sensors->rig || !seen) {
    return;
  }
  const RigidTransform X_WC = X_WB * snap.sensors->rig->X_BC();
  std::vector<ImVec2> view = OnScreen(GroundFootprint(*camera, X_WC, seen->ground_m), ground);
  if (view.size() > 2) {
    view.push_back(view.front());
    DashedPolyline(Canvas(), view, colour, s.Fine(1), s.Px(4), s.Px(3));
  }
}

/// Where it is sent, or would look next.
void DrawWay(const EngineSnapshot& snap, const Ground& ground, const Eigen::Vector3d& from_W,
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

void DrawVehicle(const EngineSnapshot& snap, const Ground& ground, UiFrame& ui) {
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

/// "N" and an arrow at the bottom right.
void DrawNorth(const Rect& scene, UiFrame& ui) {
  const Style& s = ui.style;
  const float x = scene.right() - s.Px(18), y = scene.bottom() - s.Px(34);
  DrawText(ui, s.caption, s.palette.text2, x, scene.bottom() - s.Px(14), "N", Align::kCentre);
  Canvas()->AddTriangleFilled({x, y - s.Px(7)}, {x - s.Px(4), y + s.Px(5)},
                              {x + s.Px(4), y + s.Px(5)}, s.palette.text2);
}

void DrawSites(const EngineSnapshot& snap, const Ground& ground, UiFrame& ui) {
  if (!snap.terrain->applied) {
    return;
  }
  const auto& armed = snap.flight->mission.armed;
  for (const LandingSite& site : snap.terrain->applied->selection.sites) {
    const ImVec2 at = ground.At(site.p_WS.head<2>());
    const bool is_asked = !armed || armed->id == site.id;  // the others would cover its courses
    if (is_asked && ground.rect.Contains(at)) {
      LetterPlate(ui, at, site.letter, armed && armed->id == site.id);
    }
  }
}

/// Of the armed site: each course as a ray on the side that it comes from, as long as it suits;
/// hatched where something stands there or the wind comes too much from behind. White: the plan.
void DrawHeadings(const MissionStatus& m, const Ground& ground, UiFrame& ui) {
  if (!m.armed || !m.headings) {
    return;
  }
  const Style& s = ui.style;
  const ImVec2 c = ground.At(m.armed->p_WS.head<2>());
  const float from_px = s.Px(14), full_px = s.Px(56);
  const auto end = [&](double heading_rad, float radius) {
    const auto north = static_cast<float>(-std::cos(heading_rad));  // it comes from behind
    const auto east = static_cast<float>(-std::sin(heading_rad));
    return ImVec2{c.x + east * radius, c.y - north * radius};
  };
  for (const HeadingScore& score : m.headings->headings) {
    const float radius =
        from_px + (full_px - from_px) * static_cast<float>(std::clamp(score.combined, 0.0, 1.0));
    const ImVec2 a = end(score.heading_rad, from_px), b = end(score.heading_rad, radius);
    if (score.IsVetoed()) {
      DashedLine(Canvas(), a, b, picture::kUnsafeLine, s.Fine(1.5F), s.Px(2), s.Px(3));
    } else {
      Canvas()->AddLine(a, b, picture::kSafe, s.Fine(1.5F));
    }
  }
  if (m.approach && std::isfinite(m.approach->heading_rad)) {
    Canvas()->AddLine(end(m.approach->heading_rad, from_px),
                      end(m.approach->heading_rad, full_px + s.Px(10)), picture::kWhite, s.Fine(3));
  }
}

/// "Approach 045°: wind 0.92, sun not known, turn 0.60".
std::string HeadingWords(const EngineSnapshot& snap) {
  const MissionStatus& m = snap.flight->mission;
  if (!m.headings || !m.approach || !std::isfinite(m.approach->heading_rad)) {
    return {};
  }
  const double step = 2 * std::numbers::pi / kApproachHeadings;
  const long nearest = std::lround(WrapAngle(m.approach->heading_rad) / step);
  const HeadingScore& score =
      m.headings
          ->headings[static_cast<std::size_t>((nearest + kApproachHeadings) % kApproachHeadings)];
  const long degrees = (std::lround(Deg(m.approach->heading_rad)) + 360) % 360;
  char heading[16];
  std::snprintf(heading, sizeof heading, "%03ld°", degrees);
  const bool sun = snap.session->settings.mission.sun == SunSource::kByPlace;
  return std::string("Approach ") + heading + ": wind " +
         (std::isfinite(score.tailwind_mps) ? Fixed(score.wind, 2) : "not known") + ", sun " +
         (sun ? Fixed(score.sun, 2) : "not known") + ", turn " + Fixed(score.orientation, 2);
}

void DrawDrawnArea(const SearchMapState& state, const Ground& ground, ImVec2 pointer, bool hovered,
                   UiFrame& ui) {
  const Style& s = ui.style;
  std::vector<ImVec2> points = OnScreen(state.corners, ground);
  for (const ImVec2& corner : points) {
    FillRect(Canvas(), {corner.x - s.Px(3), corner.y - s.Px(3), s.Px(6), s.Px(6)}, picture::kWhite);
  }
  if (hovered && !points.empty()) {
    points.push_back(pointer);
  }
  if (points.size() > 2) {
    points.push_back(points.front());
  }
  if (points.size() > 1) {
    DashedPolyline(Canvas(), points, picture::kWhite, s.Fine(1.5F), s.Px(6), s.Px(4));
  }
}

void DrawCross(const Eigen::Vector2d& place, const Ground& ground, UiFrame& ui) {
  const Style& s = ui.style;
  const ImVec2 at = ground.At(place);
  const float arm = s.Px(8);
  for (const float width : {s.Px(3), s.Px(1)}) {
    const ImU32 colour = width > s.Px(1) ? WithAlpha(picture::kBlack, 0.6F) : picture::kWhite;
    FillRect(Canvas(), {at.x - arm, at.y - width / 2, 2 * arm, width}, colour);
    FillRect(Canvas(), {at.x - width / 2, at.y - arm, width, 2 * arm}, colour);
  }
}

void CloseArea(SearchMapState& state, UiFrame& ui) {
  const FlyArea area{state.corners, state.ceiling_m};
  state.why_not = WhyNoArea(area);
  if (state.why_not.empty()) {
    ui.intents.push_back(CommandAction(SetFlyArea{area}));
    state.draws = false;
    state.corners.clear();
  }
}

void TakeBack(SearchMapState& state) {
  if (state.draws && !state.corners.empty()) {
    state.corners.pop_back();
  } else if (!state.draws) {
    state.picked.reset();
  }
  state.why_not.clear();
}

void TakePlace(const Eigen::Vector2d& place, const Ground& ground, SearchMapState& state,
               UiFrame& ui) {
  const auto near = [&](const Eigen::Vector2d& other) {
    return (other - place).norm() <= static_cast<double>(ui.style.Px(kSnap_px)) * ground.per_px;
  };
  state.why_not.clear();
  if (!state.draws) {
    const bool again = state.picked && near(*state.picked);
    state.picked = again ? std::nullopt : std::optional(place);
  } else if (state.corners.size() >= FlyArea::kFewestCorners && near(state.corners.front())) {
    CloseArea(state, ui);
  } else if (state.corners.size() < FlyArea::kMostCorners) {
    state.corners.push_back(place);
  }
}

/// Small buttons on the map, in rows as wide as it is.
struct Row {
  UiFrame& ui;
  float left, right, y;
  float x = left;

  /// Where the next one of that width stands.
  Rect Next(float width) {
    const Style& s = ui.style;
    if (x > left && x + width > right) {
      x = left;
      y += s.Px(25);
    }
    const Rect rect{x, y, width, s.Px(22)};
    x = rect.right() + s.Px(3);
    return rect;
  }

  bool Offer(const char* name, const std::string& words, const ButtonLook& how = {}) {
    const Style& s = ui.style;
    ButtonLook look = how;
    look.font = s.caption;
    return DrawButton(ui, name, Next(TextWidth(s.caption, words) + s.Px(12)), words, look);
  }
  void Say(const std::string& words) {
    const Style& s = ui.style;
    const Rect plate = Next(TextWidth(s.caption, words) + s.Px(12));
    FillRect(Canvas(), plate, picture::kPlate, s.Fine(3));
    DrawText(ui, s.caption, picture::kPlateText, plate.x + s.Px(6), plate.y + plate.h / 2, words);
  }
};

void BeginArea(const EngineSnapshot& snap, SearchMapState& state) {
  state.draws = true;
  state.corners.clear();
  state.picked.reset();
  state.why_not.clear();
  const auto& pose = snap.sensors->pose;
  const double height_m = pose ? HeightFromDown(pose->X_WB.p.z()) : 0;
  state.ceiling_m = std::ceil((height_m + kCeilingAbove_m) / kCeilingStep_m) * kCeilingStep_m;
}

void DrawAreaButtons(const EngineSnapshot& snap, Row& row, SearchMapState& state, UiFrame& ui) {
  const MissionStatus& m = snap.flight->mission;
  if (state.draws) {
    ButtonLook close, undo;
    close.enabled = state.corners.size() >= FlyArea::kFewestCorners;
    close.reason = "Click three corners or more on this map";
    undo.enabled = !state.corners.empty();
    undo.reason = "No corner yet";
    if (row.Offer("area_close", "Close area", close)) {
      CloseArea(state, ui);
    }
    if (row.Offer("area_undo", "Undo corner", undo)) {
      TakeBack(state);
    }
    if (row.Offer("area_cancel", "Cancel")) {
      state.draws = false;
      state.corners.clear();
    }
    row.Say("Ceiling " + Fixed(state.ceiling_m, 0) + " m");
    if (row.Offer("area_lower", "−")) {
      state.ceiling_m -= kCeilingStep_m;
    }
    if (row.Offer("area_higher", "+")) {
      state.ceiling_m += kCeilingStep_m;
    }
    return;
  }
  ButtonLook look;
  look.enabled = m.may_select && snap.session->can_transmit;
  look.reason = "No vehicle is commanded here";
  look.hint = "Keeps the vehicle to it: ways, looks and approaches that leave it are refused";
  if (row.Offer("draw_area", m.area ? "Draw another area" : "Draw area", look)) {
    BeginArea(snap, state);
  }
  if (m.area) {
    look.hint = {};
    if (row.Offer("area_clear", "Clear area", look)) {
      ui.intents.push_back(CommandAction(ClearFlyArea{}));
    }
    row.Say("Ceiling " + Fixed(m.area->ceiling_m, 0) + " m above the start");
  }
}

void DrawPlaceButtons(const EngineSnapshot& snap, float x, float y, const SearchMapState& state,
                      UiFrame& ui) {
  const auto& pose = snap.sensors->pose;
  if (!state.picked || state.draws) {
    return;
  }
  std::optional<FlyTo> there;
  if (pose) {
    const Eigen::Vector3d& p_WB = pose->X_WB.p;
    const Eigen::Vector2d way = *state.picked - p_WB.head<2>();
    there = FlyTo{{state.picked->x(), state.picked->y(), p_WB.z()}, std::atan2(way.y(), way.x())};
  }
  const float gap = ui.style.Px(3);
  x = DrawWayButton(snap,
                    {"fly_there", "Fly there", "Flies level to over the cross and hovers there",
                     there, "Where the vehicle is, is not known"},
                    x, y, ui) +
      gap;
  DrawWayButton(snap,
                {"look_there", "Look there",
                 "Flies level until the cameras look at the cross, and hovers there",
                 HoverToSee(snap, *state.picked), "The map does not know the height there"},
                x, y, ui);
}

/// Why the area, or a way, was not taken.
std::string Trouble(const EngineSnapshot& snap, const SearchMapState& state) {
  if (!state.why_not.empty() || !snap.session->events) {
    return state.why_not;
  }
  for (const char* what : {"Area", "Fly there"}) {
    if (std::string why = WhyRefusedLately(*snap.session->events, what, snap.time); !why.empty()) {
      return std::string(what) + " refused: " + why;
    }
  }
  return {};
}

void WorkMap(const Ground& ground, const Interaction& in, SearchMapState& state, UiFrame& ui) {
  if (!state.cross.allFinite() || !in.focused) {
    state.cross = ground.middle;
  }
  state.cross += kArrow_m * Eigen::Vector2d(in.step_up, in.step_right);
  state.half_m = std::clamp(state.half_m * std::pow(0.9, static_cast<double>(in.wheel)), kNearest_m,
                            kFarthest_m);
  if (in.cleared) {
    TakeBack(state);
  }
  if (in.clicked) {
    TakePlace(in.key_pressed ? state.cross : ground.Place(in.pointer), ground, state, ui);
  }
}

}  // namespace

void DrawSearchMapPanel(const EngineSnapshot& snap, const Rect& rect, SearchMapState& state,
                        UiFrame& ui) {
  const Style& s = ui.style;
  const MissionStatus& m = snap.flight->mission;
  const std::string fact =
      m.seen ? "Looked at " + Fixed(SeenArea_m2(*m.seen), 0) + " m²" : "Nothing looked at yet";
  const Rect scene = DrawPanelFrame(ui, rect, "Search map", {{rect.w < s.Px(300) ? "" : fact}});
  const Ground ground = GroundOf(snap, scene, state);
  FillRect(Canvas(), scene, picture::kUnknown);
  Canvas()->PushClipRect(scene.min(), scene.max(), true);
  if (m.seen) {
    DrawSeen(*m.seen, ground, Mix(picture::kUnknown, picture::kUnknownLine, 0.9F));
  }
  DrawLimit(m, ground, ui);
  DrawHeadings(m, ground, ui);
  DrawSites(snap, ground, ui);
  DrawVehicle(snap, ground, ui);
  const float x = scene.x + s.Px(8), top = scene.y + s.Px(8);
  Row row{ui, x, scene.right() - s.Px(8), top};
  DrawAreaButtons(snap, row, state, ui);
  DrawPlaceButtons(snap, x, row.y + s.Px(25), state, ui);
  const Interaction in = Interact(ui, "search_map", scene, kAllSteps | kClears);
  WorkMap(ground, in, state, ui);
  if (state.draws) {
    DrawDrawnArea(state, ground, in.pointer, in.hovered, ui);
  } else if (state.picked) {
    DrawCross(*state.picked, ground, ui);
  }
  if (in.focused) {
    DrawCross(state.cross, ground, ui);
  }
  Canvas()->PopClipRect();
  const std::string trouble = Trouble(snap, state);
  if (!trouble.empty()) {
    const float room = scene.w - s.Px(16);
    TextPlate(ui, {scene.x, scene.y, scene.w, scene.h - s.Px(32)}, Corner::kBottomLeft,
              FitWords(s.caption, trouble, room));
  }
  if (const std::string words = HeadingWords(snap); !words.empty() && trouble.empty()) {
    TextPlate(ui, {scene.x, scene.y, scene.w, scene.h - s.Px(32)}, Corner::kBottomLeft,
              FitClauses(s.caption, words, scene.w - s.Px(16)));
  }
  DrawNorth(scene, ui);
  DrawScaleBar(ui, scene, static_cast<float>(1 / ground.per_px));
}

}  // namespace palace
