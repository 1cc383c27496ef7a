// Review: where the panels lie, the pictures, the list of differences.
#include <cmath>

#include "gui/panels/fly_panels.h"
#include "gui/panels/review/review.h"
#include "gui/panels/track_view.h"
#include "gui/widgets/button.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

void DrawLeft(const EngineSnapshot& snap, const Rect& rect, ReviewState& state, UiFrame& ui) {
  const std::string frame =
      "Frame " + Fixed(static_cast<double>(snap.session->source.frame_index), 0);
  const Rect content = DrawPanelFrame(ui, rect, "Left camera", {{frame, 0, false, false}});
  OfferTrackView("Left camera", rect, state.track_view, ui);
  LeftPicture look;
  look.decision = snap.terrain->applied.get();
  look.ghost = snap.terrain->recorded.get();
  look.ghost_word = "recorded";
  look.plate = snap.terrain->recorded && !(AgeBehindPicture(snap, look.decision) > kVerdictOld_s)
                   ? "Re-decided overlay"
                   : "";
  look.probe = &state.probe;
  look.track_view = state.track_view;
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

/// "210 of 352 maps"; "210 maps" where nobody knows how many there are.
std::string MapsWords(const RedecidedShare& share) {
  return std::to_string(share.judged) +
         (share.maps > 0 ? " of " + std::to_string(share.maps) : std::string()) + " maps";
}

}  // namespace

std::string WhyNoDifference(const EngineSnapshot& snap, const RedecidedShare& redecided) {
  if (!FollowsRecord(snap.session->role)) {
    return "Only a recorded flight can be decided again: palace --replay LOG.";
  }
  if (LimitsMoved(snap) == 0) {
    return "No limit differs from those of the flight, so nothing differs. Move one, above.";
  }
  if (redecided.judged == 0 && snap.terrain->maps_to_rebuild > 0) {
    return "Maps that are built anew after the jump do not count. Play on, or re-decide the whole "
           "flight.";
  }
  if (redecided.judged == 0) {
    return "No map was judged under these limits yet. Play, or re-decide the whole flight.";
  }
  return "None in the " + MapsWords(redecided) + " judged under these limits so far.";
}

void Ask(UiFrame& ui, const Intents& intents) {
  ui.intents.insert(ui.intents.end(), intents.begin(), intents.end());
}

void DrawDifferencesPanel(const EngineSnapshot& snap, const Rect& rect, ReviewState& state,
                          UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const ReviewDigest& digest = state.digest;
  const std::vector<ReviewDifference>& found = digest.differences;
  const std::string among =
      digest.redecided.judged > 0 ? " in " + MapsWords(digest.redecided) : std::string();
  const Rect content = DrawPanelFrame(ui, rect, "Differences",
                                      {{std::to_string(found.size()) + among, 0, false, false}});
  float y = content.y;
  if (found.empty()) {
    for (const std::string& line :
         WrapText(s.body, WhyNoDifference(snap, digest.redecided), content.w - s.Px(24))) {
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
      // A breath after it began: the first map of a stretch is on the screen then.
      constexpr double kAfter_s = 0.05;
      Ask(ui, state.run_in.Begin(snap.session->source, d.at_s + kAfter_s));
    }
  }
  ui.tab.list = {};
}

namespace {

/// Who plays or jumps by itself: one at a time.
void FollowReplay(const SourceStatus& source, ReviewState& state, UiFrame& ui) {
  if (!state.redecide.running()) {
    Ask(ui, state.run_in.running() ? state.run_in.Follow(source) : state.loop.Follow(source));
  }
}

}  // namespace

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
  FollowReplay(snap.session->source, state, ui);
  ui.tab.group = kDecisionTabs;
  DrawReviewTimeline(snap, record, layout.timeline, state, ui);
  DrawRedecidePanel(snap, record, layout.redecide, state, ui);
  DrawDecisionPanel(snap, record, layout.decision, ui);
  if (layout.differences.h > 0) {
    DrawDifferencesPanel(snap, layout.differences, state, ui);
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
