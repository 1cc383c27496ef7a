#include "gui/panels/way_button.h"

#include <cmath>

#include "engine/core/units.h"
#include "engine/model/mission/hover_before.h"
#include "gui/panels/session_words.h"
#include "gui/widgets/button.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

/// By the engine's words; empty: it is taken.
std::string WhyNoWay(const EngineSnapshot& snap, const WayButton& button, const UiFrame& ui) {
  const std::string& now = snap.flight->mission.why_not_go;
  if (!snap.session->can_transmit || !now.empty()) {
    return snap.session->can_transmit ? now : WhyNoLink(snap);
  }
  if (!button.there) {
    return button.why_none;
  }
  return ui.why_not_flown != nullptr ? ui.why_not_flown(snap, *button.there) : std::string();
}

/// What the way would be flown over without having been seen, before it is pressed.
std::string UnseenWords(const EngineSnapshot& snap, const WayButton& button, const UiFrame& ui) {
  const double unseen_m = ui.unseen_on_way != nullptr ? ui.unseen_on_way(snap, *button.there) : 0;
  const std::string shown = Fixed(unseen_m, 1);
  return shown == "0.0" ? "" : ". Flies over " + shown + " m of ground that no map showed";
}

}  // namespace

float WayButtonWidth(std::string_view words, const Style& style) {
  return TextWidth(style.caption, words) + style.Px(12);
}

float DrawWayButton(const EngineSnapshot& snap, const WayButton& button, float x, float y,
                    UiFrame& ui) {
  const Style& s = ui.style;
  const Rect rect{x, y, WayButtonWidth(button.words, s), s.Px(22)};
  const std::string reason = WhyNoWay(snap, button, ui);
  ButtonLook look;
  look.font = s.caption;
  look.flat = true;
  look.enabled = reason.empty();
  look.reason = reason;
  const std::string hint =
      button.hint + (reason.empty() ? UnseenWords(snap, button, ui) : std::string());
  look.hint = hint;
  if (DrawButton(ui, button.name, rect, button.words, look)) {
    ui.intents.push_back(CommandAction(*button.there));
  }
  return rect.right();
}

std::optional<FlyTo> HoverToSee(const EngineSnapshot& snap, const Eigen::Vector2d& place) {
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
  return HoverBefore(snap.sensors->pose->X_WB.p, {place.x(), place.y(), -ground_m},
                     Rad(snap.session->settings.mission.glide_slope_deg));
}

}  // namespace palace
