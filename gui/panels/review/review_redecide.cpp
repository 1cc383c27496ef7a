// Review: the limits as the flight had them and as the reviewer sets them, and deciding the whole
// flight again.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "gui/panels/review/review.h"
#include "gui/widgets/button.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

constexpr const char* kFields[] = {"slad.max_slope_deg", "slad.max_deviation_m", "slad.max_step_m",
                                   "slad.nav_error_m"};

std::string HowMany(int moved) {
  return moved == 0   ? std::string("as in the flight")
         : moved == 1 ? std::string("1 limit changed")
                      : std::to_string(moved) + " limits changed";
}

/// What pressing begins, and what was done of it: only what was judged under these very limits
/// counts, however it came to be played.
std::string BeginWords(const RedecideRun& run, const RedecidedShare& share) {
  if (share.judged < share.maps && share.judged > 0) {
    return "Re-decide all; " + std::to_string(share.judged) + " of " + std::to_string(share.maps) +
           " maps done";
  }
  return run.took_s() && share.judged > 0
             ? "Decided again in " + Fixed(*run.took_s(), 0) + " s; once more"
             : "Re-decide whole flight";
}

/// "Stop at 41 %, 12 s left" while it runs, else the button that begins it.
void DrawRun(const EngineSnapshot& snap, const Rect& button, const RedecidedShare& share,
             RedecideRun& run, UiFrame& ui) {
  const Style& s = ui.style;
  Ask(ui, run.Follow(snap.session->source, ui.ui_time_s));
  if (run.running() && LimitsMoved(snap) == 0) {
    Ask(ui, run.Stop());  // the limits were put back: there is nothing to decide again
  }
  ButtonLook look;
  look.font = s.medium;
  if (run.running()) {
    std::string words = "Stop at " + Fixed(run.share() * 100, 0) + " %";
    if (const auto left_s = run.left_s()) {
      words += ", " + Fixed(std::ceil(*left_s), 0) + " s left";
    }
    if (DrawButton(ui, "redecide_stop", button, words, look)) {
      Ask(ui, run.Stop());
    }
    const float done = button.w * static_cast<float>(run.share());
    FillRect(Canvas(), {button.x, button.bottom() - s.Px(3), done, s.Px(3)}, s.palette.text1);
    return;
  }
  look.enabled = FollowsRecord(snap.session->role) && LimitsMoved(snap) > 0;
  look.reason = FollowsRecord(snap.session->role) ? "Change a limit first" : "Only of a log";
  if (DrawButton(ui, "redecide", button, BeginWords(run, share), look)) {
    Ask(ui, run.Begin(snap.session->source, ui.ui_time_s));
  }
}

}  // namespace

int LimitsMoved(const EngineSnapshot& snap) {
  if (!FollowsRecord(snap.session->role)) {
    return 0;
  }
  return static_cast<int>(
      std::count_if(SettingTable().begin(), SettingTable().end(), [&](const SettingInfo& info) {
        return GetSetting(snap.session->settings, info.name) !=
               GetSetting(snap.session->recorded_settings, info.name);
      }));
}

const char* FlightWord(const FlightRecord* record) {
  return record != nullptr && record->has_settings ? "Recorded" : "As opened";
}

void DrawRedecidePanel(const EngineSnapshot& snap, const FlightRecord* record, const Rect& rect,
                       ReviewState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const bool log = FollowsRecord(snap.session->role);
  const Settings& recorded = snap.session->recorded_settings;
  const Rect content =
      DrawPanelFrame(ui, rect, log ? "Re-decide" : "Limits",
                     {{log ? HowMany(LimitsMoved(snap)) : "in force", 0, false, false}});
  const float pad = s.Px(12);
  const float recorded_x = content.right() - s.Px(116), field_x = content.right() - s.Px(100);
  const float head = content.y + s.Px(8);
  DrawText(ui, s.caption, p.text2, content.x + pad, head, "Limit");
  if (log) {
    DrawText(ui, s.caption, p.text2, recorded_x, head, FlightWord(record), Align::kRight);
    DrawText(ui, s.caption, p.text2, content.right() - pad, head, "Re-decided", Align::kRight);
  }
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
    row.pending = log && row.value != before;
    if (row.pending) {
      FillRect(Canvas(), {content.x, y + s.Px(2), s.Px(4), pitch - s.Px(4)}, p.white_mark);
    }
    DrawText(ui, row.pending ? s.medium : s.body, row.pending ? p.text1 : p.text2,
             content.x + s.Px(16), middle, info->label);
    if (log) {
      DrawText(ui, s.body, p.text2, recorded_x, middle, FormatSetting(*info, before),
               Align::kRight);
    }
    DrawValueField(ui, {field_x, y + s.Px(2), s.Px(88), pitch - s.Px(4)}, row,
                   snap.session->preview_settings, state.fields, FieldKeys::kOwn);
    y += pitch;
  }
  DrawRun(snap, {rect.x + pad, rect.bottom() - s.Px(8) - button_h, rect.w - 2 * pad, button_h},
          state.digest.redecided, state.redecide, ui);
}

}  // namespace palace
