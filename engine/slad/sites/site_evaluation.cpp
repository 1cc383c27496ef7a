#include "engine/slad/sites/site_evaluation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/core/median.h"
#include "engine/model/site_standing.h"
#include "engine/slad/hazards/hazard_layers.h"
#include "engine/slad/hazards/hidden_things.h"
#include "engine/slad/hazards/site_figures.h"
#include "engine/slad/hazards/touchdown.h"
#include "engine/slad/terrain/air_seen.h"

namespace palace {
namespace {

constexpr std::size_t kNewCellsOneIn = 10;  // of the clear radius: new ground at the rim
constexpr double kTenthCutOff = 0.687;      // of a disc's radius: a chord there cuts a tenth off

/// Visits the cells of the map whose centre lies within `radius_m` of the cell's.
template <typename Visit>
void ForDisc(const GridGeometry& g, Cell centre, double radius_m, Visit visit) {
  const int reach = static_cast<int>(radius_m / g.cell_m);
  for (int dr = -reach; dr <= reach; ++dr) {
    for (int dc = -reach; dc <= reach; ++dc) {
      const Cell cell{centre.row + dr, centre.col + dc};
      if ((dr * dr + dc * dc) * g.cell_m * g.cell_m <= radius_m * radius_m) {
        visit(cell);
      }
    }
  }
}

struct SitePlane {
  double height_m = std::numeric_limits<double>::quiet_NaN();
  double north_gradient = 0;
  double east_gradient = 0;
  double cell_variance_m2 = std::numeric_limits<double>::quiet_NaN();
};

SitePlane FitSitePlane(const ElevationMap& map, const SladSettings& settings, Cell centre) {
  const GridGeometry& g = map.geometry;
  const double radius_m = std::max(settings.lander.radius_m(), kLeastDisc_cells * g.cell_m);
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  SitePlane plane;
  for (int pass = 0; pass < 2; ++pass) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    double variance_sum = 0;
    int count = 0;
    ForDisc(g, centre, radius_m, [&](Cell cell) {
      if (!g.Contains(cell) || map.state.at(cell) == CellState::kUnknown) {
        return;
      }
      const double variance = static_cast<double>(map.variance_m2.at(cell));
      const double z = static_cast<double>(map.Measured().at(cell));
      const Eigen::Vector3d basis(1, (centre.row - cell.row) * g.cell_m,
                                  (cell.col - centre.col) * g.cell_m);
      const double limit = settings.limits.max_deviation_m + kCorridorSigmas * std::sqrt(variance);
      if (pass == 1 && std::abs(z - basis.dot(x)) > limit) {
        return;
      }
      const double w = 1 / (variance + kVarianceFloor_m2);
      normal += w * basis * basis.transpose();
      right += w * z * basis;
      variance_sum += variance;
      ++count;
    });
    const Eigen::LDLT<Eigen::Matrix3d> solver(normal);
    if (count < 3 || !(solver.rcond() > 1e-12)) {
      return plane;
    }
    x = solver.solve(right);
    plane = {x[0], x[1], x[2], variance_sum / count};
  }
  return plane;
}

Eigen::Vector2d PixelFromPoint(const SiteContext& context, const Eigen::Vector3d& p_WS) {
  const Eigen::Vector3d p_CS = context.X_WC.Inverse() * p_WS;
  const PinholeCamera& camera = context.camera;
  if (!(p_CS.z() > 0) || camera.width == 0) {
    return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  return {camera.fx_px * p_CS.x() / p_CS.z() + camera.cx_px,
          camera.fy_px * p_CS.y() / p_CS.z() + camera.cy_px};
}

double Known(float value) { return static_cast<double>(value); }

/// What nine tenths of the cells reach; new ground at the rim must not pass for old.
template <typename Value>
Value OfMost(std::vector<Value>& values, Value without) {
  return values.empty() ? without : UpperQuantile(values, kNewCellsOneIn);
}

/// Whether hardly anything too high or too deep can be hidden within the clear radius: what was not
/// seen is not safe, however little noise there is.
bool NothingHides(const ElevationMap& map, const SladSettings& settings, const LandingSite& site) {
  return map.geometry.cell_m <= settings.lander.max_rock_size_m &&
         !(site.hidden_things > kMostHidden);
}

/// Surveys and thesis mode have no frames to wait for.
bool FramesAgree(const SladSettings& settings, const SiteContext& context,
                 const LandingSite& site) {
  return settings.mode == SladMode::kThesis || context.camera.width == 0 ||
         site.frames_fused >= std::min(kFramesToConfirm, settings.fusion.frames_fused);
}

/// How far up over most of the site's clear radius the camera looks from where the glide slope to
/// the site begins, at its height now and tilted as now: of a look it shows the most air. Over the
/// far rim the view ends first, over the near one what is far enough off to be looked at.
double AirSeenFromSlope(const SiteContext& context, const LandingSite& site) {
  const PinholeCamera& camera = context.camera;
  const Eigen::Vector3d top_W =
      context.X_WC.R * Eigen::Vector3d(0, -camera.cy_px / camera.fy_px, 1);
  const double height_m = site.p_WS.z() - context.X_WC.p.z();
  const double slope_m = SlopeLength(context, site);
  const double far_m = slope_m + kTenthCutOff * site.clear_radius_m;
  const double near_m = slope_m - kTenthCutOff * site.clear_radius_m;
  const double in_view_m = height_m - far_m * std::max(0.0, top_W.z()) / top_W.head<2>().norm();
  const Eigen::Vector3d axis_W = context.X_WC.R.col(2);
  const double not_near_m =
      height_m - (kNearestThin_m - near_m * axis_W.head<2>().norm()) / axis_W.z();
  return axis_W.z() > 0 ? std::min(in_view_m, not_near_m) : in_view_m;
}

/// LandingSite::look_height_m, to a sixteenth of the vehicle's height above the site.
double LookHeight(const ElevationMap& map, const SladSettings& settings, const SiteContext& context,
                  const LandingSite& site) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const double height_m = site.p_WS.z() - context.p_WB.z();
  if (map.narrow.empty() || context.camera.width == 0 || site.confirmed || !(height_m > 0) ||
      map.geometry.cell_m > settings.lander.max_rock_size_m || IsMarked(site)) {
    return none;
  }
  const bool air_missing = site.air_seen_m < kLeastAirSeen_m;
  if (air_missing && !(site.air_on_way_m >= kLeastAirSeen_m)) {
    return none;
  }
  const NarrowView view{map.narrow, map.geometry.cell_m, settings.limits.max_deviation_m};
  const auto settles = [&](double nearer) {
    return nearer * nearer * site.height_m.three_sigma < settings.limits.max_deviation_m &&
           HiddenFromNearer(view, site.cell, site.clear_radius_m, nearer, kMostHidden) <=
               kMostHidden;
  };
  const double skids_m = settings.lander.skid_centre_B().z();
  const double highest_m = height_m - skids_m - kLeastWayToLook_m;
  if (settles(1)) {
    // Only the air was not looked at, and where the slope begins it is.
    const double look_m = std::floor(highest_m);
    return air_missing && look_m > kConfirmHeight_m ? look_m : none;
  }
  // From nearer never less is seen: half as many heights are left with each look.
  constexpr int kHalvings = 4;
  double settled = 0, step = 1;
  for (int halving = 0; halving < kHalvings; ++halving) {
    step /= 2;
    settled += settles(settled + step) ? step : 0;
  }
  const double look_m = std::floor(settled * height_m - skids_m);
  return look_m > kConfirmHeight_m && look_m <= highest_m ? look_m : none;
}

}  // namespace

LandingSite EvaluateSite(const ElevationMap& map, const HazardMaps& hazards,
                         const SladSettings& settings, const SiteContext& context,
                         const ApproachCorridors& corridors, Cell cell) {
  const GridGeometry& g = map.geometry;
  LandingSite site;
  site.map_time = map.time;
  site.cell = cell;
  const SitePlane plane = FitSitePlane(map, settings, cell);
  site.p_WS = {g.NorthOfRow(cell.row), g.EastOfCol(cell.col), -plane.height_m};
  site.normal_W = Eigen::Vector3d(-plane.north_gradient, -plane.east_gradient, -1).normalized();
  site.pixel = PixelFromPoint(context, site.p_WS);
  site.height_m = {plane.height_m, 3 * std::sqrt(plane.cell_variance_m2)};
  TakeFigures(hazards, settings, cell, site);
  site.touchdown = OddsOfTouchdown(map, hazards, settings, site);
  site.clear_radius_m = settings.lander.clear_radius_m();
  site.clearance_m = site.safe_distance_m - site.clear_radius_m;
  double age_sum_s = 0;
  std::vector<std::uint16_t> frames;  // of the measured cells
  std::vector<float> air_m;
  ForDisc(g, cell, site.clear_radius_m, [&](Cell near) {
    if (!g.Contains(near) || map.state.at(near) != CellState::kMeasured) {
      ++site.unknown_cells;
      return;
    }
    frames.push_back(map.frame_count.at(near));
    if (!map.air_seen_to_m.empty()) {
      const float top_m = map.air_seen_to_m.at(near);
      air_m.push_back(std::isnan(top_m) ? -HUGE_VALF : top_m);
    }
    age_sum_s += map.age_s.empty() ? 0 : Known(map.age_s.at(near));
    site.flags |= hazards.flags.empty() ? std::uint8_t{0} : hazards.flags.at(near);
  });
  site.age_s = frames.empty() ? std::numeric_limits<double>::quiet_NaN()
                              : age_sum_s / static_cast<double>(frames.size());
  site.frames_fused = OfMost<std::uint16_t>(frames, 0);
  const double air_seen_m = Known(OfMost(air_m, kUnknownValue)) - plane.height_m;
  site.air_seen_m = air_seen_m < 0 ? 0 : air_seen_m;  // NaN stays NaN
  if (!air_m.empty()) {
    site.air_on_way_m = AirSeenFromSlope(context, site);
  }
  const bool likely = settings.mode == SladMode::kThesis ||
                      site.safe_probability >= settings.limits.min_safe_probability;
  site.confirmed = likely && site.height_m.three_sigma < settings.limits.max_deviation_m &&
                   FramesAgree(settings, context, site) && NothingHides(map, settings, site) &&
                   !(site.air_seen_m < kLeastAirSeen_m);
  site.look_height_m = LookHeight(map, settings, context, site);
  site.distance_m = (context.p_WB - site.p_WS).head<2>().norm();
  const std::optional<Approach> flown = ApproachFlown(settings, context, site);
  site.corridor_clear = !flown || corridors.IsReachable(*flown, context, site);
  site.clear_approaches = corridors.ClearSectors(context, site);
  return site;
}

}  // namespace palace
