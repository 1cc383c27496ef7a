#include "gui/widgets/style.h"

namespace palace {

ImU32 Mix(ImU32 a, ImU32 b, float t) {
  ImU32 mixed = 0;
  for (int shift = 0; shift < 32; shift += 8) {
    const float from = static_cast<float>((a >> shift) & 0xFFu);
    const float to = static_cast<float>((b >> shift) & 0xFFu);
    mixed |= static_cast<ImU32>(from + (to - from) * t + 0.5f) << shift;
  }
  return mixed;
}

Palette MakeDarkPalette() {
  Palette p;
  p.window = Rgb(0x090C10);
  p.plot_floor = Rgb(0x0C1015);
  p.plot_grid = Rgb(0x222A34);
  p.panel = Rgb(0x11161C);
  p.control = Rgb(0x1A212A);
  p.hover = Rgb(0x252E39);
  p.line = Rgb(0x2B3541);
  p.strong_line = Rgb(0x5C6A7B);
  p.text1 = Rgb(0xE8ECF1);
  p.text2 = Rgb(0xAEB8C4);
  p.text3 = Rgb(0x909DAC);
  p.white_mark = Rgb(0xF2F5F8);
  p.on_white = Rgb(0x090C10);
  p.safe = Rgb(0x5CB2FF);
  p.bar = Rgb(0x2B6FB5);
  p.go = Rgb(0x1D4E82);
  p.on_go = Rgb(0xFFFFFF);
  p.unsafe = Rgb(0xF0963C);
  p.warning = Rgb(0xFF6262);
  p.warning_fill = Rgb(0x3A1113);
  p.caution = Rgb(0xFCE83A);
  p.caution_fill = Rgb(0x2B2808);
  p.advisory = Rgb(0x2DCCFF);
  p.advisory_fill = Rgb(0x0B2530);
  p.replay = Rgb(0xB79CFF);
  p.on_replay = Rgb(0x120B24);
  p.gps = Rgb(0xE08FC0);
  p.laser = Rgb(0x54C7B5);
  p.truth = Rgb(0x8E99A8);
  p.wave_off = Rgb(0x2A323C);
  return p;
}

Palette MakeLightPalette() {
  Palette p;
  p.window = Rgb(0xE3E7EC);
  p.plot_floor = Rgb(0xFFFFFF);
  p.plot_grid = Rgb(0xDAE0E7);
  p.panel = Rgb(0xF7F8FA);
  p.control = Rgb(0xE9EDF1);
  p.hover = Rgb(0xDAE0E7);
  p.line = Rgb(0xCBD3DC);
  p.strong_line = Rgb(0x7F8B99);
  p.text1 = Rgb(0x11161C);
  p.text2 = Rgb(0x3F4A57);
  p.text3 = Rgb(0x586473);
  p.white_mark = Rgb(0x11161C);
  p.on_white = Rgb(0xFFFFFF);
  p.safe = Rgb(0x0B5CAD);
  p.bar = Rgb(0x2B6FB5);
  p.go = Rgb(0x0B5CAD);
  p.on_go = Rgb(0xFFFFFF);
  p.unsafe = Rgb(0x9C4600);
  p.warning = Rgb(0xB3141C);
  p.warning_fill = Rgb(0xFBE3E3);
  p.caution = Rgb(0x7A5B00);
  p.caution_fill = Rgb(0xFBF3CF);
  p.advisory = Rgb(0x00617F);
  p.advisory_fill = Rgb(0xDDF2F9);
  p.replay = Rgb(0x5B3FB8);
  p.on_replay = Rgb(0xFFFFFF);
  p.gps = Rgb(0xA03A78);
  p.laser = Rgb(0x0C6B5E);
  p.truth = Rgb(0x566170);
  p.wave_off = Rgb(0xDAE0E7);
  return p;
}

Palette MakeHighContrastPalette() {
  Palette p;
  p.window = Rgb(0x000000);
  p.plot_floor = Rgb(0x000000);
  p.plot_grid = Rgb(0x26303B);
  p.panel = Rgb(0x000000);
  p.control = Rgb(0x0E1318);
  p.hover = Rgb(0x26303B);
  p.line = Rgb(0x8B98A7);
  p.strong_line = Rgb(0xFFFFFF);
  p.text1 = Rgb(0xFFFFFF);
  p.text2 = Rgb(0xE3E8EE);
  p.text3 = Rgb(0xC3CCD6);
  p.white_mark = Rgb(0xFFFFFF);
  p.on_white = Rgb(0x000000);
  p.safe = Rgb(0x7CC4FF);
  p.bar = Rgb(0x4C9BE8);
  p.go = Rgb(0x0A3E73);
  p.on_go = Rgb(0xFFFFFF);
  p.unsafe = Rgb(0xFFAA4D);
  p.warning = Rgb(0xFF7A7A);
  p.warning_fill = Rgb(0x3A1113);
  p.caution = Rgb(0xFFF04D);
  p.caution_fill = Rgb(0x2B2808);
  p.advisory = Rgb(0x66DBFF);
  p.advisory_fill = Rgb(0x0B2530);
  p.replay = Rgb(0xCDBBFF);
  p.on_replay = Rgb(0x120B24);
  p.gps = Rgb(0xFFB3DC);
  p.laser = Rgb(0x7FE6D5);
  p.truth = Rgb(0xC3CCD6);
  p.wave_off = Rgb(0x2A323C);
  p.outlined_panels = true;
  return p;
}

}  // namespace palace
