// TakeFonts: the faces that the platform loaded, as the panels write with them.
#pragma once

#include "gui/platform/fonts.h"
#include "gui/widgets/style.h"

namespace palace {

inline void TakeFonts(const Fonts& fonts, Style& style) {
  style.caption = fonts.caption;
  style.body = fonts.body;
  style.medium = fonts.medium;
  style.section = fonts.section;
  style.button = fonts.button;
  style.readout = fonts.readout;
  style.mode = fonts.mode;
  style.mode_replay = fonts.mode_replay;
  style.wave_off = fonts.wave_off;
  style.replay_time = fonts.replay_time;
  style.mono = fonts.mono;
}

}  // namespace palace
