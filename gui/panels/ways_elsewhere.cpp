// Ways to look at other ground while nothing is selected: the look that the station proposes, a
// turn, a climb, or a look at the pin.
#include <algorithm>
#include <optional>
#include <string>

#include "engine/core/units.h"
#include "gui/panels/approve_words.h"
#include "gui/panels/fly_panels.h"
#include "gui/panels/session_words.h"
#include "gui/panels/way_button.h"
#include "gui/widgets/button.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

constexpr double kTurn_rad = Rad(45);
constexpr double kClimb_m = 5;

/// At the other end of the head than the ways: a press too many on one of them is no hold, nor the
/// reverse a way.
void DrawHoldHere(const EngineSnapshot& snap, const Rect& panel, UiFrame& ui) {
  const Style& s = ui.style;
  const std::string words = "Hold here", reason = WhyNoLink(snap);
  const float width = TextWidth(s.caption, words) + s.Px(20);
  ButtonLook look;
  look.font = s.caption;
  look.enabled = snap.session->can_transmit;
  look.reason = reason;
  const Rect at{panel.right() - s.Px(8) - width, panel.y + s.Px(3), width, s.Px(22)};
  if (DrawButton(ui, "hold_here", at, words, look)) {
    ui.intents.push_back(CommandAction(HoldHere{}));
  }
}

/// Of the panels in whose head the ways stand.
float WidestTitle(const Style& s) {
  float widest = 0;
  for (const char* title : {"Approve", "Landing", "Look"}) {
    widest = std::max(widest, TextWidth(s.medium, title));
  }
  return widest;
}

}  // namespace

float DrawProposedLook(const EngineSnapshot& snap, float x, float y, bool ends_at_x, UiFrame& ui) {
  const MissionStatus& m = snap.flight->mission;
  const auto& look = m.next_look;
  const std::string words = look ? LookLabel(*look) : "Next look";
  return DrawWayButton(snap,
                       {"next_look", words, look ? "Proposed: " + look->why : std::string(),
                        look ? std::optional(FlyTo{look->p_WB, look->heading_rad}) : std::nullopt,
                        m.why_no_look.empty() ? "No look is proposed yet" : m.why_no_look},
                       ends_at_x ? x - WayButtonWidth(words, ui.style) : x, y, ui);
}

void DrawWaysElsewhere(const EngineSnapshot& snap, const Rect& panel,
                       const std::optional<Eigen::Vector2d>& pin, UiFrame& ui) {
  if (snap.flight->mission.going) {
    DrawHoldHere(snap, panel, ui);
    return;
  }
  const std::optional<VehiclePose>& pose = snap.sensors->pose;
  const auto at = [&](double up_m, double turn_rad) -> std::optional<FlyTo> {
    if (!pose) {
      return std::nullopt;
    }
    const double yaw_rad = EulerFromRotation(pose->X_WB.R).yaw_rad;
    return FlyTo{pose->X_WB.p - up_m * Eigen::Vector3d::UnitZ(), WrapAngle(yaw_rad + turn_rad)};
  };
  const std::string no_pose = "Where the vehicle is, is not known";
  const std::string turn = Fixed(Deg(kTurn_rad), 0) + "°";
  const std::string turns = "Turns where it hovers, to look at other ground";
  const float gap = ui.style.Px(3), y = panel.y + gap;
  float x = panel.x + ui.style.Px(22) + WidestTitle(ui.style);
  for (const WayButton& button :
       {WayButton{"turn_left", "Left " + turn, turns, at(0, -kTurn_rad), no_pose},
        WayButton{"turn_right", "Right " + turn, turns, at(0, kTurn_rad), no_pose},
        WayButton{"climb", "Up " + Fixed(kClimb_m, 0) + " m", "Climbs straight up and hovers there",
                  at(kClimb_m, 0), no_pose}}) {
    x = DrawWayButton(snap, button, x, y, ui) + gap;
  }
  if (pin) {
    DrawWayButton(
        snap,
        {"look_at_pin", "Look at pin",
         "Turns to the place that is pinned on a map, flies level until the cameras look "
         "at it, and hovers there",
         HoverToSee(snap, *pin), "The map does not know the height of the pinned place now"},
        x, y, ui);
  }
}

}  // namespace palace
