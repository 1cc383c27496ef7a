// Hold-to-confirm: a button that fires only after being held for its full time without a break.
// Release, leaving the button, Escape, a popup, a change of subject, a block or a lost focus
// empties it.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "gui/widgets/draw.h"

namespace palace {

struct HoldState {
  bool holding = false;
  bool by_key = false;
  double started_s = 0;       ///< UI clock
  std::uint64_t subject = 0;  ///< what was on the button when the hold began
  double released_at_s = -std::numeric_limits<double>::infinity();
  double released_after_s = 0;  ///< how long the last broken hold had lasted
};

struct HoldInput {
  double now_s = 0;
  bool pointer_inside = false;
  bool mouse_pressed = false;  ///< went down in this frame
  bool mouse_down = false;
  bool has_focus = false;  ///< keyboard focus is on the button
  bool key_pressed = false;
  bool key_down = false;
  bool window_focused = true;
  bool popup = false;
  bool cancelled = false;  ///< Escape
  bool blocked = false;    ///< may not fire now, for whatever reason
  std::uint64_t subject = 0;
  double duration_s = 1.0;
};

/// Advances the hold by one frame. True exactly once, in the frame in which the hold is complete;
/// the next one needs a new press.
bool AdvanceHold(HoldState& state, const HoldInput& input);
/// Seconds held so far, 0 when not holding.
double HeldSeconds(const HoldState& state, double now_s);

enum class HoldPhase { kReady, kBlocked, kRequested, kAccepted, kRefused, kNoVehicle };
struct HoldButtonView {
  HoldPhase phase = HoldPhase::kReady;
  std::string label;   ///< "Hold to approve A"; while requested what was asked
  std::string reason;  ///< second line; when ready only where something is to be told
  std::uint64_t subject = 0;
  double duration_s = 1.0;
};

/// Draws the button and runs the hold. True in the frame in which it fires. A hold that Escape
/// cancels takes the Escape.
bool DrawHoldButton(UiFrame& ui, std::string_view name, const Rect& rect,
                    const HoldButtonView& view, HoldState& state);

}  // namespace palace
