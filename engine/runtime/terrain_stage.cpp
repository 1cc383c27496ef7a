#include "engine/runtime/terrain_stage.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/median.h"
#include "engine/core/units.h"
#include "engine/slad/slad.h"

namespace palace {
namespace {

constexpr int kVerdictDivisor = 4;
constexpr int kDepthStride_px = 16;
constexpr int kMaxCellFactor = 16;
constexpr std::size_t kFiguresKept = 2;
constexpr double kWidestView = 2;  // views up to twice the map's width keep the set cell

}  // namespace

void TerrainStage::Reset() {
  cell_factor_ = 1;
  fusion_.Reset();
  scene_flags_.Reset();
  registry_.Reset();
  elevation_.reset();
  figures_.clear();
  input_ = {};
}

void TerrainStage::Add(const TerrainInput& input, const SladSettings& settings) {
  input_ = input;
  figures_.clear();
  FitCellToView(*input.range, settings);
  const SladSettings fitted = FittedToView(settings);
  elevation_ = settings.mode == SladMode::kModern
                   ? fusion_.Add(*input.range, input.X_WC, fitted)
                   : std::make_shared<const ElevationMap>(
                         ElevationFromRange(*input.range, input.X_WC, fitted));
  if (settings.mode == SladMode::kModern && input.left && input.right) {
    FlagFromPictures();
  }
}

void TerrainStage::FlagFromPictures() {
  auto flagged = std::make_shared<ElevationMap>(*elevation_);
  flagged->flags = scene_flags_.Add(
      {input_.left, input_.right, input_.range, input_.X_WC, input_.baseline_m}, flagged->geometry);
  elevation_ = std::move(flagged);
}

void TerrainStage::FitCellToView(const RangeMap& range, const SladSettings& settings) {
  std::vector<float> depths;
  for (int y = 0; y < range.depth_m.height(); y += kDepthStride_px) {
    for (int x = 0; x < range.depth_m.width(); x += kDepthStride_px) {
      if (std::isfinite(range.depth_m.at(x, y))) {
        depths.push_back(range.depth_m.at(x, y));
      }
    }
  }
  if (depths.empty() || settings.mode != SladMode::kModern ||
      settings.bounds != BoundsMode::kData) {
    cell_factor_ = 1;
    return;
  }
  const PinholeCamera& camera = range.camera;
  const double view_m = static_cast<double>(UpperMedian(depths)) *
                        std::max(camera.width / camera.fx_px, camera.height / camera.fy_px);
  const double map_m = std::min(settings.grid_rows, settings.grid_cols) * settings.cell_m;
  while (cell_factor_ < kMaxCellFactor && view_m > kWidestView * map_m * cell_factor_) {
    cell_factor_ *= 2;
  }
  // Back only well inside, so that a view near the border does not toggle the map.
  while (cell_factor_ > 1 && view_m < 0.8 * kWidestView * map_m * (cell_factor_ / 2)) {
    cell_factor_ /= 2;
  }
}

SladSettings TerrainStage::FittedToView(const SladSettings& settings) const {
  SladSettings fitted = settings;
  if (settings.mode == SladMode::kModern && settings.bounds == BoundsMode::kData) {
    fitted.cell_m *= cell_factor_;
  }
  return fitted;
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

const TerrainFigures& TerrainStage::FiguresFor(const SladSettings& settings) {
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

std::shared_ptr<const TerrainDecision> TerrainStage::Evaluate(const Settings& settings,
                                                              bool keep_letters) {
  PALACE_CHECK(has_map());
  auto decision = std::make_shared<TerrainDecision>();
  auto hazards = std::make_shared<HazardMaps>(
      JudgeTerrain(elevation_->geometry, FiguresFor(settings.slad), settings.slad));
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
      VerdictImage(*input_.range, input_.X_WC, *elevation_, *hazards, kVerdictDivisor));
  decision->hazards = std::move(hazards);
  return decision;
}

std::optional<LandingSite> TerrainStage::Recheck(const TerrainDecision& decision,
                                                 const LandingSite& site, const Settings& settings,
                                                 double heading_rad) const {
  SiteContext context = Context(settings);
  context.approach_heading_rad = heading_rad;
  return RecheckSite(*decision.elevation, *decision.hazards, decision.settings, site, context);
}

}  // namespace palace
