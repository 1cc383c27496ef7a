// A button that sends the hovering vehicle to another hover, where the engine takes that.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <Eigen/Dense>

#include "engine/model/command.h"
#include "engine/model/snapshot.h"
#include "gui/widgets/ui_frame.h"

namespace palace {

struct WayButton {
  std::string_view name;
  std::string words;
  std::string hint;  ///< what it does; a tooltip
  std::optional<FlyTo> there;
  std::string why_none;  ///< the tooltip where `there` is empty
};

float WayButtonWidth(std::string_view words, const Style& style);
/// As wide as its words, from x on; right end of it. Where the engine would refuse the way it is
/// greyed, and its tooltip is what the engine would answer.
float DrawWayButton(const EngineSnapshot& snap, const WayButton& button, float x, float y,
                    UiFrame& ui);

/// From where the cameras look at the place (north, east); empty where the map does not know its
/// height.
std::optional<FlyTo> HoverToSee(const EngineSnapshot& snap, const Eigen::Vector2d& place);

}  // namespace palace
