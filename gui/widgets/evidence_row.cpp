#include "gui/widgets/evidence_row.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "engine/model/size_words.h"
#include "gui/widgets/button.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

struct Metrics {
  float bar, wall, value_right, limit_right;
  float actor;  ///< who enforces the limit, right of the bar
};

/// `lasting`: some row says how long it must be over; its bars are shorter for it.
Metrics MetricsOf(const Style& s, bool narrow, bool lasting) {
  return narrow    ? Metrics{s.Px(34), s.Px(27), s.Px(178), s.Px(98), s.Px(52)}
         : lasting ? Metrics{s.Px(36), s.Px(30), s.Px(212), s.Px(128), s.Px(82)}
                   : Metrics{s.Px(60), s.Px(50), s.Px(212), s.Px(128), s.Px(56)};
}

/// "hold 0.4 s" of "hold" and "0.4 s, or 3 of 5 maps"; "hold" where there is no room for more.
std::string ActorWords(const Style& s, const EvidenceRow& row, bool narrow, float room) {
  const std::string words = row.enforcer + " " + row.lasts.substr(0, row.lasts.find(','));
  return narrow || row.lasts.empty() || TextWidth(s.caption, words) > room ? row.enforcer : words;
}

void DrawBar(UiFrame& ui, const Rect& track, float wall, const EvidenceRow& row) {
  const Style& s = ui.style;
  ImDrawList* dl = Canvas();
  FillRect(dl, track, s.palette.hover, s.Fine(1));
  if (!std::isfinite(row.share)) {
    return;
  }
  const float end = std::clamp(static_cast<float>(row.share) * wall, 0.0f, track.w);
  const Rect bar{track.x, track.y, std::max(end, s.Px(1)), track.h};
  if (row.over) {
    FillRect(dl, bar, s.palette.unsafe, s.Fine(1));
    Hatch(dl, bar, s.palette.window, s.Fine(2), s.Fine(6));
  } else {
    FillRect(dl, bar, s.palette.bar, s.Fine(1));
  }
  if (std::isfinite(row.share_3s) && row.share_3s > 0) {
    const float spread = static_cast<float>(row.share_3s) * wall;
    const float from = track.x + std::clamp(end - spread, 0.0f, track.w);
    const float to = track.x + std::clamp(end + spread, 0.0f, track.w);
    const float y = track.centre().y;
    const float cap = s.Fine(4);
    dl->AddLine({from, y}, {to, y}, s.palette.white_mark, s.Fine(1.3f));
    dl->AddLine({from, y - cap}, {from, y + cap}, s.palette.white_mark, s.Fine(1.3f));
    dl->AddLine({to, y - cap}, {to, y + cap}, s.palette.white_mark, s.Fine(1.3f));
  }
}

/// "0.58 m/s"; unknown stands without its unit.
std::string WithUnit(const EvidenceRow& row) {
  if (row.value == "––" || row.unit.empty()) {
    return row.value;
  }
  return row.value + (row.unit == "°" ? "" : " ") + row.unit;
}

/// "< 2.0 cm" for "under 2.0 cm", where there is little room.
std::string Short(const std::string& words) {
  constexpr std::string_view kUnder = "under ";
  return words.rfind(kUnder, 0) == 0 ? "< " + words.substr(kUnder.size()) : words;
}

/// "Wind 2.1 m/s max 8 m/s, guard"; where there is a spread, it carries the unit.
std::string FullName(const EvidenceRow& row) {
  const std::string figure = row.spread.empty() ? WithUnit(row) : row.value + " " + row.spread;
  return row.name + " " + figure + " " + row.limit +
         (row.enforcer.empty() ? "" : ", " + row.enforcer) +
         (row.enforcer.empty() || row.lasts.empty() ? "" : " after " + row.lasts) +
         (row.age.empty() ? "" : "; " + row.age);
}

}  // namespace

EvidenceRow RowOf(const LimitRow& limit) {
  const std::string unit = limit.unit;
  const std::string gap = unit == "°" || unit.empty() ? "" : " ";
  const double value = limit.value * limit.shown_per_unit;
  const double most = limit.limit * limit.shown_per_unit;
  const double spread = limit.three_sigma * limit.shown_per_unit;
  const bool enforced = limit.enforced_by != EnforcedBy::kNobody;
  EvidenceRow row;
  row.name = limit.label;
  row.value = FixedAgainst(value, most, limit.over, limit.decimals);
  row.unit = unit;
  row.over = limit.over;
  if (const double below = KnownBelow(limit) * limit.shown_per_unit; !std::isnan(below)) {
    row.value = "under " + Fixed(below, limit.decimals);
  } else if (std::isfinite(value) && spread > 0) {
    row.spread = "± " + Fixed(spread, limit.decimals) + gap + unit;
  }
  if (!enforced) {
    row.limit = EnforcedByWord(limit.enforced_by);
    return row;
  }
  row.limit =
      (limit.is_least ? "min " : "max ") +
      Fixed(most, unit.empty() ? limit.decimals
                               : std::min(DecimalsOf(most, 0), std::max(limit.decimals, 2))) +
      gap + unit;
  row.enforcer = EnforcedByWord(limit.enforced_by);
  row.lasts = limit.lasts;
  row.share = ShareUsed(limit);
  row.share_3s = spread / most;
  return row;
}

namespace {

void DrawRows(UiFrame& ui, const Rect& rect, std::span<const EvidenceRow> rows, bool narrow,
              const Metrics& m) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const float height = EvidenceRowHeight(s, narrow);
  float y = rect.y;
  for (std::size_t i = 0; i < rows.size(); ++i, y += height) {
    const EvidenceRow& row = rows[i];
    const Rect area{rect.x, y, rect.w, height};
    const float middle = y + height / 2;
    const ImU32 ink = row.age.empty() ? p.text1 : p.text3;
    float right = rect.right() - m.value_right;
    if (!row.spread.empty() && !narrow) {
      right -= DrawText(ui, s.body, p.text2, right, middle, row.spread, Align::kRight) + s.Px(4);
      right -= DrawText(ui, s.medium, ink, right, middle, row.value, Align::kRight);
    } else {
      right -= DrawText(ui, s.medium, ink, right, middle,
                        narrow ? Short(WithUnit(row)) : WithUnit(row), Align::kRight);
    }
    const float name_x = rect.x + s.Px(12);
    const std::string name = FitWords(s.body, row.name, right - s.Px(6) - name_x);
    DrawText(ui, s.body, p.text2, name_x, middle, name);
    ui.items.Add("evidence/" + row.name, area, true, FullName(row));
    if ((name != row.name || !row.lasts.empty()) &&
        Interact(ui, "evidence/" + row.name, area, kPassive).hovered) {
      DrawTooltip(ui, FullName(row));
    }
    if (row.enforcer.empty()) {
      DrawText(ui, s.caption, p.text3, rect.right() - s.Px(12), middle, row.limit, Align::kRight);
      continue;
    }
    DrawText(ui, s.caption, p.text3, rect.right() - m.limit_right, middle, row.limit,
             Align::kRight);
    const float bar_x = rect.right() - m.actor - m.bar;
    const float end = rect.right() - s.Px(12);
    if (!row.age.empty()) {
      DrawText(ui, s.caption, p.text2, end, middle, row.age, Align::kRight);
      continue;
    }
    DrawBar(ui, {bar_x, std::round(middle - s.Px(8) / 2), m.bar, s.Px(8)}, m.wall, row);
    FillRect(Canvas(), {bar_x + m.wall - s.Px(1), y + s.Px(2), s.Px(2), height - s.Px(4)},
             p.white_mark);
    DrawText(ui, s.caption, p.text3, end, middle,
             ActorWords(s, row, narrow, end - s.Px(6) - bar_x - m.bar), Align::kRight);
  }
}

Metrics MetricsFor(const std::vector<EvidenceRow>& rows, const Style& s, bool narrow) {
  return MetricsOf(s, narrow, std::any_of(rows.begin(), rows.end(), [](const EvidenceRow& row) {
                     return !row.lasts.empty();
                   }));
}

}  // namespace

std::size_t RowsBeyond(const Rect& area, std::size_t rows, const Style& style, bool narrow) {
  const float fit = std::floor(std::max(area.h, 0.0f) / EvidenceRowHeight(style, narrow));
  return rows - std::min(rows, static_cast<std::size_t>(std::max(fit, 1.0f)));
}

std::string RowsBeyondWords(std::size_t beyond) {
  return beyond == 0 ? "" : "+" + std::to_string(beyond) + (beyond == 1 ? " row" : " rows");
}

void DrawScrolledRows(UiFrame& ui, std::string_view name, const Rect& area,
                      const std::vector<EvidenceRow>& rows, bool narrow, RowScroll& scroll) {
  const Style& s = ui.style;
  const std::size_t beyond = RowsBeyond(area, rows.size(), s, narrow);
  if (beyond > 0) {
    const TabGroup group = std::exchange(ui.tab.group, kViewTabs);  // no step on the way to approve
    const Interaction in = Interact(ui, name, area, kAllSteps);
    ui.tab.group = group;
    scroll.first -= static_cast<int>(in.wheel) + in.step_up;
  }
  scroll.first = std::clamp(scroll.first, 0, static_cast<int>(beyond));
  const std::size_t shown = rows.size() - beyond;
  DrawRows(ui, area, std::span(rows).subspan(static_cast<std::size_t>(scroll.first), shown), narrow,
           MetricsFor(rows, s, narrow));
  if (beyond > 0) {
    const float unit = area.h / static_cast<float>(rows.size());
    FillRect(Canvas(),
             {area.right() - s.Px(6), area.y + unit * static_cast<float>(scroll.first), s.Px(4),
              unit * static_cast<float>(shown)},
             s.palette.strong_line, s.Fine(2));
  }
}

}  // namespace palace
