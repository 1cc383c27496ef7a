// Plots of Review, over the whole flight.
#include <algorithm>
#include <cmath>

#include "gui/panels/review/review.h"
#include "gui/widgets/number_text.h"
#include "gui/widgets/plot.h"

namespace palace {
namespace {

/// The next of 2, 4, 10, 20, 40, 100 ...: its half is a round tick too.
float RoundTop(float top) {
  for (float decade = 1; decade < 1e6f; decade *= 10) {
    for (const float factor : {2.0f, 4.0f, 10.0f}) {
      if (top <= factor * decade) {
        return factor * decade;
      }
    }
  }
  return top;
}

/// A figure of each sample against the seconds of the flight.
template <typename Sample>
PlotTrace TraceOf(const EngineSnapshot& snap, const FlightRecord* record,
                  const std::vector<Sample>& samples, double Sample::*figure) {
  PlotTrace trace;
  for (const Sample& sample : samples) {
    trace.points.push_back({static_cast<float>(FlightSeconds(snap, record, sample.time)),
                            static_cast<float>(sample.*figure)});
  }
  return trace;
}

float TopOf(const PlotView& view, float at_least) {
  for (const PlotTrace& series : view.series) {
    for (const ImVec2& point : series.points) {
      at_least = std::isfinite(point.y) ? std::max(at_least, point.y * 1.03f) : at_least;
    }
  }
  return RoundTop(at_least);
}

/// The axes, and what the flight did: by its record, or as it was seen here.
void FillFlight(const EngineSnapshot& snap, const FlightRecord* record,
                double FlightRecordSample::*then, double HistorySample::*seen, const Palette& p,
                PlotView& view) {
  static const std::vector<HistorySample> no_history;
  const bool recorded = record != nullptr && !record->samples.empty();
  view.series = {
      recorded
          ? TraceOf(snap, record, record->samples, then)
          : TraceOf(snap, record, snap.flight->history ? *snap.flight->history : no_history, seen)};
  view.series[0].width = 2.2f;
  view.series[0].colour = p.text1;
  view.x_min = 0;
  view.x_max = static_cast<float>(std::max(1.0, DurationOf(snap, record)));
  view.time_axis = PlotView::TimeAxis::kClock;
  view.now = std::min(view.x_max, static_cast<float>(snap.session->source.position_s));
}

}  // namespace

ReviewPlots MakeReviewPlots(const EngineSnapshot& snap, const FlightRecord* record,
                            const Palette& p) {
  ReviewPlots plots;
  PlotView& height = plots.height;
  height.name = "height";
  height.title = "Height";
  height.unit = "m";
  height.current = Fixed(snap.flight->mission.height_above_site_m, 1) + " m";
  FillFlight(snap, record, &FlightRecordSample::height_above_site_m,
             &HistorySample::height_above_site_m, p, height);
  height.series[0].colour = p.safe;
  height.y_max = TopOf(height, 10);

  PlotView& clear = plots.clear_radius;
  clear.name = "clear_radius";
  clear.title = "Clear radius of best site";
  clear.unit = "m";
  FillFlight(snap, record, &FlightRecordSample::best_safe_distance_m,
             &HistorySample::best_safe_distance_m, p, clear);
  if (snap.terrain->redecided) {
    clear.series[0].colour = p.text2;
    clear.series.insert(clear.series.begin(), TraceOf(snap, record, *snap.terrain->redecided,
                                                      &RedecidedSample::best_safe_distance_m));
    clear.series[0].width = 2.2f;
    clear.series[0].colour = p.text1;
    clear.series[0].stroke = PlotTrace::Stroke::kDashed;
  }
  clear.y_max = TopOf(clear, 4);
  const LandingSite* best = BestSite(snap, snap.terrain->applied.get());
  const LandingSite* was = BestSite(snap, snap.terrain->recorded.get());
  clear.current = best != nullptr ? Fixed(best->safe_distance_m, 1) + " m" : "––";
  if (was != nullptr) {
    clear.current = Fixed(was->safe_distance_m, 1) + " / " + clear.current;
    clear.unit = "m, recorded / re-decided";
  }
  const double least_m = snap.session->settings.slad.lander.clear_radius_m();
  clear.limits = {
      {static_cast<float>(least_m), PlotLimit::Kind::kLeast, "min " + Fixed(least_m, 1) + " m"}};
  return plots;
}

void DrawReviewPlots(const ReviewPlots& plots, const Rect& rect, PlotHover& hover, UiFrame& ui) {
  BeginPlots(hover);
  const float gap = ui.style.Px(8), h = std::floor((rect.h - gap) / 2);
  DrawPlot(ui, {rect.x, rect.y, rect.w, h}, plots.height, hover);
  DrawPlot(ui, {rect.x, rect.y + h + gap, rect.w, rect.h - h - gap}, plots.clear_radius, hover);
}

}  // namespace palace
