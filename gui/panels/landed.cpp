// After touchdown: where it landed, where the record is, and what can be done next.
#include <filesystem>

#include "engine/model/mission/landed_place.h"
#include "gui/panels/fly_panels.h"
#include "gui/widgets/button.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

/// "Touched down 0.46 m off centre by estimate, 0.55 m in truth; 0.50 m was allowed for."
std::string Touchdown(const MissionStatus& m, double nav_error_m) {
  std::string text;
  const auto add = [&](const std::optional<double>& miss_m, const char* by) {
    if (miss_m) {
      text += (text.empty() ? "Touched down " : ", ") + Fixed(*miss_m, 2) + " m " + by;
    }
  };
  add(m.touchdown_miss_m, "off centre by estimate");
  add(m.touchdown_miss_true_m, m.touchdown_miss_m ? "in truth" : "off centre in truth");
  text = text.empty() ? "Where it touched down is not known."
                      : text + "; " + Fixed(nav_error_m, 2) + " m was allowed for.";
  return text +
         (m.touchdown_sink_mps ? " Sink rate " + Fixed(*m.touchdown_sink_mps, 2) + " m/s." : "");
}

/// The log's folder and file; the folder above them is the one that was asked for.
std::string LogWords(const SessionPart& session) {
  const bool record = FollowsRecord(session.role);
  const std::filesystem::path log(record ? session.source.name : session.recording_path);
  if (log.empty()) {
    return record ? "This is a record." : "This flight is not recorded.";
  }
  return (record ? "This is the record " : "Log ") +
         (log.parent_path().filename() / log.filename()).string();
}

/// One of the three ways on.
struct NextStep {
  const char* item;
  const char* label;
  NextFlight::Kind kind;
  bool needs_log;
};
/// What ends nothing stands where Hold here stood: a press may come late.
constexpr NextStep kSteps[] = {
    {"open_report", "Open report", NextFlight::Kind::kOpenReport, true},
    {"review_flight", "Review flight", NextFlight::Kind::kReview, true},
    {"new_flight", "New flight", NextFlight::Kind::kFlyAgain, false},
};

void DrawSteps(const EngineSnapshot& snap, const Rect& row, UiFrame& ui) {
  const Style& s = ui.style;
  const float gap = s.Px(8);
  const float width = std::floor((row.w - 2 * gap) / 3);
  float x = row.x;
  for (const NextStep& step : kSteps) {
    const bool record = FollowsRecord(snap.session->role);
    const bool way_out = record && !step.needs_log && !ui.after_review.label.empty();
    ButtonLook look;
    look.flat = true;
    look.enabled =
        way_out || (!record && (!step.needs_log || !snap.session->recording_path.empty()));
    look.reason = record ? "This is a record" : "Nothing was recorded";
    look.hint = way_out ? std::string_view(ui.after_review.hint) : std::string_view();
    const std::string_view label = way_out ? std::string_view(ui.after_review.label) : step.label;
    if (DrawButton(ui, step.item, {x, row.y, width, row.h}, label, look)) {
      ui.intents.push_back(UiAction(NextFlight{step.kind, snap.session->recording_path}));
    }
    x += width + gap;
  }
}

}  // namespace

void DrawLandedPanel(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const MissionStatus& m = snap.flight->mission;
  DrawPanelFrame(ui, rect, "Landed");
  const float x = rect.x + s.Px(12);
  const float width = rect.w - s.Px(24);
  const std::string site = m.armed ? m.armed->letter : std::string();
  const bool missed = MissedSite(m);
  DrawText(ui, s.readout, missed ? p.caution : p.text1, x, rect.y + s.Px(44),
           site.empty() ? "Landed" : (missed ? "Not on site " : "Landed on site ") + site);
  const Rect row{x, rect.bottom() - s.Px(52), width, s.Px(40)};
  float y = rect.y + s.Px(72);
  // What the vehicle says, where and how high above the site.
  const std::string where =
      missed ? m.why + "." : Touchdown(m, snap.session->settings.slad.lander.nav_error_m);
  for (const std::string& words : {where, LogWords(*snap.session)}) {
    for (const std::string& line : WrapText(s.body, words, width)) {
      if (y + s.Px(10) > row.y) {
        break;
      }
      DrawText(ui, s.body, p.text2, x, y, line);
      y += s.Px(19);
    }
  }
  DrawSteps(snap, row, ui);
}

}  // namespace palace
