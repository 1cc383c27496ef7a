#include <algorithm>
#include <cmath>

#include "engine/core/shown_difference.h"
#include "engine/model/site_standing.h"
#include "gui/panels/fly_panels.h"
#include "gui/panels/map_views.h"
#include "gui/widgets/icons.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

constexpr double kShownEvery_m = 3;

bool IsWorse(const SiteRecheck& a, const SiteRecheck& b) {
  return a.verdict != b.verdict ? a.verdict > b.verdict : a.safe_distance_m < b.safe_distance_m;
}

/// The newest check, before it the worst of each stretch of height, and of the whole descent the
/// worst in any case; oldest first. Of a stretch that is over the row stays.
std::vector<const SiteRecheck*> Spaced(const std::vector<SiteRecheck>& rechecks, std::size_t most) {
  std::vector<const SiteRecheck*> picked;
  if (rechecks.empty()) {
    return picked;
  }
  const auto stretch = [](const SiteRecheck& check) {
    return std::floor(check.height_above_site_m / kShownEvery_m);
  };
  for (auto it = rechecks.rbegin() + 1; it != rechecks.rend(); ++it) {
    if (picked.empty() || stretch(*it) > stretch(*picked.back())) {
      picked.push_back(&*it);
    } else if (IsWorse(*it, *picked.back())) {
      picked.back() = &*it;
    }
  }
  if (picked.size() > most - 1) {
    const auto worst = std::min_element(
        picked.begin() + static_cast<std::ptrdiff_t>(most - 2), picked.end(),
        [](const SiteRecheck* a, const SiteRecheck* b) { return IsWorse(*a, *b); });
    picked[most - 2] = *worst;
    picked.resize(most - 1);
  }
  picked.insert(picked.begin(), &rechecks.back());
  std::reverse(picked.begin(), picked.end());
  return picked;
}

struct VerdictLook {
  Icon icon;
  ImU32 colour;
};

/// One map over a limit does not end a site, but is none that it passed.
VerdictLook LookOf(const SiteRecheck& check, const Palette& p) {
  switch (check.verdict) {
    case SiteVerdict::kHolds:
      return check.holds ? VerdictLook{Icon::kDone, p.text2}
                         : VerdictLook{Icon::kCaution, p.caution};
    case SiteVerdict::kDegraded:
      return {Icon::kCaution, p.caution};
    case SiteVerdict::kLost:
      break;
  }
  return {Icon::kWarning, p.warning};
}

/// As many whole lines as the column has room for; returns where the next may stand.
float DrawLines(UiFrame& ui, const Rect& column, float y, const std::string& text, ImU32 colour) {
  const Style& s = ui.style;
  for (const std::string& line : WrapText(s.caption, text, column.w)) {
    if (y + s.Px(8) > column.bottom()) {
      break;
    }
    DrawText(ui, s.caption, colour, column.x, y, line);
    y += s.Px(17);
  }
  return y + s.Px(5);
}

/// When the site is asked again, and that it no longer is.
void DrawSchedule(const EngineSnapshot& snap, const Rect& column, float y, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const MissionStatus& m = snap.flight->mission;
  const double until_m =
      m.IsLook() ? m.stop_height_m : snap.session->settings.slad.fusion.commit_height_m;
  const bool waved_off = m.state == MissionState::kAborting;
  const bool over =
      waved_off || m.state == MissionState::kLanded || m.height_above_site_m < until_m;
  FillRect(Canvas(), {column.x, y - s.Px(4), column.w, s.Px(1)}, p.line);
  DrawIcon(Canvas(), over ? Icon::kDone : Icon::kStale, {column.x + s.Px(6), y + s.Px(14)},
           s.Px(12), p.text2);
  DrawText(ui, s.body, p.text1, column.x + s.Px(20), y + s.Px(14),
           over ? "No more maps" : "Each new map");
  DrawText(ui, s.caption, p.text2, column.x + s.Px(20), y + s.Px(34),
           waved_off ? "waved off" : (over ? "below " : "down to ") + Fixed(until_m, 1) + " m");
}

/// The site's own reason compares it with the best of its map, which nobody may have chosen.
std::string BesideFlown(const LandingSite& kept, const SiteRecheck& newest,
                        const MissionStatus& mission) {
  const double wider_m = DifferenceAsShown(kept.safe_distance_m, newest.safe_distance_m);
  const std::string flown = mission.armed ? mission.armed->letter : "the site";
  if (std::isnan(wider_m)) {
    return flown + " is off the map";
  }
  if (std::abs(wider_m) < 0.05) {
    return "as clear as " + flown;
  }
  return Fixed(std::abs(wider_m), 1) + (wider_m < 0 ? " m less" : " m more") + " clear than " +
         flown;
}

void DrawChecksColumn(const EngineSnapshot& snap, const Rect& column, bool narrow, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const float pitch = s.Px(narrow ? 22 : 28);
  float y = column.y + s.Px(14);
  const bool roomy = column.w > s.Px(130);
  for (const SiteRecheck* check : Spaced(snap.flight->mission.rechecks, narrow ? 3 : 4)) {
    const VerdictLook look = LookOf(*check, p);
    DrawIcon(Canvas(), look.icon, {column.x + s.Px(6), y}, s.Px(12), look.colour);
    DrawText(ui, s.body, p.text2, column.x + s.Px(20), y,
             Fixed(check->height_above_site_m, 1) + " m");
    const std::string clear = Fixed(check->safe_distance_m, 1) + (roomy ? " m clear" : " m");
    DrawText(ui, s.medium, p.text1, column.right(), y, clear, Align::kRight);
    y += pitch;
  }
  if (!narrow) {
    DrawSchedule(snap, column, y, ui);
    y += s.Px(60);
  }
  if (snap.flight->mission.rechecks.empty()) {
    return;
  }
  const SiteRecheck& newest = snap.flight->mission.rechecks.back();
  if (newest.verdict != SiteVerdict::kHolds) {
    y = DrawLines(ui, column, y,
                  std::string(SiteVerdictWord(newest.verdict)) + ": " + newest.reason, p.text1);
  }
  const bool may_serve = snap.flight->mission.state != MissionState::kLanded;
  if (newest.alternative && may_serve && y + s.Px(38) <= column.bottom()) {
    const LandingSite& kept = *newest.alternative;
    DrawText(ui, s.caption, p.text2, column.x, y, "Alternative kept");
    LetterPlate(ui, {column.x + s.Px(10), y + s.Px(24)}, kept.letter, false);
    DrawText(ui, s.medium, p.text1, column.x + s.Px(28), y + s.Px(24),
             Fixed(kept.safe_distance_m, 1) + " m clear");
    const std::string beside = BesideFlown(kept, newest, snap.flight->mission);
    ui.items.Add("alternative", {column.x, y - s.Px(8), column.w, s.Px(42)}, true,
                 kept.letter + " " + beside);
    DrawLines(ui, column, y + s.Px(46), beside, p.text2);
  }
}

/// A newer map may hold older ground: what has left the view is judged as it was seen last.
std::string GroundAge(const MissionStatus& m) {
  return m.armed_now && !IsInView(*m.armed_now)
             ? ", ground seen " + Duration(m.armed_now->age_s) + " before"
             : std::string();
}

}  // namespace

void DrawSiteRecheckPanel(const EngineSnapshot& snap, const Rect& rect, bool narrow,
                          MapProbe& probe, UiFrame& ui) {
  const Style& s = ui.style;
  const MissionStatus& m = snap.flight->mission;
  std::string title = "Site re-checked";
  if (m.armed) {
    title = std::string("Site ") + m.armed->letter + " re-checked";
  }
  const bool told = SeenFromStart(snap.session->role);  // a record holds none of them
  const std::string age = !m.rechecks.empty()
                              ? Duration(SecondsBetween(m.rechecks.back().time, snap.time)) + " ago"
                          : told ? "not yet"
                                 : "not told after a jump";
  const Rect content = DrawPanelFrame(ui, rect, title, {{age + GroundAge(m)}});
  // As large as the panel is high, beside a column of figures.
  const float side = std::min({s.Px(232), content.h - s.Px(52), content.w - s.Px(40 + 118)});
  const Rect square{content.x + s.Px(12), content.y + s.Px(4), side, side};
  MapView view = MakeMapView(MapKind::kSafeDistance, ShownMap(snap, ui.silent_s), ui.textures);
  view.key = "recheck";
  view.preview = snap.terrain->preview != nullptr;
  MapMarks marks = MarksOf(snap, 0);
  marks.letters = false;
  marks.footprint.clear();
  marks.probe = ProbeCell(probe, view.geometry);
  const MapAnswer answer = DrawMapPicture(ui, square, view, marks);
  OfferProbe(view, answer, probe);
  if (answer.discards) {
    ui.intents.push_back(CommandAction(DiscardSettings{}));
  }
  DrawColourBar(ui, {square.x, square.bottom() + s.Px(10), side, s.Px(8)}, view, nullptr);
  const float column_x = square.right() + s.Px(16);
  DrawChecksColumn(snap, {column_x, content.y, rect.right() - s.Px(12) - column_x, content.h},
                   narrow, ui);
}

}  // namespace palace
