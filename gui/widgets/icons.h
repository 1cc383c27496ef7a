// Icons drawn with draw-list calls: crisp at every scale, in the palette's colours, no icon font.
#pragma once

#include <imgui.h>

namespace palace {

enum class Icon {
  // Status shapes, on a 12-unit box (14 in the alarm strip).
  kWarning,      ///< filled triangle
  kCaution,      ///< filled diamond
  kAdvisory,     ///< ring
  kNormal,       ///< filled dot
  kOff,          ///< dash
  kProvisional,  ///< ring half filled
  kStale,        ///< clock
  kDone,         ///< tick
  kFails,        ///< cross
  // Actions, on a 20-unit box.
  kPlay,
  kPause,
  kStepForward,
  kStepBack,
  kFrameForward,
  kFrameBack,
  kFlag,
  kSearch,
  kReset,
  kChevronDown,
  kChevronRight,
  kChevronLeft,
  kLoop,
  kScreen,
  kArrowRight,
  kReplay,
  kSimulation,
};

/// Draws the icon in a square box of `size` pixels around `centre`.
void DrawIcon(ImDrawList* dl, Icon icon, ImVec2 centre, float size, ImU32 colour);

}  // namespace palace
