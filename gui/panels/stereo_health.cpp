// Stereo health: what the last pair says about the cameras themselves.
#include <string>
#include <vector>

#include "gui/panels/diagnose/diagnose.h"
#include "gui/widgets/icons.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

struct HealthRow {
  const char* name;
  std::string value;
  std::string limit;
  bool fine = true;
};

/// "max 0.50 px"; a ratio may be as much below 1 as above.
std::string LimitText(const LimitRow& limit) {
  return limit.id == LimitId::kExposure ? Fixed(1 / limit.limit, 2) + " to " + Fixed(limit.limit, 2)
                                        : "max " + LimitWords(limit);
}

/// The figure with its limit, and whether the engine calls it over.
HealthRow WithLimit(const EngineSnapshot& snap, LimitId id, const char* name, std::string value) {
  const LimitRow* limit = FindLimit(snap.flight->mission.limits, id);
  return {name, std::move(value), limit != nullptr ? LimitText(*limit) : "",
          limit == nullptr || !limit->over};
}

std::string PictureWords(const StereoQuality& q) {
  return q.suspect_swapped                 ? "left and right look exchanged"
         : q.suspect_same                  ? "left and right are one picture"
         : q.suspect_covered               ? "one camera shows nothing"
         : q.left_frozen || q.right_frozen ? "a camera repeats its picture"
                                           : "two different views";
}

std::string Signed(double value, int decimals) {
  return (value > 0 ? "+" : "") + Fixed(value, decimals);
}

std::string AgreementWords(const RangeAgreement& a) {
  const std::string off = Signed(100 * (a.ratio - 1), 1);
  return a.pairs == 0 ? off : off + " % ± " + Fixed(300 * a.sigma, 1) + " %";
}

std::vector<HealthRow> RowsOf(const EngineSnapshot& snap) {
  const StereoQuality& q = snap.terrain->stereo_quality;
  const bool pictures_fine = !q.suspect_swapped && !q.suspect_same && !q.suspect_covered &&
                             !q.left_frozen && !q.right_frozen;
  return {
      {"Pictures", PictureWords(q), "", pictures_fine},
      {"Coverage", Fixed(100 * q.coverage, 0) + " %", ""},
      {"Median depth", Fixed(q.median_depth_m, 2) + " m", ""},
      {"Disparity sigma", Fixed(q.median_sigma_px, 3) + " px", ""},
      WithLimit(snap, LimitId::kRowError, "Row error", Fixed(q.row_error_px, 2) + " px"),
      {"Row shift, spread", Signed(q.row_shift_px, 2) + " px, " + Fixed(q.row_spread_px, 2) + " px",
       ""},
      WithLimit(snap, LimitId::kExposure, "Right over left brightness", Fixed(q.exposure_ratio, 2)),
      WithLimit(snap, LimitId::kRangeScale, "Range against the laser",
                AgreementWords(snap.terrain->range_agreement)),
  };
}

}  // namespace

void DrawStereoHealth(const EngineSnapshot& snap, const Rect& rect, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const std::shared_ptr<const RangeMap>& range = snap.terrain->range;
  // On the ground no pair is matched any more: what stands here is of the last one.
  const std::string age =
      range ? AgeText(SecondsBetween(range->time, snap.time) + ui.silent_s) + " old" : "";
  const Rect content = DrawPanelFrame(ui, rect, "Stereo health", {{age}});
  ui.items.Add("health/age", {rect.x, rect.y, rect.w, content.y - rect.y}, true, age);
  float y = content.y + s.Px(12);
  if (!range) {
    DrawText(ui, s.body, p.text2, content.x + s.Px(12), y, "No pair has been matched yet.");
    return;
  }
  const std::vector<HealthRow> rows = RowsOf(snap);
  const float pitch = RowPitch(s, rect.bottom() - s.Px(6) - y + s.Px(13), rows.size());
  const float limit_x = content.right() - s.Px(12);
  const float value_x = limit_x - s.Px(96);
  for (const HealthRow& row : rows) {
    if (y + s.Px(10) > rect.bottom()) {
      return;
    }
    DrawIcon(Canvas(), row.fine ? Icon::kNormal : Icon::kCaution, {content.x + s.Px(20), y},
             s.Px(12), row.fine ? p.text3 : p.caution);
    DrawText(ui, row.fine ? s.body : s.medium, row.fine ? p.text2 : p.text1, content.x + s.Px(34),
             y, row.name);
    DrawText(ui, s.body, p.text1, value_x, y, row.value, Align::kRight);
    DrawText(ui, s.caption, p.text3, limit_x, y, row.limit, Align::kRight);
    ui.items.Add(std::string("health/") + row.name, {content.x, y - s.Px(10), content.w, s.Px(20)},
                 row.fine, std::string(row.name) + " " + row.value);
    y += pitch;
  }
}

}  // namespace palace
