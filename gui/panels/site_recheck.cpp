#include <algorithm>
#include <cmath>

#include "gui/panels/fly_panels.h"
#include "gui/widgets/icons.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

constexpr double kShownEvery_m = 3;

/// The newest checks, spaced so that a list of few covers the descent; oldest first.
std::vector<const SiteRecheck*> Spaced(const std::vector<SiteRecheck>& rechecks, std::size_t most) {
  std::vector<const SiteRecheck*> picked;
  for (auto it = rechecks.rbegin(); it != rechecks.rend() && picked.size() < most; ++it) {
    if (picked.empty() ||
        it->height_above_site_m >= picked.back()->height_above_site_m + kShownEvery_m ||
        it->holds != picked.back()->holds) {
      picked.push_back(&*it);
    }
  }
  std::reverse(picked.begin(), picked.end());
  return picked;
}

void DrawChecksColumn(const EngineSnapshot& snap, const Rect& column, bool narrow, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const float pitch = s.Px(narrow ? 22 : 28);
  float y = column.y + s.Px(14);
  const bool roomy = column.w > s.Px(130);
  for (const SiteRecheck* check : Spaced(snap.mission.rechecks, narrow ? 3 : 4)) {
    DrawIcon(Canvas(), check->holds ? Icon::kDone : Icon::kCaution, {column.x + s.Px(6), y},
             s.Px(12), check->holds ? p.text2 : p.caution);
    DrawText(ui, s.body, p.text2, column.x + s.Px(20), y,
             Fixed(check->height_above_site_m, 0) + " m");
    const std::string clear = Fixed(check->safe_distance_m, 1) + (roomy ? " m clear" : " m");
    DrawText(ui, s.medium, p.text1, column.right(), y, clear, Align::kRight);
    y += pitch;
  }
  y += s.Px(2);
  FillRect(Canvas(), {column.x, y - s.Px(6), column.w, s.Px(1)}, p.line);
  y += s.Px(12);
  DrawIcon(Canvas(), Icon::kStale, {column.x + s.Px(6), y}, s.Px(12), p.text2);
  DrawText(ui, s.body, p.text1, column.x + s.Px(20), y, "Each new map");
  y += s.Px(20);
  DrawText(ui, s.caption, p.text2, column.x + s.Px(20), y,
           "down to " + Fixed(snap.settings.slad.commit_height_m, 1) + " m");
  y += s.Px(30);
  const TerrainDecision* shown = ShownDecision(snap);
  if (shown == nullptr || !snap.mission.armed || y + s.Px(28) > column.bottom()) {
    return;
  }
  for (const LandingSite& site : shown->selection.sites) {
    // A place that shares ground with the approved one is no alternative.
    const double apart_m = (site.p_WS - snap.mission.armed->p_WS).head<2>().norm();
    if (site.id != snap.mission.armed->id && apart_m > site.clear_radius_m) {
      DrawText(ui, s.caption, p.text2, column.x, y, "Alternative kept");
      LetterPlate(ui, {column.x + s.Px(10), y + s.Px(24)}, site.letter, false);
      DrawText(ui, s.medium, p.text1, column.x + s.Px(28), y + s.Px(24),
               Fixed(site.safe_distance_m, 1) + " m clear");
      return;
    }
  }
}

}  // namespace

void DrawSiteRecheckPanel(const EngineSnapshot& snap, const Rect& rect, bool narrow, UiFrame& ui) {
  const Style& s = ui.style;
  const MissionStatus& m = snap.mission;
  std::string title = "Site re-checked";
  if (m.armed) {
    title = std::string("Site ") + m.armed->letter + " re-checked";
  }
  const std::string age =
      m.rechecks.empty() ? "not yet"
                         : Duration(SecondsBetween(m.rechecks.back().time, snap.time)) + " ago";
  const Rect content = DrawPanelFrame(ui, rect, title, {{age}});
  const float side = std::min(s.Px(232), content.h - s.Px(52));
  const Rect square{content.x + s.Px(12), content.y + s.Px(4), side, side};
  MapView view = SafeDistanceMap(snap, ui);
  view.key = "recheck";
  MapMarks marks = MarksOf(snap, 0);
  marks.letters = false;
  marks.footprint.clear();
  DrawMapPicture(ui, square, view, marks);
  DrawColourBar(ui, {square.x, square.bottom() + s.Px(10), side, s.Px(8)}, view, nullptr);
  const float column_x = square.right() + s.Px(16);
  DrawChecksColumn(snap, {column_x, content.y, rect.right() - s.Px(12) - column_x, content.h},
                   narrow, ui);
}

}  // namespace palace
