// Ways to look at other ground while nothing is selected: a turn, a climb, or a look at the pin.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "engine/core/units.h"
#include "gui/panels/fly_panels.h"
#include "gui/panels/session_words.h"
#include "gui/widgets/button.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

constexpr double kTurn_rad = Rad(45);
constexpr double kClimb_m = 5;

/// The hover from which the cameras, tilted as the glide slope, look at the place: ahead of it on
/// the way there, never behind where the vehicle is. Empty where its height is not known.
std::optional<FlyTo> HoverBefore(const EngineSnapshot& snap, const Eigen::Vector2d& place) {
  const auto& decision = snap.terrain->applied;
  if (!decision || !decision->elevation || !snap.sensors->pose) {
    return std::nullopt;
  }
  const GridGeometry& g = decision->elevation->geometry;
  const auto cell = g.rows > 0 ? g.CellFromPoint(place.x(), place.y()) : std::optional<Cell>();
  const double ground_m =
      cell ? static_cast<double>(decision->elevation->Measured().at(*cell)) : NAN;
  if (!std::isfinite(ground_m)) {
    return std::nullopt;
  }
  const Eigen::Vector3d p_WB = snap.sensors->pose->X_WB.p;
  const double slope_rad =
      std::clamp(Rad(snap.session->settings.mission.glide_slope_deg), Rad(10), Rad(80));
  const double before_m = (HeightFromDown(p_WB.z()) - ground_m) / std::tan(slope_rad);
  const Eigen::Vector2d way = place - p_WB.head<2>();
  const double go_m = std::max(0.0, way.norm() - std::max(0.0, before_m));
  const Eigen::Vector2d along = way.norm() > 0 ? Eigen::Vector2d(way.normalized()) : way;
  const Eigen::Vector2d at = p_WB.head<2>() + go_m * along;
  return FlyTo{{at.x(), at.y(), p_WB.z()}, std::atan2(way.y(), way.x())};
}

/// Buttons side by side, each as wide as its words.
struct Row {
  const EngineSnapshot& snap;
  UiFrame& ui;
  Rect next;

  void Offer(const char* name, const std::string& words, const char* hint,
             const std::optional<FlyTo>& there, const char* why_none) {
    const Style& s = ui.style;
    next.w = TextWidth(s.caption, words) + s.Px(12);
    const std::string& why_not = snap.flight->mission.why_not_go;
    const std::string reason = !snap.session->can_transmit ? WhyNoLink(snap)
                               : !why_not.empty()          ? why_not
                                                           : why_none;
    ButtonLook look;
    look.font = s.caption;
    look.flat = true;
    look.enabled = there && why_not.empty() && snap.session->can_transmit;
    look.reason = reason;
    look.hint = hint;
    if (DrawButton(ui, name, next, words, look)) {
      ui.intents.push_back(CommandAction(*there));
    }
    next.x = next.right() + s.Px(3);
  }
};

}  // namespace

void DrawWaysElsewhere(const EngineSnapshot& snap, const Rect& panel, float left,
                       const std::optional<Eigen::Vector2d>& pin, UiFrame& ui) {
  const Style& s = ui.style;
  const MissionStatus& m = snap.flight->mission;
  Row row{snap, ui, {left, panel.y + s.Px(3), 0, s.Px(22)}};
  if (m.going) {
    const std::string words = "Hold here";
    const std::string reason = WhyNoLink(snap);
    const float width = TextWidth(s.caption, words) + s.Px(20);
    ButtonLook look;
    look.font = s.caption;
    look.enabled = snap.session->can_transmit;
    look.reason = reason;
    // At the other end of the head: a press too many on a way is no hold, nor the reverse a way.
    const Rect at{panel.right() - s.Px(8) - width, row.next.y, width, row.next.h};
    if (DrawButton(ui, "hold_here", at, words, look)) {
      ui.intents.push_back(CommandAction(HoldHere{}));
    }
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
  const char* no_pose = "Where the vehicle is, is not known";
  const std::string turn = Fixed(Deg(kTurn_rad), 0) + "°";
  row.Offer("turn_left", "Left " + turn, "Turns where it hovers, to look at other ground",
            at(0, -kTurn_rad), no_pose);
  row.Offer("turn_right", "Right " + turn, "Turns where it hovers, to look at other ground",
            at(0, kTurn_rad), no_pose);
  row.Offer("climb", "Up " + Fixed(kClimb_m, 0) + " m", "Climbs straight up and hovers there",
            at(kClimb_m, 0), no_pose);
  row.Offer("look_at_pin", "Look at pin",
            "Turns to the place that is pinned on a map, flies level until the cameras look at it, "
            "and hovers there",
            pin ? HoverBefore(snap, *pin) : std::nullopt,
            m.state == MissionState::kHold ? "Not from a hold: turn or climb first"
            : pin ? "The map does not know the height of the pinned place now"
                  : "Click a place on a map first");
}

}  // namespace palace
