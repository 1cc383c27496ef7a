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

// Farther apart, what lies between two points was not measured.
constexpr double kGap_s = 1;
constexpr double kMapGap_s = 2;

/// A figure of the samples against the seconds of the flight, broken where they are farther apart.
template <typename Sample, typename Keep>
PlotTrace TraceOf(const EngineSnapshot& snap, const FlightRecord* record,
                  const std::vector<Sample>& samples, double Sample::*figure, double gap_s,
                  Keep keep) {
  PlotTrace trace;
  for (const Sample& sample : samples) {
    if (!keep(sample)) {
      continue;
    }
    const auto t = static_cast<float>(FlightSeconds(snap, record, sample.time));
    if (!trace.points.empty() && static_cast<double>(t - trace.points.back().x) > gap_s) {
      trace.points.push_back({trace.points.back().x, NAN});
    }
    trace.points.push_back({t, static_cast<float>(sample.*figure)});
  }
  return trace;
}

/// A figure of every sample.
template <typename Sample>
PlotTrace TraceOfAll(const EngineSnapshot& snap, const FlightRecord* record,
                     const std::vector<Sample>& samples, double Sample::*figure) {
  return TraceOf(snap, record, samples, figure, kGap_s, [](const Sample&) { return true; });
}

/// A figure that only a map measures: of the samples with which one came, where they tell it.
template <typename Sample>
PlotTrace TraceOfMaps(const EngineSnapshot& snap, const FlightRecord* record,
                      const std::vector<Sample>& samples, double Sample::*figure) {
  const bool told = std::any_of(samples.begin(), samples.end(),
                                [](const Sample& sample) { return sample.new_map; });
  return told ? TraceOf(snap, record, samples, figure, kMapGap_s,
                        [](const Sample& sample) { return sample.new_map; })
              : TraceOfAll(snap, record, samples, figure);
}

const std::vector<HistorySample>& HistoryOf(const EngineSnapshot& snap) {
  static const std::vector<HistorySample> none;
  return snap.flight->history ? *snap.flight->history : none;
}

bool IsRecorded(const FlightRecord* record) {
  return record != nullptr && !record->samples.empty();
}

float TopOf(const PlotView& view, float at_least) {
  for (const PlotTrace& series : view.series) {
    for (const ImVec2& point : series.points) {
      at_least = std::isfinite(point.y) ? std::max(at_least, point.y * 1.03f) : at_least;
    }
  }
  return RoundTop(at_least);
}

/// The axes, and what the flight did.
void FillFlight(const EngineSnapshot& snap, const FlightRecord* record, PlotTrace flown,
                const Palette& p, PlotView& view) {
  view.series = {std::move(flown)};
  view.series[0].width = 2.2f;
  view.series[0].colour = p.text1;
  view.x_min = 0;
  view.x_max = static_cast<float>(std::max(1.0, DurationOf(snap, record)));
  view.x_axis = PlotView::XAxis::kClock;
  view.now = std::min(view.x_max, static_cast<float>(snap.session->source.position_s));
}

/// By the record, or as it was seen here.
PlotTrace HeightFlown(const EngineSnapshot& snap, const FlightRecord* record) {
  return IsRecorded(record)
             ? TraceOfAll(snap, record, record->samples, &FlightRecordSample::height_above_site_m)
             : TraceOfAll(snap, record, HistoryOf(snap), &HistorySample::height_above_site_m);
}
PlotTrace ClearRadiusFlown(const EngineSnapshot& snap, const FlightRecord* record) {
  return IsRecorded(record)
             ? TraceOfMaps(snap, record, record->samples, &FlightRecordSample::best_safe_distance_m)
             : TraceOfMaps(snap, record, HistoryOf(snap), &HistorySample::best_safe_distance_m);
}

/// ", 12 s old": no map was made since.
std::string AgeWords(const EngineSnapshot& snap, const FlightRecord* record) {
  const RecordedProposal* proposal =
      IsOfRecordAlone(snap, record) ? record->ProposalAt(snap.time) : nullptr;
  const auto& map = snap.terrain->applied;
  const double age_s = proposal != nullptr ? SecondsBetween(proposal->map_time, snap.time)
                       : map               ? SecondsBetween(map->map_time, snap.time)
                                           : NAN;
  return age_s > kMapGap_s ? ", " + Duration(age_s) + " old" : std::string();
}

/// What stands above the plot of the clear radius is what it shows at this time: of the flight the
/// record's own figure, where there is one.
double ClearRadiusInFlight(const EngineSnapshot& snap, const FlightRecord* record) {
  if (IsRecorded(record)) {
    const FlightRecordSample* sample = record->SampleAt(snap.time);
    return sample != nullptr ? sample->best_safe_distance_m : NAN;
  }
  const LandingSite* best = BestSite(snap, snap.terrain->OfRecord().get());
  return best != nullptr ? best->safe_distance_m : NAN;
}

/// "4.4 m"; unknown stands without its unit.
std::string Metres(double value_m) {
  return Fixed(value_m, 1) + (std::isfinite(value_m) ? " m" : "");
}

}  // namespace

ReviewPlots MakeReviewPlots(const EngineSnapshot& snap, const FlightRecord* record,
                            const Palette& p) {
  ReviewPlots plots;
  PlotView& height = plots.height;
  height.name = "height";
  height.title = "Height above site";
  height.unit = "m";
  height.current = Fixed(snap.flight->mission.height_above_site_m, 1) + " m";
  FillFlight(snap, record, HeightFlown(snap, record), p, height);
  height.series[0].colour = p.safe;
  height.y_max = TopOf(height, 10);

  PlotView& clear = plots.clear_radius;
  clear.name = "clear_radius";
  clear.title = "Clear radius of best site";
  clear.unit = "m";
  FillFlight(snap, record, ClearRadiusFlown(snap, record), p, clear);
  if (snap.terrain->redecided) {
    clear.series[0].colour = p.text2;
    clear.series.insert(
        clear.series.begin(),
        TraceOf(snap, record, *snap.terrain->redecided, &RedecidedSample::best_safe_distance_m,
                kMapGap_s, [](const RedecidedSample&) { return true; }));
    clear.series[0].width = 2.2f;
    clear.series[0].colour = p.text1;
    clear.series[0].stroke = PlotTrace::Stroke::kDashed;
  }
  clear.y_max = TopOf(clear, 4);
  const double flown_m = ClearRadiusInFlight(snap, record);
  clear.current = Metres(flown_m);
  if (snap.terrain->recorded) {
    // Of half a map nothing is compared.
    const LandingSite* now =
        snap.terrain->maps_to_rebuild > 0 ? nullptr : BestSite(snap, snap.terrain->applied.get());
    clear.current = Fixed(flown_m, 1) + " / " + Metres(now != nullptr ? now->safe_distance_m : NAN);
    clear.unit = "m, recorded / re-decided";
  }
  if (std::isfinite(flown_m)) {
    clear.current += AgeWords(snap, record);
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
