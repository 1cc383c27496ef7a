#include <algorithm>
#include <cmath>
#include <optional>

#include "gui/panels/fly_panels.h"
#include "gui/widgets/interact.h"
#include "gui/widgets/number_text.h"

namespace palace {

namespace {

constexpr float kPast_s = 40, kFuture_s = 24;
/// Of a flight that has landed: all of its last minute, and no future.
constexpr float kPastLanded_s = 60, kFutureLanded_s = 8;

using Member = double HistorySample::*;

bool HasLanded(const EngineSnapshot& snap) {
  return snap.flight->mission.state == MissionState::kLanded;
}

/// Samples of the flight; on the ground the estimate goes on drifting and means nothing more.
std::size_t SamplesFlown(const std::vector<HistorySample>& history) {
  std::size_t flown = history.size();
  while (flown > 0 && history[flown - 1].state == MissionState::kLanded) {
    --flown;
  }
  return flown;
}

/// What is plotted of the history: samples `first` to `end`, against the time `zero`, which is now
/// and after a landing the touchdown, so that the descent stays to be read.
struct Shown {
  Timestamp zero;
  std::size_t first, end;
  std::size_t flown;  ///< SamplesFlown
};

Shown ShownOf(const EngineSnapshot& snap) {
  const std::vector<HistorySample>& history = *snap.flight->history;
  const std::size_t flown = SamplesFlown(history);
  const bool landed = HasLanded(snap);
  const Timestamp zero = landed && flown > 0 ? history[flown - 1].time : snap.time;
  const auto from = [&](float s) {
    const Timestamp t = AddSeconds(zero, static_cast<double>(s));
    const auto at = std::lower_bound(
        history.begin(), history.end(), t,
        [](const HistorySample& sample, Timestamp time) { return sample.time < time; });
    return static_cast<std::size_t>(at - history.begin());
  };
  return {zero, from(landed ? -kPastLanded_s : -kPast_s),
          landed ? from(kFutureLanded_s) : history.size(), flown};
}

/// A snapshot, and what is plotted of it: found once a frame, for a long history is long to search.
struct Charted {
  const EngineSnapshot& snap;
  const Shown shown;
  explicit Charted(const EngineSnapshot& s) : snap(s), shown(ShownOf(s)) {}
  const HistorySample& At(std::size_t i) const { return (*snap.flight->history)[i]; }
};

PlotTrace SeriesOf(const Charted& charted, Member member, ImU32 colour, float width,
                   PlotTrace::Stroke stroke = PlotTrace::Stroke::kSolid) {
  PlotTrace series;
  series.colour = colour;
  series.width = width;
  series.stroke = stroke;
  const Shown& shown = charted.shown;
  for (std::size_t i = shown.first; i < shown.end; ++i) {
    const HistorySample& sample = charted.At(i);
    series.points.push_back({static_cast<float>(SecondsBetween(shown.zero, sample.time)),
                             static_cast<float>(sample.*member)});
  }
  return series;
}

/// The estimate in force, up to touchdown: thick.
PlotTrace Estimate(const Charted& charted, Member member, const Palette& p) {
  PlotTrace series = SeriesOf(charted, member, p.safe, 2.2f);
  const std::size_t first = charted.shown.first, flown = charted.shown.flown;
  series.points.resize(std::min(flown - std::min(first, flown), series.points.size()));
  series.dot_at_end = true;
  return series;
}

/// Half a band of which nothing is known: wider than any plot.
constexpr float kAnywhere = 1e5f;

/// With a band of three sigma as it was at each instant.
template <typename Sigma>
PlotTrace Estimate(const Charted& charted, Member member, const Palette& p, Sigma sigma) {
  PlotTrace series = Estimate(charted, member, p);
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    const double half = 3 * sigma(charted.At(charted.shown.first + i));
    series.band.push_back(std::isfinite(half) ? static_cast<float>(half) : kAnywhere);
  }
  return series;
}

/// Distances from one site say nothing of another: the lines begin where the one in question became
/// so.
void DropOtherSites(const Charted& charted, PlotView& view) {
  const std::size_t first = charted.shown.first;
  std::size_t from = charted.shown.end;
  std::optional<Eigen::Vector2d> site;
  for (; from > first; --from) {
    const Eigen::Vector2d at = charted.At(from - 1).p_WS.head<2>();
    if (!at.allFinite()) {
      continue;  // the position is not known, and so far nothing is told of another site
    }
    site = site.value_or(at);
    if (at != *site) {
      break;
    }
  }
  const std::size_t others = from - std::min(first, from);
  for (PlotTrace& series : view.series) {
    for (std::size_t i = 0; i < std::min(others, series.points.size()); ++i) {
      series.points[i].y = NAN;
    }
  }
}

PlotView Base(const EngineSnapshot& snap, const char* name, const char* title, const char* unit) {
  PlotView view;
  view.name = name;
  view.title = title;
  view.unit = unit;
  const bool landed = HasLanded(snap);
  view.x_min = landed ? -kPastLanded_s : -kPast_s;
  view.x_max = landed ? kFutureLanded_s : kFuture_s;
  for (float tick = view.x_min; tick <= view.x_max; tick += landed ? 20 : 10) {
    view.x_ticks.push_back(tick);
  }
  view.now = 0.0f;
  view.zero = landed ? "touchdown" : view.zero;
  return view;
}

/// An unknown value stands without its unit.
std::string Unit(double value, const char* unit) { return std::isfinite(value) ? unit : ""; }

/// Rounded up to where a tick falls, so that the axis is calm.
float RoundUp(float value, float step) { return std::ceil(value / step) * step; }

float Largest(const std::vector<PlotTrace>& all, float at_least) {
  for (const PlotTrace& series : all) {
    for (const ImVec2& point : series.points) {
      at_least = std::isfinite(point.y) ? std::max(at_least, point.y) : at_least;
    }
  }
  return at_least;
}

/// Widens the axis, by whole steps, until everything plotted lies on it: what climbs, or goes
/// wrong, leaves no plot.
void HoldAll(PlotView& view, float step) {
  for (const PlotTrace& series : view.series) {
    for (const ImVec2& point : series.points) {
      if (std::isfinite(point.y) && point.y > view.y_max) {
        view.y_max = RoundUp(point.y, step);
      } else if (std::isfinite(point.y) && point.y < view.y_min) {
        view.y_min = -RoundUp(-point.y, step);
      }
    }
  }
}

/// A series whose values are worked out from each sample.
template <typename Get>
PlotTrace Derived(const Charted& charted, ImU32 colour, PlotTrace::Stroke stroke, Get get) {
  PlotTrace series = SeriesOf(charted, &HistorySample::laser_m, colour, 1.5f, stroke);
  const std::size_t first = charted.shown.first;
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    series.points[i].y = static_cast<float>(get(first + i));
  }
  return series;
}

using PositionMember = Eigen::Vector3d HistorySample::*;

/// Descent rate along a track: its change over the half second around each sample.
PlotTrace RateOf(const Charted& charted, PositionMember track, ImU32 colour,
                 PlotTrace::Stroke stroke) {
  const std::vector<HistorySample>& h = *charted.snap.flight->history;
  return Derived(charted, colour, stroke, [&h, track](std::size_t i) {
    const HistorySample& before = h[i >= 3 ? i - 3 : 0];
    const HistorySample& after = h[std::min(i + 2, h.size() - 1)];
    const double dt_s = SecondsBetween(before.time, after.time);
    // A jump in time is no rate.
    return dt_s > 0.1 && dt_s < 2 ? ((after.*track).z() - (before.*track).z()) / dt_s : NAN;
  });
}

/// What is still to be flown: down the slope, level over the site, straight down.
PlotTrace PlanAhead(const EngineSnapshot& snap, const Palette& p) {
  PlotTrace plan;
  plan.colour = p.text2;
  plan.stroke = PlotTrace::Stroke::kDashed;
  for (const PathProgress::Height& ahead : snap.flight->mission.path.ahead) {
    const auto t = static_cast<float>(ahead.in_s);
    if (t > kFuture_s) {
      break;
    }
    plan.points.push_back({t, static_cast<float>(ahead.height_m)});
  }
  return plan;
}

/// A limit as its row says; none while the row is not there or its limit unknown.
std::vector<PlotLimit> LimitLine(const EngineSnapshot& snap, LimitId id) {
  const LimitRow* row = FindLimit(snap.flight->mission.limits, id);
  if (row == nullptr || !std::isfinite(row->limit)) {
    return {};
  }
  using Kind = PlotLimit::Kind;
  const bool enforced = row->enforced_by != EnforcedBy::kNobody;
  return {{static_cast<float>(row->limit * row->shown_per_unit),
           !enforced       ? Kind::kInformation
           : row->is_least ? Kind::kLeast
                           : Kind::kMost,
           (enforced          ? "Limit "
            : HasLanded(snap) ? "Limit until touchdown: "
                              : "For information: ") +
               LimitWords(*row)}};
}

PlotView HeightPlot(const Charted& charted, const Palette& p, const HistorySample& now) {
  const EngineSnapshot& snap = charted.snap;
  using Stroke = PlotTrace::Stroke;
  PlotView view = Base(snap, "height", "Height above site", "m");
  view.series = {Estimate(charted, &HistorySample::height_above_site_m, p,
                          [](const HistorySample& h) { return h.estimate_sigma_m.z(); }),
                 SeriesOf(charted, &HistorySample::truth_height_m, p.truth, 1.5f, Stroke::kDotted),
                 SeriesOf(charted, &HistorySample::laser_m, p.laser, 1.5f),
                 SeriesOf(charted, &HistorySample::gps_height_m, p.gps, 1.5f),
                 SeriesOf(charted, &HistorySample::plan_height_m, p.text2, 1.5f, Stroke::kDashed)};
  if (!snap.flight->mission.path.ahead.empty()) {
    view.series.push_back(PlanAhead(snap, p));
  }
  const float top = Largest(view.series, 4);
  view.y_max = RoundUp(top * 1.05f, top > 20 ? 10 : (top > 8 ? 5 : 2));
  HoldAll(view, 1);
  view.current = Fixed(now.height_above_site_m, 1) + Unit(now.height_above_site_m, " m");
  return view;
}

/// When, against now, the distance from the centre was last put under its limit; 0: never.
float CentreLimitedSince(const Charted& charted) {
  float since = 0;
  bool found = false;
  const std::vector<HistorySample>& history = *charted.snap.flight->history;
  for (auto it = history.rbegin(); it != history.rend() && (it->centre_limited || !found); ++it) {
    if (it->centre_limited) {
      found = true;
      since = static_cast<float>(SecondsBetween(charted.shown.zero, it->time));
    }
  }
  return since;
}

PlotView DistancePlot(const Charted& charted, const Palette& p, const HistorySample& now) {
  const EngineSnapshot& snap = charted.snap;
  using Stroke = PlotTrace::Stroke;
  PlotView view = Base(snap, "distance", "Distance from site centre", "m");
  const double band = 3 * snap.flight->navigation.InForce().estimate.sigma_p_m.head<2>().norm();
  view.series = {
      Estimate(charted, &HistorySample::from_site_m, p,
               [](const HistorySample& h) { return h.estimate_sigma_m.head<2>().norm(); }),
      SeriesOf(charted, &HistorySample::from_site_truth_m, p.truth, 1.5f, Stroke::kDotted),
      SeriesOf(charted, &HistorySample::from_site_gps_m, p.gps, 1.5f)};
  view.limits = LimitLine(snap, LimitId::kFromCentre);
  for (PlotLimit& limit : view.limits) {
    limit.from_x = CentreLimitedSince(charted);
  }
  DropOtherSites(charted, view);
  const float top = Largest(view.series, view.limits.empty() ? 1 : 2 * view.limits.front().value);
  view.y_max = RoundUp(top * 1.05f, top > 8 ? 5 : (top > 3 ? 1 : 0.5f));
  // A band below what is shown is none that anybody knows.
  const bool known = std::isfinite(now.from_site_m) && !(band < 0.005);
  view.current = Fixed(now.from_site_m, 2) + (known ? " ± " + Fixed(band, 2) : "") +
                 Unit(now.from_site_m, " m");
  return view;
}

PlotView RatePlot(const Charted& charted, const Palette& p, const HistorySample& now) {
  const EngineSnapshot& snap = charted.snap;
  using Stroke = PlotTrace::Stroke;
  PlotView view = Base(snap, "rate", "Descent rate", "m/s");
  view.series = {Estimate(charted, &HistorySample::descent_rate_mps, p,
                          [](const HistorySample& h) { return h.descent_rate_sigma_mps; }),
                 RateOf(charted, &HistorySample::truth_p_WB, p.truth, Stroke::kDotted),
                 RateOf(charted, &HistorySample::gps_p_WB, p.gps, Stroke::kSolid)};
  view.y_min = -0.25f;
  view.limits = LimitLine(snap, LimitId::kDescentRate);
  view.y_max = RoundUp(1.2f * (view.limits.empty() ? 1.5f : view.limits.front().value), 0.5f);
  HoldAll(view, 0.5f);
  view.current = Fixed(now.descent_rate_mps, 2) + Unit(now.descent_rate_mps, " m/s");
  return view;
}

PlotView CoherencePlot(const Charted& charted, const Palette& p, const HistorySample& now) {
  const EngineSnapshot& snap = charted.snap;
  PlotView view = Base(snap, "coherence", "Tracker coherence", "0 to 1");
  view.series = {Estimate(charted, &HistorySample::coherence, p)};
  view.y_min = 0.4f;
  view.y_max = 1.0f;
  HoldAll(view, 0.2f);
  view.limits = LimitLine(snap, LimitId::kCoherence);
  view.current = Fixed(now.coherence, 2);
  return view;
}

PlotView ResidualPlot(const Charted& charted, const Palette& p, const HistorySample& now) {
  const EngineSnapshot& snap = charted.snap;
  PlotView view = Base(snap, "residual", "Vision residual", "σ");
  view.series = {Estimate(charted, &HistorySample::residual_sigma, p)};
  view.y_min = 0;
  view.y_max = 4;
  HoldAll(view, 2);
  view.limits = LimitLine(snap, LimitId::kResidual);
  view.current = Fixed(now.residual_sigma, 1) + Unit(now.residual_sigma, " σ");
  return view;
}

PlotView PathPlot(const Charted& charted, const Palette& p, const HistorySample& now) {
  const EngineSnapshot& snap = charted.snap;
  PlotView view = Base(snap, "path", "Off the planned path", "m");
  view.series = {Estimate(charted, &HistorySample::glide_deviation_m, p,
                          [](const HistorySample& h) { return h.estimate_sigma_m.norm(); })};
  view.y_max = 1.6f;
  HoldAll(view, 0.4f);
  view.limits = LimitLine(snap, LimitId::kOffPath);
  view.current = Fixed(now.glide_deviation_m, 2) + Unit(now.glide_deviation_m, " m");
  return view;
}

struct LegendEntry {
  const char* word;
  ImU32 colour;
  PlotTrace::Stroke stroke;
};

void DrawLegend(const EngineSnapshot& snap, const Rect& rect, float left_end, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  using Stroke = PlotTrace::Stroke;
  std::vector<LegendEntry> entries = {{"Limit", p.unsafe, Stroke::kDashed},
                                      {"Plan", p.text2, Stroke::kDashed},
                                      {"GPS", p.gps, Stroke::kSolid},
                                      {"Laser", p.laser, Stroke::kSolid},
                                      {"Estimate in force, ±3σ", p.safe, Stroke::kSolid}};
  if (snap.sensors->truth || snap.session->source.kind == SourceKind::kSimulation) {
    entries.insert(entries.begin() + 2, {"Truth, simulation only", p.truth, Stroke::kDotted});
  }
  float x = rect.right() - s.Px(12);
  const float y = rect.centre().y;
  for (const LegendEntry& entry : entries) {
    const float width = TextWidth(s.caption, entry.word);
    if (x - width - s.Px(30) < left_end) {
      return;
    }
    DrawText(ui, s.caption, p.text2, x, y, entry.word, Align::kRight);
    x -= width + s.Px(8);
    const ImVec2 a{x - s.Px(20), std::round(y)};
    const ImVec2 b{x, std::round(y)};
    if (entry.stroke == Stroke::kSolid) {
      Canvas()->AddLine(a, b, entry.colour, s.Fine(2));
    } else {
      const bool dotted = entry.stroke == Stroke::kDotted;
      const bool plan = entry.colour == p.text2;
      DashedLine(Canvas(), a, b, entry.colour, s.Fine(2),
                 s.Fine(dotted ? 2.0f : (plan ? 3.0f : 8.0f)),
                 s.Fine(dotted ? 3.0f : (plan ? 5.0f : 4.0f)));
    }
    x -= s.Px(20 + 18);
  }
}

}  // namespace

void DrawPlotTabs(const EngineSnapshot& snap, const Rect& rect, PlotTab& tab, UiFrame& ui) {
  const Style& s = ui.style;
  const Palette& p = s.palette;
  DrawPanelBackground(ui, rect, "Plot tabs");
  constexpr const char* kNames[] = {"Descent", "Maps"};
  float x = rect.x + s.Px(16);
  for (int i = 0; i < 2; ++i) {
    const bool on = (tab == PlotTab::kMaps) == (i == 1);
    const float width = TextWidth(s.body, kNames[i]);
    const Rect area{x - s.Px(12), rect.y, width + s.Px(24), rect.h};
    const Interaction in = Interact(ui, std::string("tab/") + kNames[i], area, 0, kNames[i]);
    DrawText(ui, on ? s.medium : s.body, on || in.hovered ? p.text1 : p.text2, x, rect.centre().y,
             kNames[i]);
    if (on) {
      FillRect(Canvas(), {x - s.Px(6), rect.bottom() - s.Px(3), width + s.Px(14), s.Px(3)},
               p.white_mark);
    }
    if (in.clicked) {
      tab = i == 1 ? PlotTab::kMaps : PlotTab::kDescent;
    }
    x += width + s.Px(28);
  }
  if (tab != PlotTab::kMaps) {
    DrawLegend(snap, rect, x, ui);
  }
}

std::array<PlotView, 6> DescentPlots(const EngineSnapshot& snap, const Palette& p) {
  const HistorySample& now = snap.flight->history->back();
  const Charted charted(snap);
  std::array plots = {HeightPlot(charted, p, now),   DistancePlot(charted, p, now),
                      RatePlot(charted, p, now),     CoherencePlot(charted, p, now),
                      ResidualPlot(charted, p, now), PathPlot(charted, p, now)};
  if (HasLanded(snap)) {
    for (PlotView& plot : plots) {  // what drifts on after the touchdown is no figure of it
      plot.current = "landed";
    }
  }
  return plots;
}

void DrawDescentPlotsPanel(const EngineSnapshot& snap, const std::array<Rect, 6>& rects,
                           PlotHover& hover, UiFrame& ui) {
  if (!snap.flight->history || snap.flight->history->empty()) {
    DrawPanelFrame(ui, rects[0], "No flight history yet");
    return;
  }
  BeginPlots(hover);
  const std::array<PlotView, 6> plots = DescentPlots(snap, ui.style.palette);
  for (std::size_t i = 0; i < plots.size(); ++i) {
    DrawPlot(ui, rects[i], plots[i], hover);
  }
}

}  // namespace palace
