// Centre of Tune: the picture, the maps, and applied against preview.
#include <cmath>

#include "engine/core/hash.h"
#include "engine/core/units.h"
#include "gui/panels/arrival.h"
#include "gui/panels/fly_panels.h"
#include "gui/panels/tune/tune.h"
#include "gui/widgets/icons.h"
#include "gui/widgets/number_text.h"

namespace palace {
namespace {

std::string Signed(double value, int decimals) {
  return (value > 0 ? "+" : "") + Fixed(value, decimals);
}

/// "10" or "6.5": a limit without an idle zero.
std::string Short(double value) {
  return Fixed(value, std::abs(value - std::round(value)) < 0.05 ? 0 : 1);
}

/// One column of the strip: label, "before -> after", what changed.
struct Comparison {
  const char* label;
  std::string before;
  std::string after;
  std::string note;
};

std::vector<Comparison> CompareColumns(const TuneFacts& f) {
  const LandingSite* was = f.best_applied;
  const LandingSite* is = f.best_shown;
  const auto radius = [](const LandingSite* site) {
    return site != nullptr ? Fixed(site->safe_distance_m, 1) + " m" : std::string("––");
  };
  const auto count = [](const TerrainDecision* d) {
    return d != nullptr ? std::to_string(d->selection.sites.size()) : std::string("––");
  };
  const double area_change = SafeArea(f.shown) - SafeArea(f.applied);
  std::string moved = "no change";
  if (was != nullptr && is != nullptr && was->id != is->id) {
    moved = "moved " + Fixed((was->p_WS - is->p_WS).head<2>().norm(), 1) + " m";
  } else if ((was == nullptr) != (is == nullptr)) {
    moved = is == nullptr ? "lost" : "found";
  }
  const bool both = was != nullptr && is != nullptr;
  return {{"Safe area", Fixed(SafeArea(f.applied), 0) + " m²", Fixed(SafeArea(f.shown), 0) + " m²",
           std::isfinite(area_change) ? Signed(area_change, 0) + " m²" : ""},
          {"Best site", LetterOf(was), LetterOf(is), moved},
          {"Its clear radius", radius(was), radius(is),
           both ? Signed(is->safe_distance_m - was->safe_distance_m, 1) + " m" : ""},
          {"Sites found", count(f.applied), count(f.shown), ""}};
}

void DrawComparison(UiFrame& ui, float x, const Rect& strip, const Comparison& c, bool previewing) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  const float y = strip.y + strip.h * 0.25f;
  const float step = strip.h * 0.26f;
  DrawText(ui, s.caption, p.text2, x, y, c.label);
  float at = x;
  if (previewing) {
    at += DrawText(ui, s.body, p.text2, at, y + step, c.before) + s.Px(12);
    DrawIcon(Canvas(), Icon::kArrowRight, {at, y + step}, s.Px(14), p.text2);
    at += s.Px(12);
  }
  DrawText(ui, s.medium, p.text1, at, y + step, previewing ? c.after : c.before);
  if (previewing) {
    DrawText(ui, s.caption, p.text2, x, y + 2 * step, c.note);
  }
}

void DrawChip(UiFrame& ui, const Rect& box, bool on, const char* title, const std::string& line,
              const SladSettings& limits) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  FillRect(Canvas(), box, on ? p.hover : p.control, s.Fine(4));
  StrokeRect(Canvas(), box, on ? p.white_mark : p.line, s.Fine(1), s.Fine(4));
  const float x = box.x + s.Px(12);
  const float step = box.h * 0.27f;
  const float y = box.y + box.h * 0.23f;
  DrawText(ui, s.medium, on ? p.text1 : p.text2, x, y, title);
  DrawText(ui, s.caption, on ? p.text1 : p.text2, x, y + step, line);
  const std::string words = "Slope " + Short(limits.limits.max_slope_deg) + "°, rough " +
                            Short(limits.limits.max_deviation_m * 100) + " cm";
  DrawText(ui, s.caption, on ? p.text1 : p.text2, x, y + 2 * step, words);
}

}  // namespace

void DrawTuneCamera(const EngineSnapshot& snap, const Rect& rect, TuneState& state, UiFrame& ui) {
  const TuneFacts facts = FactsOf(snap);
  const Arrival arrival = ArrivalOf(snap, ChannelId::kCameraLeft, ui.silent_s);
  const Rect content =
      DrawPanelFrame(ui, rect, "Left camera",
                     {{arrival.age, 0, true, arrival.late()}, {arrival.rate, 0, true, false}});
  LeftPicture look;
  look.decision = facts.shown;
  look.ghost = facts.previewing ? facts.applied : nullptr;
  look.preview = facts.previewing;
  look.probe = &state.probe;
  look.plate = LaserPlate(snap, ui.silent_s);
  DrawLeftPicture(ui, content, snap, look, state.overlay);
}

void DrawTuneMap(const EngineSnapshot& snap, const Rect& rect, MapKind kind, bool colour_bar,
                 TuneState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const TuneFacts facts = FactsOf(snap);
  const std::optional<Cell> at = facts.shown != nullptr && facts.shown->hazards
                                     ? ProbeCell(state.probe, facts.shown->hazards->geometry)
                                     : std::nullopt;
  MapSource source = ShownMap(snap, ui.silent_s);
  source.cursor = at;
  source.site = facts.best_shown;
  MapView view = MakeMapView(kind, source, ui.textures);
  MapMarks marks;
  marks.probe = at;
  marks.sites = facts.shown != nullptr ? &facts.shown->selection.sites : nullptr;
  if (const LandingSite* best = facts.best_shown) {
    marks.selected = *best;
  }
  MarkLanding(snap, marks);
  const float below = colour_bar ? s.Px(42) : s.Px(8);
  const float side = std::floor(std::min(rect.w, rect.h - s.Px(28) - below));
  // On a small map the chip would hide what it speaks of; the picture beside it carries one.
  view.preview = facts.previewing && side >= s.Px(160);
  marks.letters = side >= s.Px(150);
  MapAnswer answer;
  if (colour_bar) {
    answer = DrawMapPanel(ui, rect, side, view, marks, state.map_drag);
  } else {
    const Rect content = DrawPanelFrame(
        ui, rect, view.title,
        {{view.limit.label, s.palette.text2, false, false}, {view.value, 0, true, false}});
    answer = DrawMapPicture(ui, {std::round(content.centre().x - side / 2), content.y, side, side},
                            view, marks);
  }
  if (answer.tick) {  // as a slider does: at once, or as a preview
    ui.intents.push_back(CommandAction(SetSetting{answer.tick->setting, answer.tick->value}));
  }
  OfferProbe(view, answer, state.probe);
  if (answer.discards) {
    ui.intents.push_back(CommandAction(DiscardSettings{}));
  }
}

void DrawCompareStrip(const EngineSnapshot& snap, const Rect& rect, TuneState& state, UiFrame& ui) {
  const Style& s = ui.style;
  const TuneFacts facts = FactsOf(snap);
  DrawPanelBackground(ui, rect, "Applied and preview");
  const bool narrow = rect.h < s.Px(100);
  const float pad = s.Px(12), chip = s.Px(narrow ? 156 : 168);
  const Rect applied{rect.x + pad, rect.y + pad, chip, rect.h - 2 * pad};
  const std::string name =
      LimitsName(state, snap.session->settings) + " · " + ShortHash(snap.session->settings_hash);
  DrawChip(
      ui, applied, !facts.previewing, "Applied",
      TextWidth(s.caption, name) < chip - 2 * pad ? name : ShortHash(snap.session->settings_hash),
      snap.session->settings.slad);
  const Rect preview{applied.right() + s.Px(8), applied.y, chip, applied.h};
  DrawChip(ui, preview, facts.previewing, "Preview",
           facts.previewing
               ? std::to_string(facts.pending) +
                     (facts.pending == 1 ? " change, not applied" : " changes, not applied")
               : "same as applied",
           snap.session->preview_settings.slad);
  const std::vector<Comparison> columns = CompareColumns(facts);
  const float left = preview.right() + s.Px(24);
  const float w = (rect.right() - pad - left) / static_cast<float>(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string& widest = columns[i].before + columns[i].after;
    const bool fits = TextWidth(s.medium, widest) + s.Px(30) < w;
    DrawComparison(ui, left + w * static_cast<float>(i), rect, columns[i],
                   facts.previewing && fits);
  }
}

}  // namespace palace
