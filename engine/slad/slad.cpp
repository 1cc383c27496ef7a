#include "engine/slad/slad.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/core/units.h"
#include "engine/slad/approach_obstacle.h"
#include "engine/slad/map_hash.h"
#include "engine/slad/sites/verdict_image.h"

namespace palace {
namespace {

constexpr int kVerdictDivisor = 4;
constexpr std::size_t kFiguresKept = 2;

}  // namespace

void Slad::Forget(SiteNames names) {
  view_cell_ = {};
  fusion_.Reset();
  scene_flags_.Reset();
  registry_.Reset(names);
  input_ = {};
  elevation_.reset();
  figures_.clear();
}

void Slad::Add(const SladInput& input, const SladSettings& settings) {
  input_ = input;
  figures_.clear();
  const SladSettings fitted = view_cell_.Fit(*input.view.range, settings);
  elevation_ =
      fusion_.Add(*input.view.range, fitted, kept_, input.view.left.get(), input.view.right.get());
  if (settings.mode == SladMode::kModern && input.view.left && input.view.right) {
    FlagFromPictures();
  }
}

void Slad::Take(ElevationMap map) {
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  Forget(SiteNames::kAnew);
  input_.p_WB.setConstant(kNowhere);
  elevation_ = std::make_shared<const ElevationMap>(std::move(map));
}

void Slad::FlagFromPictures() {
  auto flagged = std::make_shared<ElevationMap>(*elevation_);
  SceneView view = input_.view;
  view.registered = fusion_.registered();
  flagged->flags = scene_flags_.Add(view, flagged->geometry);
  flagged->thin_top_m = scene_flags_.ThinTops();
  elevation_ = std::move(flagged);
}

SiteContext Slad::Context(const Settings& settings) const {
  SiteContext context;
  context.p_WB = input_.p_WB;
  context.time = elevation_->time;
  context.glide_slope_rad = Rad(settings.mission.glide_slope_deg);
  if (const auto& range = input_.view.range) {
    context.X_WC = range->pose->X_WC;
    context.camera = range->camera;
  }
  return context;
}

const TerrainFigures& Slad::FiguresFor(const SladSettings& settings) {
  const auto kept = std::find_if(figures_.begin(), figures_.end(),
                                 [&](const TerrainFigures& f) { return f.HoldFor(settings); });
  if (kept != figures_.end()) {
    return *kept;
  }
  if (figures_.size() == kFiguresKept) {
    figures_.erase(figures_.begin());
  }
  return figures_.emplace_back(MeasureTerrain(*elevation_, settings));
}

std::shared_ptr<const TerrainDecision> Slad::Decide(const Settings& settings, Letters letters) {
  PALACE_CHECK(has_map());
  auto decision = std::make_shared<TerrainDecision>();
  auto hazards = std::make_shared<HazardMaps>(
      JudgeTerrain(elevation_->geometry, FiguresFor(settings.slad), settings.slad));
  decision->map_time = elevation_->time;
  decision->elevation = elevation_;
  decision->settings = settings.slad;
  decision->settings_hash = HashOf(settings);
  decision->map_hash = HashOfMaps(*elevation_, *hazards);
  SiteRegistry copy = registry_;
  copy.GiveNoLetters();
  SiteRegistry& registry = letters == Letters::kOfRecord ? registry_ : copy;
  decision->selection = registry.Select(*elevation_, *hazards, settings.slad, Context(settings));
  if (input_.view.range) {
    decision->verdict = std::make_shared<ImageU8>(
        VerdictImage(*input_.view.range, *elevation_, *hazards, kVerdictDivisor));
  }
  decision->hazards = std::move(hazards);
  return decision;
}

std::optional<LandingSite> Slad::Recheck(const TerrainDecision& decision, const LandingSite& site,
                                         const Settings& settings, double heading_rad) const {
  SiteContext context = Context(settings);
  context.approach_heading_rad = heading_rad;
  std::optional<LandingSite> now =
      RecheckSite(*decision.elevation, *decision.hazards, decision.settings, site, context);
  if (now) {
    now->in_approach = FindApproachObstacle(*decision.elevation, decision.settings, context, *now);
  }
  return now;
}

}  // namespace palace
