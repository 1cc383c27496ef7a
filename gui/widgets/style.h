// Style: palette, fonts and scale of the station. Panels take every colour and size from here.
#pragma once

#include <cmath>
#include <cstdint>

#include <imgui.h>

namespace palace {

/// Opaque colour from 0xRRGGBB.
constexpr ImU32 Rgb(std::uint32_t rrggbb) {
  return 0xFF000000u | ((rrggbb & 0xFFu) << 16) | (rrggbb & 0xFF00u) | (rrggbb >> 16);
}
/// The same colour at `alpha` (0..1) of its opacity.
constexpr ImU32 WithAlpha(ImU32 colour, float alpha) {
  const float full = static_cast<float>(colour >> 24) * alpha;
  return (colour & 0x00FFFFFFu) | (static_cast<ImU32>(full + 0.5f) << 24);
}
/// Mix of two opaque colours; t = 0 gives `a`.
ImU32 Mix(ImU32 a, ImU32 b, float t);

/// Only data and danger have colour. Blue: inside the limits. Orange with hatch: outside. Red,
/// yellow, cyan: alarms only. Violet: replay only.
struct Palette {
  ImU32 window = 0;      ///< behind panels, input fields
  ImU32 plot_floor = 0;  ///< floor of plots
  ImU32 plot_grid = 0;
  ImU32 panel = 0;    ///< panels, bars
  ImU32 control = 0;  ///< buttons, tooltip
  ImU32 hover = 0;    ///< hover, selected row, track of a bar
  ImU32 line = 0;     ///< separators, quiet borders
  ImU32 strong_line = 0;
  ImU32 text1 = 0;       ///< values, active labels
  ImU32 text2 = 0;       ///< labels, secondary
  ImU32 text3 = 0;       ///< limits, future states, disabled text
  ImU32 white_mark = 0;  ///< selection bar, focus, limit wall, cursor, LIVE block
  ImU32 on_white = 0;    ///< text on the white mark
  ImU32 safe = 0;        ///< safe contour, vision estimate, approve border
  ImU32 bar = 0;         ///< margin bars, hold fill
  ImU32 go = 0;          ///< approve and apply fill
  ImU32 on_go = 0;       ///< text on go and bar
  ImU32 unsafe = 0;      ///< over a limit, limit lines; always with hatch or dash
  ImU32 warning = 0, warning_fill = 0;
  ImU32 caution = 0, caution_fill = 0;
  ImU32 advisory = 0, advisory_fill = 0;
  ImU32 replay = 0, on_replay = 0;
  ImU32 gps = 0, laser = 0, truth = 0;  ///< series; a colour belongs to the signal
  ImU32 wave_off = 0;                   ///< fill of the WAVE OFF block
  bool outlined_panels = false;         ///< high contrast: panels carry a 1 px line
};

Palette MakeDarkPalette();
Palette MakeLightPalette();
Palette MakeHighContrastPalette();

/// Colours that stay the same in every theme because they lie on pictures and maps.
namespace picture {
inline constexpr ImU32 kWhite = Rgb(0xFFFFFF);
inline constexpr ImU32 kBlack = Rgb(0x000000);
inline constexpr ImU32 kPlate = WithAlpha(Rgb(0x090C10), 0.8f);
inline constexpr ImU32 kPlateText = Rgb(0xE8ECF1);
inline constexpr ImU32 kUnknown = Rgb(0x1B222B);
inline constexpr ImU32 kUnknownLine = Rgb(0x3A4552);
inline constexpr ImU32 kUnsafeTint = WithAlpha(Rgb(0xF5963C), 0.10f);
inline constexpr ImU32 kUnsafeLine = WithAlpha(Rgb(0xF5963C), 0.60f);
inline constexpr ImU32 kNoPlaceLine = WithAlpha(Rgb(0xF5963C), 0.40f);
inline constexpr ImU32 kSafe = Rgb(0x5CB2FF);
inline constexpr ImU32 kLetterDark = Rgb(0x090C10);
}  // namespace picture

/// Fonts are owned by ImGui's atlas; the app fills them from gui/platform/fonts.h.
struct Style {
  float scale = 1;
  Palette palette;
  ImFont* caption = nullptr;  ///< 13 px: caption, axis, status bar, limits
  ImFont* body = nullptr;     ///< 14 px
  ImFont* medium = nullptr;   ///< 14 px Medium: values, titles
  ImFont* section = nullptr;  ///< 16 px Medium
  ImFont* button = nullptr;   ///< 18 px Bold
  ImFont* readout = nullptr;  ///< 20 px Medium
  ImFont* mode = nullptr;     ///< 20 px Bold
  ImFont* mode_replay = nullptr;
  ImFont* wave_off = nullptr;     ///< 24 px Bold
  ImFont* replay_time = nullptr;  ///< 26 px Medium
  ImFont* mono = nullptr;         ///< 13 px JetBrains Mono

  /// Units of the design grid to whole pixels.
  float Px(float units) const { return std::round(units * scale); }
  /// Line widths and radii: scaled, not rounded.
  float Fine(float units) const { return units * scale; }
};

}  // namespace palace
