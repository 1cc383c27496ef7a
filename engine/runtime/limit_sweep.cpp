#include "engine/runtime/limit_sweep.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/check.h"
#include "engine/model/mission/mission_status.h"
#include "engine/slad/hazards/hazard_maps.h"
#include "engine/slad/sites/site_registry.h"

namespace palace {
namespace {

constexpr int kSteps = 24;   // over the usual range
constexpr int kHalves = 24;  // at most, of all changes of the best place together

/// Judges the map again and again.
class Judge {
 public:
  explicit Judge(const SweepRequest& request) : request_(request), settings_(request.settings) {
    std::vector<RecordedPlace> places;
    for (const LandingSite& site : request.decision->selection.sites) {
      places.push_back({.id = site.id, .letter = site.letter, .north_east_m = site.p_WS.head<2>()});
    }
    registry_.GoOnWith(places, request.decision->settings);
    registry_.GiveNoLetters();
    mission_.refused_sites = request.refused;
  }

  SweptValue At(double value) {
    PALACE_CHECK(SetSettingValue(settings_, request_.limit->name, value).ok());
    const ElevationMap& map = *request_.decision->elevation;
    if (!figures_ || !figures_->HoldFor(settings_.slad)) {
      figures_ = MeasureTerrain(map, settings_.slad);
    }
    const HazardMaps hazards = JudgeTerrain(map.geometry, *figures_, settings_.slad);
    SiteRegistry registry = registry_;
    const SiteSelection selection = registry.Select(map, hazards, settings_.slad, request_.context);
    SweptValue swept{
        .value = value,
        .safe_area_m2 = hazards.safe_cells * map.geometry.cell_m * map.geometry.cell_m};
    if (const LandingSite* best = mission_.BestStanding(selection.sites)) {
      swept.best_id = best->id;
      swept.best = best->letter;
      swept.best_clear_m = best->safe_distance_m;
    }
    return swept;
  }

 private:
  const SweepRequest& request_;
  Settings settings_;
  SiteRegistry registry_;
  MissionStatus mission_;  ///< that knows what was refused
  std::optional<TerrainFigures> figures_;
};

std::vector<double> EvenSteps(const SettingInfo& limit, double in_force) {
  const double low = std::min(limit.soft_min, in_force), high = std::max(limit.soft_max, in_force);
  std::vector<double> values;
  for (int i = 0; i <= kSteps; ++i) {
    values.push_back(ClampSetting(limit, low + (high - low) * i / kSteps));
  }
  values.push_back(in_force);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// A value between two neighbours with another best place, where the screen would show another
/// number; nothing: there is none left. The pair nearest to `in_force` first.
std::optional<double> NextHalf(const SettingInfo& limit, const LimitSweep& sweep, double in_force) {
  const std::vector<SweptValue>& values = sweep.values;
  const double shown = std::pow(10.0, -limit.decimals) / limit.shown_per_unit;
  std::optional<double> next;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double low = values[i - 1].value, high = values[i].value;
    const double half = ClampSetting(limit, (low + high) / 2);
    const bool differs = !SameBest(values[i - 1], values[i]);
    if (differs && high - low > shown * 1.5 && half > low && half < high &&
        (!next || std::abs(half - in_force) < std::abs(*next - in_force))) {
      next = half;
    }
  }
  return next;
}

}  // namespace

LimitSweep SweepLimit(const SweepRequest& request, const std::function<bool()>& goes_on) {
  PALACE_CHECK(request.limit != nullptr && MaySweep(*request.limit));
  const SettingInfo& limit = *request.limit;
  const double in_force = GetSetting(request.settings, limit.name);
  LimitSweep sweep{limit.name, request.decision->map_time, request.settings, {}};
  Judge judge(request);
  for (const double value : EvenSteps(limit, in_force)) {
    if (!goes_on()) {
      sweep.values.clear();
      return sweep;
    }
    sweep.values.push_back(judge.At(value));
  }
  for (int halves = 0; halves < kHalves && goes_on(); ++halves) {
    const std::optional<double> half = NextHalf(limit, sweep, in_force);
    if (!half) {
      break;
    }
    const auto at = std::find_if(sweep.values.begin(), sweep.values.end(),
                                 [&](const SweptValue& swept) { return swept.value > *half; });
    sweep.values.insert(at, judge.At(*half));
  }
  return sweep;
}

}  // namespace palace
