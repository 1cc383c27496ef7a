#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gui/panels/arrival.h"
#include "gui/panels/fly_panels.h"
#include "gui/panels/tracker_words.h"
#include "gui/widgets/button.h"
#include "gui/widgets/draw.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

constexpr float kRow = 16;            // units; the line box of a caption
constexpr float kHeadRow = 17;        // what the columns are
constexpr float kLeastPictures = 96;  // with their captions
constexpr float kWhoWidth = 82;       // with the dot of the one in force
constexpr float kCoherence = 62, kWeight = 50, kOff = 52;

/// Right edges of the numbers, left edge of the state.
struct Columns {
  float who, coherence, weight, off, state;
  bool has_weight;
};

Columns ColumnsOf(const Rect& area, const Style& s) {
  Columns c{};
  c.who = area.x + s.Px(12);
  c.has_weight = area.w >= s.Px(400);
  c.coherence = c.who + s.Px(kWhoWidth + kCoherence);
  c.weight = c.coherence + (c.has_weight ? s.Px(kWeight) : 0);
  c.off = c.weight + s.Px(kOff);
  c.state = c.off + s.Px(12);
  return c;
}

void DrawHeadRow(const Columns& c, float y, UiFrame& ui) {
  const Style& s = ui.style;
  const ImU32 ink = s.palette.text3;
  DrawText(ui, s.caption, ink, c.who + s.Px(14), y, "Tracker");
  DrawText(ui, s.caption, ink, c.coherence, y, "Coherence", Align::kRight);
  if (c.has_weight) {
    DrawText(ui, s.caption, ink, c.weight, y, "Weight", Align::kRight);
  }
  DrawText(ui, s.caption, ink, c.off, y, "Off", Align::kRight);
  DrawText(ui, s.caption, ink, c.state, y, "State");
}

/// Words that are cut are whole under the pointer.
void DrawCut(const std::string& name, const std::string& words, const Rect& row, float x,
             ImFont* font, ImU32 ink, UiFrame& ui) {
  const Style& s = ui.style;
  const std::string shown = FitClauses(font, words, row.right() - s.Px(12) - x);
  DrawText(ui, font, ink, x, row.centre().y, shown);
  ui.items.Add(name, row, true, words);
  if (Interact(ui, name, row, kPassive).hovered && shown != words) {
    DrawTooltip(ui, words, &row);
  }
}

void DrawMember(const TrackerMember& member, const Columns& c, const Rect& row, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const float y = row.centre().y;
  ImFont* font = member.in_force ? s.medium : s.caption;
  if (member.in_force) {
    Canvas()->AddCircleFilled({c.who + s.Px(5), y}, s.Fine(3.5f), p.white_mark);
  }
  DrawText(ui, font, member.followed() ? p.text1 : p.text2, c.who + s.Px(14), y, member.name);
  DrawText(ui, s.caption, p.text1, c.coherence, y,
           member.followed() ? Fixed(member.coherence, 2) : Fixed(NAN, 2), Align::kRight);
  if (c.has_weight) {
    DrawText(ui, s.caption, p.text1, c.weight, y, Fixed(100 * member.weight, 0) + " %",
             Align::kRight);
  }
  DrawText(ui, s.caption, p.text1, c.off, y, Fixed(member.disagreement_px, 1) + " px",
           Align::kRight);
  DrawCut("tracker/" + member.name, TrackerStateWords(member), row, c.state, s.caption, p.text1,
          ui);
}

float RowsHeight(const TrackerSetStatus& set, const Style& s) {
  return s.Px(kHeadRow) + s.Px(kRow) * static_cast<float>(set.members.size() + 1);
}

/// Rows, as many as there is room for above the consensus.
void DrawRows(const TrackerSetStatus& set, const Rect& area, UiFrame& ui) {
  const Style& s = ui.style;
  const Columns c = ColumnsOf(area, s);
  DrawHeadRow(c, area.y + s.Px(kHeadRow) / 2, ui);
  Rect row{area.x, area.y + s.Px(kHeadRow), area.w, s.Px(kRow)};
  for (const TrackerMember& member : set.members) {
    if (row.bottom() + s.Px(kRow) > area.bottom() + 1) {
      break;
    }
    DrawMember(member, c, row, ui);
    row.y += s.Px(kRow);
  }
  FillRect(Canvas(), {c.who, row.y, area.w - s.Px(24), s.Px(1)}, s.palette.line);
  row.y += s.Px(1);
  DrawText(ui, s.caption, s.palette.text2, c.who + s.Px(14), row.centre().y, "Consensus");
  DrawCut("tracker/consensus", ConsensusWords(set), row, c.who + s.Px(kWhoWidth), s.caption,
          s.palette.text1, ui);
}

/// Anchor, now and difference of the one in force.
void DrawPictures(const EngineSnapshot& snap, const Rect& area, UiFrame& ui) {
  const Style& s = ui.style;
  const TrackerStatus& tracker = snap.flight->tracker;
  const ImTextureID textures[] = {ui.textures.anchor_patch, ui.textures.current_patch,
                                  ui.textures.difference_patch};
  const std::string captions[] = {
      tracker.locked ? "Anchor, " + Fixed(tracker.anchor_height_m, 0) + " m" : "Anchor",
      tracker.locked ? "Now, " + Fixed(snap.flight->mission.height_above_site_m, 0) + " m" : "Now",
      "Difference"};
  const float gap = s.Px(7);
  const float width = std::floor((area.w - s.Px(24) - 2 * gap) / 3);
  const float height = std::min(area.h - s.Px(36), width);
  for (int i = 0; i < 3; ++i) {
    const Rect picture{area.x + s.Px(12) + static_cast<float>(i) * (width + gap), area.y + s.Px(4),
                       width, height};
    if (textures[i] != nullptr) {
      // Square patches fill the wide frame; the middle band is what the eye compares.
      const float cut = (1 - height / width) / 2;
      Canvas()->AddImage(textures[i], picture.min(), picture.max(), {0, cut}, {1, 1 - cut});
    } else {
      UnknownFill(s, Canvas(), picture);
    }
    if (tracker.why_not_locked.empty()) {
      DrawText(ui, s.caption, s.palette.text2, picture.x, picture.bottom() + s.Px(13), captions[i]);
    }
  }
  DrawText(ui, s.caption, s.palette.text2, area.x + s.Px(12), area.y + height + s.Px(17),
           FitWords(s.caption, tracker.why_not_locked, area.w - s.Px(24)));
}

/// Who is in force, and of what picture: an old one is told as such.
PanelFact HeadFact(const EngineSnapshot& snap, double silent_s) {
  const TrackerSetStatus& set = snap.flight->trackers;
  const TrackerStatus& tracker = snap.flight->tracker;
  if (!set.members.empty()) {
    const Arrival arrival =
        ArrivalOf(snap, ChannelId::kCameraLeft, silent_s, SecondsBetween(set.time, snap.time));
    if (arrival.late()) {
      return {"Of a picture " + arrival.age + " old", 0, false, true};
    }
  }
  std::string fact = tracker.locked ? tracker.mode : "Not locked";
  if (!SeenFromStart(snap.session->role)) {
    return {fact + ", begun anew at the jump"};
  }
  if (tracker.locked && tracker.anchor_patch) {
    fact += ", " + std::to_string(tracker.anchor_patch->width()) + " px";
  }
  return {fact};
}

/// In the panel's head: what it shows instead.
void OfferPictures(const Rect& panel, TrackerPanelState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const std::string words = state.pictures ? "All trackers" : "Pictures";
  ButtonLook look;
  look.font = s.caption;
  look.flat = true;
  const Rect rect{panel.x + s.Px(18) + TextWidth(s.medium, "Tracker"), panel.y + s.Px(3),
                  TextWidth(s.caption, words) + s.Px(12), s.Px(22)};
  if (DrawButton(ui, "tracker_pictures", rect, words, look)) {
    state.pictures = !state.pictures;
  }
}

}  // namespace

void DrawTrackerPanel(const EngineSnapshot& snap, const Rect& rect, TrackerPanelState& state,
                      UiFrame& ui) {
  const Style& s = ui.style;
  const TrackerSetStatus& set = snap.flight->trackers;
  const Rect content = DrawPanelFrame(ui, rect, "Tracker", {HeadFact(snap, ui.silent_s)});
  if (set.members.empty()) {
    DrawPictures(snap, content, ui);
    return;
  }
  const float rows = RowsHeight(set, s);
  const bool both = content.h >= rows + s.Px(kLeastPictures);
  if (!both) {
    OfferPictures(rect, state, ui);
  }
  if (both || !state.pictures) {
    DrawRows(set, content, ui);
  }
  if (both) {
    DrawPictures(
        snap, {content.x, content.y + rows + s.Px(4), content.w, content.h - rows - s.Px(4)}, ui);
  } else if (state.pictures) {
    DrawPictures(snap, content, ui);
  }
}

}  // namespace palace
