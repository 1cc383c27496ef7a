// Review: where the panels lie, the right column.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/core/units.h"
#include "gui/panels/fly_panels.h"
#include "gui/panels/review/review.h"
#include "gui/widgets/button.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

constexpr const char* kFields[] = {"slad.max_slope_deg", "slad.max_deviation_m", "slad.max_step_m",
                                   "slad.nav_error_m"};

void DrawLeft(const EngineSnapshot& snap, const Rect& rect, ReviewState& state, UiFrame& ui) {
  const std::string frame =
      "Frame " + Fixed(static_cast<double>(snap.session->source.frame_index), 0);
  const Rect content = DrawPanelFrame(ui, rect, "Left camera", {{frame, 0, false, false}});
  LeftPicture look;
  look.decision = snap.terrain->applied.get();
  look.ghost = snap.terrain->recorded.get();
  look.ghost_word = "recorded";
  look.plate = snap.terrain->recorded && !(MapAge(snap, look.decision) > kOldMap_s)
                   ? "Re-decided overlay"
                   : "";
  look.probe = &state.probe;
  DrawLeftPicture(ui, content, snap, look, state.overlay);
}

void DrawRightPicture(const EngineSnapshot& snap, const Rect& rect, const MapProbe& probe,
                      UiFrame& ui) {
  const std::string frame =
      "Frame " + Fixed(static_cast<double>(snap.session->source.frame_index), 0);
  const Rect content = DrawPanelFrame(ui, rect, "Right camera", {{frame, 0, false, false}});
  const double row_error_px = snap.terrain->stereo_quality.row_error_px;
  DrawPlainPicture(ui, content, snap, ui.textures.right_camera,
                   std::isfinite(row_error_px) ? "Row error " + Fixed(row_error_px, 2) + " px" : "",
                   &probe);
}

/// Narrow: which of the two pictures is shown.
void DrawPictureTabs(const Rect& tabs, ReviewState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const float tab_y = tabs.y + s.Px(4);
  DrawPanelBackground(ui, tabs, "Tabs");
  ButtonLook look;
  look.active = state.picture == ReviewPicture::kView3d;
  if (DrawButton(ui, "review_tab/3-D", {tabs.x + s.Px(4), tab_y, s.Px(64), s.Px(24)}, "3-D",
                 look)) {
    state.picture = ReviewPicture::kView3d;
  }
  look.active = state.picture == ReviewPicture::kRightCamera;
  if (DrawButton(ui, "review_tab/Right", {tabs.x + s.Px(76), tab_y, s.Px(108), s.Px(24)},
                 "Right camera", look)) {
    state.picture = ReviewPicture::kRightCamera;
  }
}

void DrawPictures(const EngineSnapshot& snap, const ReviewLayout& layout, ReviewState& state,
                  UiFrame& ui) {
  DrawLeft(snap, layout.left_camera, state, ui);
  if (layout.picture_tabs.h > 0) {
    DrawPictureTabs(layout.picture_tabs, state, ui);
  }
  if (layout.right_camera.h > 0) {
    DrawRightPicture(snap, layout.right_camera, state.probe, ui);
  }
  if (layout.view_3d.h > 0) {
    DrawView3dPanel(snap, layout.view_3d, ui);
  }
}

/// Letter of the site in question and what other limits say about it.
struct Verdict {
  std::string recorded = "––";
  std::string now = "––";
  std::string reason;
};

Verdict JudgeSite(const EngineSnapshot& snap) {
  Verdict v;
  if (snap.terrain->maps_to_rebuild > 0) {
    v.reason =
        "After the jump the map is built anew: " + std::to_string(snap.terrain->maps_to_rebuild) +
        (snap.session->source.ended
             ? " frames are missing, and the log ends here. Go back and play."
             : " frames still to come. Play on.");
    return v;
  }
  const MissionStatus& m = snap.flight->mission;
  const TerrainDecision* recorded = snap.terrain->OfRecord().get();
  const LandingSite* site = m.armed ? &*m.armed : BestSite(snap, recorded);
  if (site == nullptr) {
    v.recorded = "No site";
    const LandingSite* now = BestSite(snap, snap.terrain->applied.get());
    v.now = now != nullptr ? "Would propose " + LetterOf(now) : "No site";
    return v;
  }
  const std::string letter = site->letter;
  v.recorded =
      (m.approval || m.state >= MissionState::kApproved ? "Approved "
                                                        : (m.armed ? "Armed " : "Proposed ")) +
      letter;
  if (snap.terrain->site_review && snap.terrain->site_review->letter == site->letter) {
    v.now = (snap.terrain->site_review->kept ? "Would keep " : "Would refuse ") + letter;
    v.reason = snap.terrain->site_review->reason;
  }
  return v;
}

}  // namespace

void DrawRedecidePanel(const EngineSnapshot& snap, const FlightRecord* record, const Rect& rect,
                       ReviewState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  Settings recorded =
      record != nullptr && record->has_settings ? record->settings_at_start : Settings{};
  if (const TerrainDecision* decision = snap.terrain->OfRecord().get()) {
    recorded.slad = decision->settings;  // in force here, where they were moved in flight
  }
  int changed = 0;
  for (const SettingInfo& info : SettingTable()) {
    changed +=
        GetSetting(snap.session->settings, info.name) != GetSetting(recorded, info.name) ? 1 : 0;
  }
  const Rect content = DrawPanelFrame(
      ui, rect, "Re-decide",
      {{std::to_string(changed) + (changed == 1 ? " limit changed" : " limits changed"), 0, false,
        false}});
  const float pad = s.Px(12);
  const float recorded_x = content.right() - s.Px(116), field_x = content.right() - s.Px(100);
  const float head = content.y + s.Px(8);
  DrawText(ui, s.caption, p.text2, content.x + pad, head, "Limit");
  DrawText(ui, s.caption, p.text2, recorded_x, head, "Recorded", Align::kRight);
  DrawText(ui, s.caption, p.text2, content.right() - pad, head, "Re-decided", Align::kRight);
  const float button_h = s.Px(rect.h < s.Px(210) ? 32 : 36);
  float y = content.y + s.Px(20);
  const float room = rect.bottom() - button_h - s.Px(10) - y;
  const float pitch =
      std::clamp(std::floor(room / static_cast<float>(std::size(kFields))), s.Px(25), s.Px(32));
  for (const char* name : kFields) {
    const SettingInfo* info = FindSetting(name);
    if (info == nullptr || y + pitch > rect.bottom() - button_h - s.Px(10)) {
      continue;
    }
    const float middle = y + pitch / 2;
    SliderRow row;
    row.info = info;
    row.value = GetSetting(snap.session->preview_settings, name);
    const double before = GetSetting(recorded, name);
    row.pending = row.value != before;
    if (row.pending) {
      FillRect(Canvas(), {content.x, y + s.Px(2), s.Px(4), pitch - s.Px(4)}, p.white_mark);
    }
    DrawText(ui, row.pending ? s.medium : s.body, row.pending ? p.text1 : p.text2,
             content.x + s.Px(16), middle, info->label);
    DrawText(ui, s.body, p.text2, recorded_x, middle, FormatSetting(*info, before), Align::kRight);
    DrawValueField(ui, {field_x, y + s.Px(2), s.Px(88), pitch - s.Px(4)}, row,
                   snap.session->preview_settings, state.fields, FieldKeys::kOwn);
    y += pitch;
  }
  ButtonLook look;
  look.font = s.medium;
  look.enabled = snap.session->source.can_seek;
  look.reason = "Only a log can be decided again";
  const Rect button{rect.x + pad, rect.bottom() - s.Px(8) - button_h, rect.w - 2 * pad, button_h};
  if (DrawButton(ui, "redecide", button, "Re-decide whole flight", look)) {
    ui.intents.push_back(PlaybackControl{PlaybackControl::Kind::kSeek, 0});
    ui.intents.push_back(PlaybackControl{PlaybackControl::Kind::kSpeed, 0});
    ui.intents.push_back(PlaybackControl{PlaybackControl::Kind::kPlay, 0});
  }
}

void DrawDecisionPanel(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const Rect content =
      DrawPanelFrame(ui, rect, "Decision at " + TimeLabel(snap.session->source.position_s, true));
  const TerrainDecision* was = snap.terrain->OfRecord().get();
  const TerrainDecision* is = snap.terrain->applied.get();
  const LandingSite* a = BestSite(snap, was);
  const LandingSite* b = BestSite(snap, is);
  const Verdict verdict = JudgeSite(snap);
  const auto figure = [](const LandingSite* site, auto get) {
    return site != nullptr ? get(*site) : std::string("––");
  };
  const auto radius = [](const LandingSite& x) { return Fixed(x.safe_distance_m, 1) + " m"; };
  const auto slope = [](const LandingSite& x) { return Fixed(Deg(x.slope_rad.value), 1) + "°"; };
  const auto rough = [](const LandingSite& x) {
    return Fixed(x.roughness_m.value * 100, 1) + " cm";
  };
  const struct {
    const char* name;
    std::string recorded, now;
  } rows[] = {{"", "Recorded", "Re-decided"},
              {"Best site", LetterOf(a), LetterOf(b)},
              {"Clear radius", figure(a, radius), figure(b, radius)},
              {"Slope", figure(a, slope), figure(b, slope)},
              {"Roughness", figure(a, rough), figure(b, rough)},
              {"Safe area", Fixed(SafeArea(was), 0) + " m²", Fixed(SafeArea(is), 0) + " m²"},
              {"Decision", verdict.recorded, verdict.now}};
  const float pad = s.Px(12);
  // Room for the seven rows and one line of reason, also in a narrow window.
  const float pitch = std::min(s.Px(25), std::floor((content.h - s.Px(34)) / 7));
  float y = content.y + s.Px(10);
  for (const auto& row : rows) {
    const bool head = row.name[0] == '\0';
    DrawText(ui, s.body, p.text2, content.x + pad, y, row.name);
    DrawText(ui, head ? s.caption : s.body, p.text2, content.right() - s.Px(130), y, row.recorded,
             Align::kRight);
    DrawText(ui, head ? s.caption : s.medium, head ? p.text2 : p.text1, content.right() - pad, y,
             row.now, Align::kRight);
    y += pitch;
  }
  for (const std::string& line : WrapText(s.body, verdict.reason, content.w - 2 * pad)) {
    if (y + s.Px(8) > rect.bottom()) {
      break;
    }
    DrawText(ui, s.body, p.text2, content.x + pad, y, line);
    y += s.Px(20);
  }
}

void DrawDifferencesPanel(const EngineSnapshot& snap, const FlightRecord* record,
                          const std::vector<ReviewDifference>& found, const Rect& rect,
                          UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const Rect content =
      DrawPanelFrame(ui, rect, "Differences", {{std::to_string(found.size()), 0, false, false}});
  float y = content.y;
  if (found.empty()) {
    const char* why = record == nullptr || record->samples.empty()
                          ? "This source carries no recorded decisions."
                          : "None in the part replayed so far. Change a limit and re-decide.";
    for (const std::string& line : WrapText(s.body, why, content.w - s.Px(24))) {
      DrawText(ui, s.body, p.text2, content.x + s.Px(12), y + s.Px(14), line);
      y += s.Px(20);
    }
    return;
  }
  ui.tab.list = "differences";
  for (std::size_t i = 0; i < found.size() && y + s.Px(30) <= rect.bottom(); ++i) {
    const ReviewDifference& d = found[i];
    const Rect row{content.x, y, content.w, s.Px(30)};
    y = row.bottom();
    const auto name = [](const std::string& letter) {
      return letter.empty() ? "no site" : "site " + letter;
    };
    const std::string words = "Best " + name(d.recorded) + ", now " + name(d.now);
    const Interaction in =
        Interact(ui, "difference/" + std::to_string(i), row,
                 snap.session->source.can_seek ? 0U : unsigned{kDisabled}, words);
    const bool here =
        snap.session->source.position_s >= d.at_s && snap.session->source.position_s <= d.to_s;
    if (here || in.hovered) {
      FillRect(Canvas(), row, here ? p.hover : p.control);
    }
    if (here) {
      FillRect(Canvas(), {row.x, row.y, s.Px(4), row.h}, p.white_mark);
    }
    const float middle = row.centre().y;
    const float x = row.x + s.Px(16);
    const float text_x =
        x + DrawText(ui, s.mono, p.text2, x, middle, TimeLabel(d.at_s, true)) + s.Px(20);
    DrawText(ui, s.body, p.text1, text_x, middle, words);
    DrawIcon(Canvas(), Icon::kChevronRight, {row.right() - s.Px(18), middle}, s.Px(12), p.text2);
    if (in.clicked) {
      ui.intents.push_back(PlaybackControl{PlaybackControl::Kind::kSeek, d.at_s});
    }
  }
  ui.tab.list = {};
}

void DrawReviewWorkspace(const EngineSnapshot& snap, const FlightRecord* record, const Rect& body,
                         ReviewState& state, UiFrame& ui) {
  const Style& s = ui.style;
  if (!HasSource(snap.session->role)) {
    DrawPanelBackground(ui, body, "Review");
    DrawText(ui, s.section, s.palette.text1, body.centre().x, body.centre().y,
             "No log open. Start palace with --replay LOG to review a flight.", Align::kCentre);
    return;
  }
  const ReviewLayout layout = LayReview(body, s, state.picture);
  const ReviewDigest& digest = DigestOf(snap, record, s.palette, !layout.narrow, state.digest);
  BeginProbe(state.probe);
  ui.tab.group = kDecisionTabs;
  DrawReviewTimeline(snap, digest.timeline, layout.timeline, state, ui);
  DrawRedecidePanel(snap, record, layout.redecide, state, ui);
  DrawDecisionPanel(snap, layout.decision, ui);
  if (layout.differences.h > 0) {
    DrawDifferencesPanel(snap, record, digest.differences, layout.differences, ui);
  }
  ui.tab.group = kViewTabs;
  DrawPictures(snap, layout, state, ui);
  DrawReviewMaps(snap, digest, layout.maps, layout.map_side, state.probe, ui);
  DrawReviewPlots(digest.plots, layout.plots, state.plots, ui);
  const bool recorded = state.probe.ShownMap() == "map/Recorded";
  DrawProbeWhy(ui, body, recorded ? snap.terrain->OfRecord().get() : snap.terrain->applied.get(),
               state.probe, snap.time);
}

}  // namespace palace
