// Slider row: one setting with its changed bar, name, track, default tick, soft limits, value field
// and reset. A drag stops at the limit; a typed value out of range is refused with the reason.
// Keyboard: Left and Right step it (with Shift ten times as far), Enter types a value, Backspace
// resets it.
//
// The track has three parts so that the usual range is wide and the hard limits are still in reach:
// [min, soft min] 12 %, [soft min, soft max] the rest, [soft max, max] 20 %, each linear.
#pragma once

#include <functional>
#include <string>

#include "engine/model/settings/settings.h"
#include "gui/widgets/draw.h"

namespace palace {

/// Of all rows of one panel: at most one is dragged and one is typed in.
struct SliderState {
  float grab_offset_px = 0;  ///< of the drag under way
  double last_value = 0;     ///< that it asked for

  std::string typing;
  char text[32] = {};
  bool focus_wanted = false;

  std::string refused;  ///< setting whose typed value was refused
  std::string refusal;  ///< "60.0° is over the limit, max 45.0°"
  double refused_until_s = 0;
};

struct SliderRow {
  const SettingInfo* info = nullptr;
  double value = 0;      ///< shown and edited
  bool pending = false;  ///< not in force yet: the field's border is the strong line
  std::string note{};    ///< small, below the name: "now 45°"
  /// What takes a new value; empty: a SetSetting asks for it.
  std::function<void(double)> ask{};
};

/// Share of the track for a value, and back. Both are clamped to the hard limits.
float TrackShare(const SettingInfo& info, double value);
double TrackValue(const SettingInfo& info, float share);

/// A typed text as a value of the setting (shown units; a unit after the number is allowed). False
/// with the reason in `refusal`: not a number, out of range, not whole, odd, a multiple.
bool ParseTyped(const SettingInfo& info, const Settings& settings, const std::string& text,
                double& value, std::string& refusal);

/// Draws the row (item "limit/<name>": the grab, "field/<name>", "reset/<name>") and appends
/// SetSetting at every change. `settings` are the values being edited.
void DrawSliderRow(UiFrame& ui, const Rect& rect, const SliderRow& row, const Settings& settings,
                   SliderState& state);
/// Whether a value field answers to the keyboard itself, or the slider beside it does.
enum class FieldKeys { kOfSlider, kOwn };
/// The value field; alone (kOwn) in the Review column.
void DrawValueField(UiFrame& ui, const Rect& field, const SliderRow& row, const Settings& settings,
                    SliderState& state, FieldKeys keys);

}  // namespace palace
