// Fonts: every face and size the station writes in (look.md section 4).
#pragma once

struct ImFont;
struct ImFontAtlas;

namespace palace {

struct Fonts {
  ImFont* caption = nullptr;      ///< 13 em regular: caption, axis, status bar, limits
  ImFont* body = nullptr;         ///< 14 regular
  ImFont* medium = nullptr;       ///< 14 medium: values in rows, titles, selected
  ImFont* section = nullptr;      ///< 16 medium
  ImFont* button = nullptr;       ///< 18 bold
  ImFont* readout = nullptr;      ///< 20 medium
  ImFont* mode = nullptr;         ///< 20 bold
  ImFont* mode_replay = nullptr;  ///< 17 bold
  ImFont* wave_off = nullptr;     ///< 24 bold
  ImFont* replay_time = nullptr;  ///< 26 medium
  ImFont* mono = nullptr;         ///< 13 JetBrains Mono: clock, hash, offsets
  bool fallback = false;          ///< a face was missing; ImGui's own font stands in
};

/// Clears the atlas and fills it for the scale; the caller uploads the texture. A missing file is
/// logged as one warning naming the Debian package, and ImGui's built-in font takes its place.
Fonts LoadFonts(ImFontAtlas& atlas, double scale);

}  // namespace palace
