#include "engine/slad/sites/site_evaluation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "engine/model/site_standing.h"
#include "engine/slad/hazards/hazard_layers.h"
#include "engine/slad/hazards/hidden_things.h"
#include "engine/slad/hazards/touchdown.h"
#include "engine/slad/sites/site_figures.h"
#include "engine/slad/terrain/air_seen.h"

namespace palace {
namespace {

/// Noise that a height may owe: of the site's plane, of what stands in the corridor.
constexpr double kSigmas = 3;
constexpr double kThinMargin_m = 1;         // a wire's height is told to some 0.6 m
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
      const double limit = settings.limits.max_deviation_m + kSigmas * std::sqrt(variance);
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

struct ColumnRange {
  int first, last;
};

/// Columns of a row that the corridor may touch, a cell too many rather than one too few. It begins
/// at `origin_east_m`, from where `north_m` counts.
ColumnRange CorridorInRow(const GridGeometry& g, double origin_east_m, const Eigen::Vector2d& along,
                          double north_m, double length_m, double half_width_m) {
  double west_m = -HUGE_VAL, east_m = HUGE_VAL;
  // low <= north * a + east * b <= high
  const auto limit = [&](double a, double b, double low, double high) {
    const double from = low - north_m * a, to = high - north_m * a;
    if (std::abs(b) > 1e-9) {
      west_m = std::max(west_m, std::min(from / b, to / b));
      east_m = std::min(east_m, std::max(from / b, to / b));
    } else if (from > g.cell_m || to < -g.cell_m) {
      east_m = -HUGE_VAL;
    }
  };
  limit(along.x(), along.y(), 0, length_m);
  limit(along.y(), -along.x(), -half_width_m, half_width_m);
  const double origin_m = g.EastOfCol(0) - origin_east_m;
  const double first = std::floor((west_m - origin_m) / g.cell_m) - 1;
  const double last = std::ceil((east_m - origin_m) / g.cell_m) + 1;
  return {static_cast<int>(std::clamp(first, 0.0, g.cols - 1.0)),
          last < 0 ? -1 : static_cast<int>(std::min(last, g.cols - 1.0))};
}

/// How far out the slope from the site is at the vehicle's height; NaN for a vehicle nobody knows.
double SlopeLength(const SiteContext& context, const LandingSite& site) {
  const double tangent = std::tan(std::clamp(context.glide_slope_rad, 0.02, 1.55));
  const double height_m = site.p_WS.z() - context.p_WB.z();
  return std::isnan(height_m) ? height_m : std::max(0.0, height_m / tangent);
}

/// Nothing known reaches the skids of a vehicle that flies level at its present height, as wide as
/// its rotor, to where an approach begins. What stands within the clear radius is a hazard anyway.
bool LevelWayIsClear(const Approach& approach, const ElevationMap& map,
                     const SladSettings& settings, const SiteContext& context,
                     const LandingSite& site) {
  const GridGeometry& g = map.geometry;
  const Eigen::Vector2d from = context.p_WB.head<2>(), p_WS = site.p_WS.head<2>();
  const Eigen::Vector2d way = p_WS + approach.length_m * approach.from - from;
  const double length_m = way.norm();
  const double skids_m = HeightFromDown(context.p_WB.z() + settings.lander.skid_centre_B().z());
  if (!(length_m > g.cell_m) || std::isnan(skids_m)) {
    return true;
  }
  const Eigen::Vector2d along = way / length_m;
  const double half_width_m = settings.lander.rotor_diameter_m / 2;
  for (int r = 0; r < g.rows; ++r) {
    const double north_m = g.NorthOfRow(r);
    const ColumnRange columns =
        CorridorInRow(g, from.y(), along, north_m - from.x(), length_m, half_width_m);
    for (int c = columns.first; c <= columns.last; ++c) {
      const bool stands = map.state.at(r, c) != CellState::kUnknown &&
                          static_cast<double>(map.height_m.at(r, c)) > skids_m;
      const bool hangs = !map.thin_top_m.empty() &&
                         static_cast<double>(map.thin_top_m.at(r, c)) + kThinMargin_m > skids_m;
      if ((stands || hangs) &&
          (Eigen::Vector2d(north_m, g.EastOfCol(c)) - p_WS).norm() > site.clear_radius_m) {
        return false;
      }
    }
  }
  return true;
}

/// The corridor is clear, and the level way to where it begins.
bool IsReachable(const Approach& approach, const ElevationMap& map, const SladSettings& settings,
                 const SiteContext& context, const LandingSite& site) {
  return IsClear(approach, map, settings, site) &&
         LevelWayIsClear(approach, map, settings, context, site);
}

double Known(float value) { return static_cast<double>(value); }

/// What nine tenths of the cells reach; new ground at the rim must not pass for old.
template <typename Value>
Value OfMost(std::vector<Value>& values, Value without) {
  if (values.empty()) {
    return without;
  }
  const auto tenth = values.begin() + static_cast<std::ptrdiff_t>(values.size() / kNewCellsOneIn);
  std::nth_element(values.begin(), tenth, values.end());
  return *tenth;
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
      map.geometry.cell_m > settings.lander.max_rock_size_m) {
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
                         const SladSettings& settings, const SiteContext& context, Cell cell) {
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
  site.corridor_clear = !flown || IsReachable(*flown, map, settings, context, site);
  site.clear_approaches = ClearApproaches(map, settings, context, site);
  return site;
}

std::optional<Approach> ApproachFlown(const SladSettings& settings, const SiteContext& context,
                                      const LandingSite& site) {
  const Eigen::Vector2d to_site = (site.p_WS - context.p_WB).head<2>();
  // One that is nearer than where the slope begins at its height backs away to there.
  const double length_m = std::max(to_site.norm(), SlopeLength(context, site));
  if (!(length_m > settings.lander.radius_m())) {
    return std::nullopt;  // nobody knows the vehicle, or it is on the ground
  }
  const double heading_rad = std::isnan(context.approach_heading_rad)
                                 ? std::atan2(to_site.y(), to_site.x())
                                 : context.approach_heading_rad;
  return Approach{
      {-std::cos(heading_rad), -std::sin(heading_rad)}, length_m, context.glide_slope_rad};
}

std::uint8_t ClearApproaches(const ElevationMap& map, const SladSettings& settings,
                             const SiteContext& context, const LandingSite& site) {
  // To the end of the map for a vehicle nobody knows.
  const GridGeometry& g = map.geometry;
  const double slope_m = SlopeLength(context, site);
  const double length_m = std::isnan(slope_m) ? g.cell_m * std::hypot(g.rows, g.cols) : slope_m;
  unsigned clear = 0;
  for (unsigned sector = 0; sector < 8; ++sector) {
    const double bearing_rad = sector * std::numbers::pi / 4;
    const Approach approach{
        {std::cos(bearing_rad), std::sin(bearing_rad)}, length_m, context.glide_slope_rad};
    clear |= IsReachable(approach, map, settings, context, site) ? 1U << sector : 0U;
  }
  return static_cast<std::uint8_t>(clear);
}

bool IsClear(const Approach& approach, const ElevationMap& map, const SladSettings& settings,
             const LandingSite& site) {
  if (std::isnan(site.height_m.value)) {
    return true;
  }
  const double length_m = approach.length_m;
  const Eigen::Vector2d& along = approach.from;
  const double tangent = std::tan(std::min(approach.glide_slope_rad, 1.55));
  const GridGeometry& g = map.geometry;
  const double half_width_m = settings.lander.rotor_diameter_m / 2;
  const double lander_radius_m = settings.lander.radius_m();
  // Rows that the corridor reaches, one too many on each side.
  const double end_m = length_m * along.x(), aside_m = half_width_m * std::abs(along.y());
  const double row_of_site = (g.NorthOfRow(0) - site.p_WS.x()) / g.cell_m;
  const double first_row = row_of_site - (std::max(0.0, end_m) + aside_m) / g.cell_m;
  const double last_row = row_of_site - (std::min(0.0, end_m) - aside_m) / g.cell_m;
  const int first = static_cast<int>(std::clamp(std::floor(first_row) - 1, 0.0, g.rows - 1.0));
  const int last = static_cast<int>(std::clamp(std::ceil(last_row) + 1, 0.0, g.rows - 1.0));
  for (int r = first; r <= last; ++r) {
    const double north_m = g.NorthOfRow(r) - site.p_WS.x();
    const ColumnRange columns =
        CorridorInRow(g, site.p_WS.y(), along, north_m, length_m, half_width_m);
    const float* height_m = map.height_m.row(r);
    const float* thin_top_m = map.thin_top_m.empty() ? nullptr : map.thin_top_m.row(r);
    for (int c = columns.first; c <= columns.last; ++c) {
      const double east_m = g.EastOfCol(c) - site.p_WS.y();
      const double s = north_m * along.x() + east_m * along.y();
      const double rise_m = static_cast<double>(height_m[c]) - site.height_m.value;
      const double free_m = (s - lander_radius_m) * tangent + settings.limits.max_deviation_m;
      const bool is_thin =
          thin_top_m &&
          static_cast<double>(thin_top_m[c]) + kThinMargin_m - site.height_m.value > free_m;
      // Asked first, for few cells rise so far.
      if (!(rise_m > free_m) && !is_thin) {
        continue;
      }
      const double aside = std::abs(north_m * along.y() - east_m * along.x());
      if (s <= site.clear_radius_m || s > length_m || aside > half_width_m) {
        continue;
      }
      if (is_thin) {
        return false;  // nobody flies under a wire, either
      }
      if (map.state.at(r, c) == CellState::kUnknown) {
        continue;
      }
      const double noise_m = kSigmas * std::sqrt(static_cast<double>(map.variance_m2.at(r, c)));
      if (rise_m - noise_m > free_m) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace palace
