#include "gui/panels/search_map.h"

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <utility>

#include "engine/core/units.h"
#include "engine/model/mission/refused_lately.h"
#include "gui/panels/course_rose.h"
#include "gui/panels/search_map_legend.h"
#include "gui/panels/search_map_marks.h"
#include "gui/panels/way_button.h"
#include "gui/widgets/button.h"
#include "gui/widgets/map/site_marks.h"
#include "gui/widgets/number_text.h"
#include "gui/widgets/panel_frame.h"

namespace palace {
namespace {

constexpr double kNearest_m = 15, kFarthest_m = 250;  // half sides
constexpr double kArrow_m = 2;
constexpr double kCeilingStep_m = 5, kCeilingAbove_m = 20;
constexpr float kSnap_px = 10;          // to the first corner
constexpr double kDoubleClick_s = 0.5;  // the second press of one meant the button that is gone
constexpr double kZoomStep = 0.9;
constexpr float kRoomForLegend = 360;  // units of the design grid

MapGround GroundOf(const EngineSnapshot& snap, const Rect& scene, const SearchMapState& state) {
  const auto& seen = snap.flight->mission.seen;
  const auto& pose = snap.sensors->pose;
  const Eigen::Vector2d middle = seen   ? seen->middle_W
                                 : pose ? Eigen::Vector2d(pose->X_WB.p.head<2>())
                                        : Eigen::Vector2d(0, 0);
  const double px = std::max(1.0, static_cast<double>(std::min(scene.w, scene.h)));
  return {scene, middle, 2 * state.half_m / px};
}

void DrawDrawnArea(const SearchMapState& state, const MapGround& ground, ImVec2 pointer,
                   bool hovered, UiFrame& ui) {
  const Style& s = ui.style;
  std::vector<ImVec2> points = ground.At(state.corners);
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

void DrawCross(const Eigen::Vector2d& place, const MapGround& ground, UiFrame& ui) {
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
    state.put_aside.clear();
    state.settled_s = ui.ui_time_s + kDoubleClick_s;
  }
}

void PutAside(SearchMapState& state, const UiFrame& ui) {
  state.draws = false;
  state.put_aside = std::exchange(state.corners, {});
  state.why_not.clear();
  state.settled_s = ui.ui_time_s + kDoubleClick_s;
}

void TakeBack(SearchMapState& state) {
  if (state.draws && !state.corners.empty()) {
    state.corners.pop_back();
  } else if (!state.draws) {
    state.picked.reset();
  }
  state.why_not.clear();
}

void TakePlace(const Eigen::Vector2d& place, const MapGround& ground, SearchMapState& state,
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
  } else if (!state.corners.empty() && near(state.corners.back())) {
    // A double click's second: two corners in one place would be edges that cross.
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
    Interact(ui, "search_says", plate, kNoTab, words);  // a click on it picks no place
  }
};

void BeginArea(const EngineSnapshot& snap, SearchMapState& state) {
  state.draws = true;
  state.corners.clear();
  state.put_aside.clear();
  state.picked.reset();
  state.why_not.clear();
  const std::optional<FlyArea>& before = snap.flight->mission.area;
  const auto& pose = snap.sensors->pose;
  const double height_m = pose ? HeightFromDown(pose->X_WB.p.z()) : 0;
  state.ceiling_m = before
                        ? before->ceiling_m
                        : std::ceil((height_m + kCeilingAbove_m) / kCeilingStep_m) * kCeilingStep_m;
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
      PutAside(state, ui);
    }
    row.Say("Ceiling " + Fixed(state.ceiling_m, 0) + " m");
    const std::string by = " the ceiling by " + Fixed(kCeilingStep_m, 0) + " m";
    const std::string lowers = "Lowers" + by, raises = "Raises" + by;
    ButtonLook lower, higher;
    lower.hint = lowers;
    higher.hint = raises;
    if (row.Offer("area_lower", "−", lower)) {
      state.ceiling_m -= kCeilingStep_m;
    }
    if (row.Offer("area_higher", "+", higher)) {
      state.ceiling_m += kCeilingStep_m;
    }
    return;
  }
  ButtonLook look;
  look.enabled = m.may_select && snap.session->can_transmit;
  look.reason = "No vehicle is commanded here";
  look.hint =
      "Keeps the vehicle to it, in place of any drawn before: ways, looks and approaches "
      "that leave it are refused";
  if (row.Offer("draw_area", "Draw area", look) && ui.ui_time_s >= state.settled_s) {
    BeginArea(snap, state);
  }
  look.hint = {};
  if (m.area) {
    if (row.Offer("area_clear", "Clear area", look)) {
      ui.intents.push_back(CommandAction(ClearFlyArea{}));
    }
    row.Say("Ceiling " + Fixed(m.area->ceiling_m, 0) + " m above the start");
  }
  if (!state.put_aside.empty()) {
    row.Say("Drawing cancelled");
    if (row.Offer("area_resume", "Undo", look) && ui.ui_time_s >= state.settled_s) {
      state.draws = true;
      state.corners = std::exchange(state.put_aside, {});
      state.picked.reset();
    }
  } else if (!m.area && state.last_area) {
    // Not where "Clear area" was: a double click on that does not undo it.
    row.Say("Area cleared");
    if (row.Offer("area_restore", "Undo", look)) {
      ui.intents.push_back(CommandAction(SetFlyArea{*state.last_area}));
    }
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

/// Why the area, or a way, was not taken; else that the vehicle is not in the area that stands.
std::string Trouble(const EngineSnapshot& snap, const SearchMapState& state) {
  // What was refused before a way that is flown is no trouble any more.
  if (!state.why_not.empty() || !snap.session->events || snap.flight->mission.going) {
    return state.why_not;
  }
  for (const char* what : {"Area", "Fly there"}) {
    if (std::string why = WhyRefusedLately(*snap.session->events, what, snap.time); !why.empty()) {
      return std::string(what) + " refused: " + why;
    }
  }
  const MissionStatus& m = snap.flight->mission;
  const std::string outside =
      m.area && snap.sensors->pose ? OutsideWords(*m.area, snap.sensors->pose->X_WB.p) : "";
  return outside.empty() ? "" : "The vehicle is " + outside + ". It may be sent in.";
}

void Zoom(SearchMapState& state, double steps) {
  state.half_m = std::clamp(state.half_m * std::pow(kZoomStep, steps), kNearest_m, kFarthest_m);
}

/// At the upper right: it is said nowhere else that the wheel zooms.
void DrawZoomButtons(const Rect& scene, SearchMapState& state, UiFrame& ui) {
  constexpr double kStepsAPress = 3;
  const Style& s = ui.style;
  Rect rect{scene.right() - s.Px(30), scene.y + s.Px(8), s.Px(22), s.Px(22)};
  ButtonLook look;
  look.font = s.medium;
  look.hint = "Closer; so does the wheel";
  if (DrawButton(ui, "map_closer", rect, "+", look)) {
    Zoom(state, kStepsAPress);
  }
  rect.y += s.Px(25);
  look.hint = "Wider; so does the wheel";
  if (DrawButton(ui, "map_wider", rect, "−", look)) {
    Zoom(state, -kStepsAPress);
  }
}

/// Words at the lower left, in as many lines as they need; a click there picks no place. Returns
/// the upper edge.
float DrawWords(const Rect& scene, float bottom, const std::string& words, UiFrame& ui) {
  if (words.empty()) {
    return bottom;
  }
  constexpr std::size_t kMostLines = 4;
  const Style& s = ui.style;
  const float room = scene.w - s.Px(16) - s.Px(18);
  const std::vector<std::string> lines = WrapText(s.caption, words, room, kMostLines);
  float width = 0;
  for (const std::string& line : lines) {
    width = std::max(width, TextWidth(s.caption, line));
  }
  const float height = s.Px(17) * static_cast<float>(lines.size()) + s.Px(9);
  const Rect plate{scene.x + s.Px(8), bottom - height, width + s.Px(18), height};
  FillRect(Canvas(), plate, picture::kPlate, s.Fine(3));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const float y = plate.y + s.Px(13) + s.Px(17) * static_cast<float>(i);
    DrawText(ui, s.caption, picture::kPlateText, plate.x + s.Px(9), y, lines[i]);
  }
  Interact(ui, "search_words", plate, kNoTab, words);
  return plate.y;
}

/// Scale, north, legend and words. Returns their upper edge.
float DrawFoot(const EngineSnapshot& snap, const Rect& scene, SearchMapState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const bool shown = state.legend.value_or(scene.w >= s.Px(kRoomForLegend));
  const std::string words = shown ? "Hide legend" : "Legend";
  const float width = TextWidth(s.caption, words) + s.Px(12);
  ButtonLook look;
  look.font = s.caption;
  const Rect rect{scene.right() - s.Px(36) - width, scene.bottom() - s.Px(32), width, s.Px(22)};
  if (DrawButton(ui, "search_legend_on", rect, words, look)) {
    state.legend = !shown;
  }
  float bottom = scene.bottom() - s.Px(40);
  if (shown) {
    bottom = DrawSearchLegend(snap, scene, bottom, ui) - s.Px(4);
  }
  const std::string trouble = Trouble(snap, state);
  return DrawWords(scene, bottom, trouble.empty() ? HeadingWords(snap) : trouble, ui);
}

void WorkMap(const MapGround& ground, const Interaction& in, SearchMapState& state, UiFrame& ui) {
  if (!state.cross.allFinite() || !in.focused) {
    state.cross = ground.middle;
  }
  state.cross += kArrow_m * Eigen::Vector2d(in.step_up, in.step_right);
  Zoom(state, static_cast<double>(in.wheel));
  if (in.cleared) {
    TakeBack(state);
  }
  if (in.clicked && ui.ui_time_s >= state.settled_s) {
    TakePlace(in.key_pressed ? state.cross : ground.Place(in.pointer), ground, state, ui);
  }
}

}  // namespace

void FollowArea(const MissionStatus& mission, SearchMapState& state) {
  if (mission.state == MissionState::kNoLive || mission.state == MissionState::kLanded) {
    state.last_area.reset();
    state.put_aside.clear();
  } else if (mission.area) {
    state.last_area = mission.area;
  }
}

void DrawSearchMapPanel(const EngineSnapshot& snap, const Rect& rect, SearchMapState& state,
                        UiFrame& ui) {
  const Style& s = ui.style;
  const MissionStatus& m = snap.flight->mission;
  const std::string fact =
      m.seen ? "Looked at " + Fixed(SeenArea_m2(*m.seen), 0) + " m²" : "Nothing looked at yet";
  const Rect scene = DrawPanelFrame(ui, rect, "Search map", {{rect.w < s.Px(300) ? "" : fact}});
  const MapGround ground = GroundOf(snap, scene, state);
  FillRect(Canvas(), scene, picture::kUnknown);
  Canvas()->PushClipRect(scene.min(), scene.max(), true);
  DrawSearchGround(snap, ground, ui);
  const float x = scene.x + s.Px(8);
  Row row{ui, x, scene.right() - s.Px(36), scene.y + s.Px(8)};
  DrawAreaButtons(snap, row, state, ui);
  DrawPlaceButtons(snap, x, row.y + s.Px(25), state, ui);
  DrawZoomButtons(scene, state, ui);
  const float top = row.y + s.Px(50), bottom = DrawFoot(snap, scene, state, ui);
  DrawSearchSites(snap, ground, {x, top, scene.w - s.Px(16), bottom - top}, !state.draws,
                  state.letters, ui);
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
  DrawNorth(scene, ui);
  DrawScaleBar(ui, scene, static_cast<float>(1 / ground.per_px));
}

}  // namespace palace
