#include "gui/panels/fly_panels.h"
#include "gui/widgets/draw.h"
#include "gui/widgets/number_text.h"

namespace palace {

void DrawTrackerPanel(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const TrackerStatus& tracker = snap.flight->tracker;
  std::string fact = tracker.locked ? tracker.mode : "Not locked";
  if (tracker.locked && tracker.anchor_patch) {
    fact += ", " + std::to_string(tracker.anchor_patch->width()) + " px";
  }
  const Rect content = DrawPanelFrame(ui, rect, "Tracker", {{fact}});
  const ImTextureID textures[] = {ui.textures.anchor_patch, ui.textures.current_patch,
                                  ui.textures.difference_patch};
  const std::string captions[] = {
      tracker.locked ? "Anchor, " + Fixed(tracker.anchor_height_m, 0) + " m" : "Anchor",
      tracker.locked ? "Now, " + Fixed(snap.flight->mission.height_above_site_m, 0) + " m" : "Now",
      "Difference"};
  const float gap = s.Px(7);
  const float width = std::floor((content.w - s.Px(24) - 2 * gap) / 3);
  const float height = content.h - s.Px(36);
  for (int i = 0; i < 3; ++i) {
    const Rect picture{content.x + s.Px(12) + static_cast<float>(i) * (width + gap),
                       content.y + s.Px(4), width, height};
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
  DrawText(ui, s.caption, s.palette.text2, content.x + s.Px(12),
           content.y + s.Px(4) + height + s.Px(13),
           FitWords(s.caption, tracker.why_not_locked, content.w - s.Px(24)));
}

}  // namespace palace
