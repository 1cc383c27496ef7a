#include <array>

#include "gui/panels/frame_bar.h"
#include "gui/panels/session_words.h"
#include "gui/panels/simulate/simulate.h"
#include "gui/widgets/icons.h"
#include "gui/widgets/interact.h"

namespace palace {

namespace {

/// Over the mode block, blinking: time stands still, whatever else the screen shows.
void DrawPaused(const EngineSnapshot& snap, const Rect& r, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const Rect below{r.x, r.bottom() - s.Px(16), r.w, s.Px(16)};
  FillRect(Canvas(), below, p.white_mark);
  DrawIcon(Canvas(), Icon::kPause, {below.x + s.Px(8), below.centre().y}, s.Px(12), p.on_white);
  DrawText(ui, s.caption, p.on_white, below.x + s.Px(16), below.centre().y, "PAUSED · Space");
  ui.items.Add("paused", below, true, "PAUSED " + snap.session->source.name);
}

void DrawModeBlock(const EngineSnapshot& snap, const Rect& r, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  ImDrawList* dl = Canvas();
  const float icon_x = r.x + s.Px(18);
  const float word_x = r.x + s.Px(40);
  const float y = r.centre().y - (snap.session->source.paused ? s.Px(8) : 0.0f);
  const char* word = "LIVE";
  if (snap.session->source.kind == SourceKind::kReplay) {
    word = "REPLAY";
    FillRect(dl, r, p.replay);
    DrawIcon(dl, Icon::kReplay, {icon_x + s.Px(2), y}, s.Px(20), p.on_replay);
    DrawText(ui, s.mode_replay, p.on_replay, r.x + s.Px(36), y, word);
  } else if (snap.session->source.kind == SourceKind::kSimulation) {
    word = "SIM";
    Stripes(dl, r, p.white_mark, p.on_white, s.Px(6));
    const float edge = s.Px(4);
    FillRect(dl, {r.x + edge, r.y + edge, r.w - 2 * edge, r.h - 2 * edge}, p.panel);
    DrawIcon(dl, Icon::kSimulation, {icon_x + s.Px(6), y}, s.Px(20), p.text1);
    DrawText(ui, s.mode, p.text1, r.x + s.Px(46), y, word);
  } else if (snap.session->source.kind == SourceKind::kLive && IsHeard(snap)) {
    FillRect(dl, r, p.white_mark);
    dl->AddCircleFilled({icon_x, y}, s.Fine(6), p.on_white);
    DrawText(ui, s.mode, p.on_white, word_x, y, word);
  } else {
    word = snap.session->source.kind == SourceKind::kImages    ? "IMAGES"
           : snap.session->source.kind == SourceKind::kCameras ? "CAMERAS"
           : snap.session->source.kind == SourceKind::kVideo   ? "VIDEO"
                                                               : "NO LINK";
    StrokeRect(dl, r, p.strong_line, s.Fine(2));
    DrawText(ui, s.mode_replay, p.text1, r.centre().x, y, word, Align::kCentre);
  }
  ui.items.Add("mode", r, true, word);
  if (snap.session->source.paused) {
    DrawPaused(snap, r, ui);
  }
}

/// Tabs with the underline of the active one. Returns the right edge.
float DrawTabs(float x, const Rect& bar, Workspace active, bool simulation, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  constexpr std::array<const char*, 5> kNames = {"Fly", "Tune", "Review", "Diagnose", "Simulate"};
  const std::size_t count = simulation ? kNames.size() : kNames.size() - 1;
  for (std::size_t i = 0; i < count; ++i) {
    const bool on = static_cast<std::size_t>(active) == i;
    ImFont* font = on ? s.medium : s.body;
    const float width = TextWidth(font, kNames[i]);
    const Rect area{x - s.Px(14), bar.y, width + s.Px(28), bar.h};
    const Interaction in = Interact(ui, std::string("tab/") + kNames[i], area, 0, kNames[i]);
    if (in.hovered && !on) {
      FillRect(Canvas(), area, p.control);
    }
    DrawText(ui, font, on || in.hovered ? p.text1 : p.text2, x, bar.centre().y, kNames[i]);
    if (on) {
      FillRect(Canvas(), {x - s.Px(8), bar.bottom() - s.Px(4), width + s.Px(16), s.Px(4)},
               p.white_mark);
    }
    if (in.clicked) {
      ui.intents.push_back(UiAction(ShowWorkspace{static_cast<Workspace>(i)}));
    }
    x += width + s.Px(38);
  }
  return x - s.Px(38);
}

constexpr std::array<MissionState, 6> kChain = {MissionState::kSearch,     MissionState::kProposed,
                                                MissionState::kArmed,      MissionState::kApproved,
                                                MissionState::kDescending, MissionState::kLanded};

int ChainIndex(MissionState state) {
  for (std::size_t i = 0; i < kChain.size(); ++i) {
    if (kChain[i] == state) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

void DrawStateBox(const Rect& r, std::string_view word, UiFrame& ui) {
  const Style& s = ui.style;
  StrokeRect(Canvas(), r, s.palette.white_mark, s.Fine(1), s.Fine(4));
  DrawText(ui, s.medium, s.palette.text1, r.centre().x, r.centre().y, word, Align::kCentre);
}

/// States beside the chain: one box with shape and word. Like the next two: the right edge.
float DrawSideState(MissionState state, float x, float y, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  Icon icon = Icon::kOff;
  ImU32 colour = p.text2;
  if (state == MissionState::kHold) {
    icon = Icon::kCaution;
    colour = p.caution;
  } else if (state == MissionState::kAborting) {
    icon = Icon::kWarning;
    colour = p.warning;
  }
  const char* word = MissionStateWord(state);
  const Rect r{x, y - s.Px(14), TextWidth(s.medium, word) + s.Px(44), s.Px(28)};
  StrokeRect(Canvas(), r, colour, s.Fine(1), s.Fine(4));
  DrawIcon(Canvas(), icon, {r.x + s.Px(18), y}, s.Px(12), colour);
  DrawText(ui, s.medium, p.text1, r.x + s.Px(32), y, word);
  return r.right();
}

float DrawChain(int now, float x, float y, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  for (int i = 0; i < static_cast<int>(kChain.size()); ++i) {
    const char* word = MissionStateWord(kChain[static_cast<std::size_t>(i)]);
    if (i > 0) {
      FillRect(Canvas(), {x + s.Px(12), std::round(y), s.Px(16), s.Px(1)}, p.strong_line);
      x += s.Px(40);
    }
    if (i < now) {
      DrawIcon(Canvas(), Icon::kDone, {x + s.Px(5), y}, s.Px(12), p.text2);
      x += s.Px(18) + DrawText(ui, s.body, p.text2, x + s.Px(18), y, word);
    } else if (i == now) {
      const float width = TextWidth(s.medium, word) + s.Px(26);
      DrawStateBox({x, y - s.Px(14), width, s.Px(28)}, word, ui);
      x += width;
    } else {
      x += DrawText(ui, s.body, p.text3, x, y, word);
    }
  }
  return x;
}

float DrawState(MissionState state, bool narrow, bool wide, float x, float y, UiFrame& ui) {
  const Style& s = ui.style;
  const int now = ChainIndex(state);
  if (!narrow) {
    x += s.Px(wide ? 100 : 48);
    return now < 0 ? DrawSideState(state, x, y, ui) : DrawChain(now, x, y, ui);
  }
  x += s.Px(41);
  x += DrawText(ui, s.body, s.palette.text2, x, y, "State") + s.Px(12);
  if (now < 0) {
    return DrawSideState(state, x, y, ui);
  }
  DrawStateBox({x, y - s.Px(14), s.Px(124), s.Px(28)}, MissionStateWord(state), ui);
  x += s.Px(136);
  return x + DrawText(ui, s.body, s.palette.text2, x, y, std::to_string(now + 1) + " of 6");
}

/// "Keys F1" at the right end, where there is room: nothing else tells of the list.
void DrawKeysHint(const Rect& bar, float free_from, UiFrame& ui) {
  const Style& s = ui.style;
  const float width = TextWidth(s.caption, "Keys") + TextWidth(s.medium, "F1") + s.Px(8);
  const Rect area{bar.right() - width - s.Px(24), bar.y, width + s.Px(24), bar.h};
  if (area.x < free_from + s.Px(12)) {
    return;
  }
  const Interaction in = Interact(ui, "keys", area, 0, "Keys F1");
  const float y = bar.centre().y;
  float x = area.x + s.Px(12);
  x += DrawText(ui, s.caption, s.palette.text2, x, y, "Keys") + s.Px(8);
  DrawText(ui, s.medium, in.hovered ? s.palette.text1 : s.palette.text2, x, y, "F1");
  if (in.clicked) {
    ui.intents.push_back(UiAction(ShowKeyHelp{true}));
  }
}

}  // namespace

void DrawTopBarPanel(const EngineSnapshot& snap, const FrameLayout& layout, FrameState& state,
                     UiFrame& ui) {
  const Style& s = ui.style;
  const Rect& bar = layout.top_bar;
  FillRect(Canvas(), {bar.x, bar.y, layout.window.w, bar.h}, s.palette.panel);
  ui.items.Add("panel/Top bar", bar, true, "");
  DrawModeBlock(snap, layout.mode_block, ui);
  const bool narrow = layout.narrow;
  float x = layout.mode_block.right() + s.Px(20);
  const float y = bar.centre().y;
  if (!narrow) {
    for (const char letter : std::string_view("PALACE")) {
      Canvas()->AddText(s.section, s.section->FontSize, {x, y - s.section->FontSize / 2},
                        s.palette.text1, &letter, &letter + 1);
      x += TextWidth(s.section, std::string_view(&letter, 1)) + s.Px(3);
    }
    x = layout.mode_block.right() + s.Px(156);
  } else {
    x += s.Px(20);
  }
  const float tabs_end = DrawTabs(x, bar, state.workspace, IsSimulation(snap), ui);
  ui.items.Add("state", bar, true, MissionStateName(snap.flight->mission.state));
  const float end =
      DrawState(snap.flight->mission.state, narrow, layout.window.w > s.Px(1800), tabs_end, y, ui);
  DrawKeysHint(bar, end, ui);
}

}  // namespace palace
