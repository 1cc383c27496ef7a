#include "engine/runtime/terrain_stage.h"

#include <cmath>
#include <cstdio>

#include "engine/core/units.h"
#include "engine/slad/slad.h"

namespace palace {
namespace {

constexpr int kVerdictDivisor = 4;

std::string Sentence(const char* format, double value, double limit) {
  char text[120];
  std::snprintf(text, sizeof text, format, value, limit);
  return text;
}

}  // namespace

void TerrainStage::Reset() {
  fusion_.Reset();
  registry_.Reset();
  elevation_.reset();
  input_ = {};
}

void TerrainStage::Add(const TerrainInput& input, const SladSettings& settings) {
  input_ = input;
  elevation_ = settings.mode == SladMode::kModern
                   ? fusion_.Add(*input.range, input.X_WC, settings)
                   : std::make_shared<const ElevationMap>(
                         ElevationFromRange(*input.range, input.X_WC, settings));
}

SiteContext TerrainStage::Context(const Settings& settings) const {
  SiteContext context;
  context.p_WB = input_.p_WB;
  context.X_WC = input_.X_WC;
  context.camera = input_.range->camera;
  context.time = input_.range->time;
  context.glide_slope_rad = Rad(settings.mission.glide_slope_deg);
  return context;
}

std::shared_ptr<const TerrainDecision> TerrainStage::Evaluate(const Settings& settings,
                                                              bool keep_letters) {
  PALACE_CHECK(has_map());
  auto decision = std::make_shared<TerrainDecision>();
  auto hazards = std::make_shared<HazardMaps>(EvaluateHazards(*elevation_, settings.slad));
  decision->map_time = elevation_->time;
  decision->elevation = elevation_;
  decision->settings = settings.slad;
  decision->settings_hash = HashOf(settings);
  decision->map_hash = HashOfMaps(*elevation_, *hazards);
  decision->selection = SelectSites(*elevation_, *hazards, settings.slad, Context(settings));
  if (keep_letters) {
    registry_.Assign(decision->selection);
  } else {
    SiteRegistry copy = registry_;
    copy.Assign(decision->selection);
  }
  decision->verdict = std::make_shared<ImageU8>(
      VerdictImage(*input_.range, input_.X_WC, *hazards, kVerdictDivisor));
  decision->hazards = std::move(hazards);
  return decision;
}

std::optional<LandingSite> TerrainStage::Recheck(const TerrainDecision& decision,
                                                 const LandingSite& site,
                                                 const Settings& settings) const {
  return RecheckSite(*decision.elevation, *decision.hazards, decision.settings, site,
                     Context(settings));
}

std::string SiteObjection(const std::optional<LandingSite>& site, const SladSettings& settings) {
  if (!site) {
    return "the site left the map";
  }
  const double slope_deg = Deg(site->slope_rad.value);
  if (slope_deg > settings.max_slope_deg) {
    return Sentence("slope %.1f°, limit %.1f°", slope_deg, settings.max_slope_deg);
  }
  if (site->roughness_m.value > settings.max_deviation_m) {
    return Sentence("roughness %.1f cm, limit %.1f cm", site->roughness_m.value * 100,
                    settings.max_deviation_m * 100);
  }
  if (settings.mode == SladMode::kModern && site->step_m.value > settings.max_step_m) {
    return Sentence("step %.1f cm, limit %.1f cm", site->step_m.value * 100,
                    settings.max_step_m * 100);
  }
  if (site->safe_distance_m < site->clear_radius_m) {
    return Sentence("clear radius %.1f m, limit %.1f m", site->safe_distance_m,
                    site->clear_radius_m);
  }
  return {};
}

}  // namespace palace
