#include "engine/slad/sites/approach_corridors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palace {
namespace {

constexpr double kThinMargin_m = 1;  // a wire's height is told to some 0.6 m

struct ColumnRange {
  int first, last;
};

/// Columns of a row that the corridor may touch, a cell too many rather than one too few. It begins
/// at `origin_east_m`, from where `north_m` counts. None where it passes beside the map.
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
  return {static_cast<int>(std::clamp(first, 0.0, static_cast<double>(g.cols))),
          last < 0 ? -1 : static_cast<int>(std::min(last, g.cols - 1.0))};
}

/// The highest that is no NaN; -infinity where there is none.
double Highest(const GridF& height_m, int row) {
  float highest_m = -HUGE_VALF;
  for (int c = 0; c < height_m.cols(); ++c) {
    const float at_m = height_m.at(row, c);
    highest_m = at_m > highest_m ? at_m : highest_m;
  }
  return static_cast<double>(highest_m);
}

/// Unknown cells count too: they may have a height.
std::vector<double> HighestOfRows(const ElevationMap& map) {
  std::vector<double> top_m(static_cast<std::size_t>(map.height_m.rows()));
  for (int r = 0; r < map.height_m.rows(); ++r) {
    const double thin_m =
        map.thin_top_m.empty() ? -HUGE_VAL : Highest(map.thin_top_m, r) + kThinMargin_m;
    top_m[static_cast<std::size_t>(r)] = std::max(Highest(map.height_m, r), thin_m);
  }
  return top_m;
}

}  // namespace

double SlopeLength(const SiteContext& context, const LandingSite& site) {
  const double tangent = std::tan(std::clamp(context.glide_slope_rad, 0.02, 1.55));
  const double height_m = site.p_WS.z() - context.p_WB.z();
  return std::isnan(height_m) ? height_m : std::max(0.0, height_m / tangent);
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

ApproachCorridors::ApproachCorridors(const ElevationMap& map, const SladSettings& settings)
    : map_(map), settings_(settings), top_m_(HighestOfRows(map)) {}

bool ApproachCorridors::IsReachable(const Approach& approach, const SiteContext& context,
                                    const LandingSite& site) const {
  return IsClear(approach, site) && LevelWayIsClear(approach, context, site);
}

/// Nothing known reaches the skids of a vehicle that flies level at its present height, as wide as
/// its rotor, to where an approach begins. What stands within the clear radius is a hazard anyway.
bool ApproachCorridors::LevelWayIsClear(const Approach& approach, const SiteContext& context,
                                        const LandingSite& site) const {
  const ElevationMap& map = map_;
  const GridGeometry& g = map.geometry;
  const Eigen::Vector2d from = context.p_WB.head<2>(), p_WS = site.p_WS.head<2>();
  const Eigen::Vector2d way = p_WS + approach.length_m * approach.from - from;
  const double length_m = way.norm();
  const double skids_m = HeightFromDown(context.p_WB.z() + settings_.lander.skid_centre_B().z());
  if (!(length_m > g.cell_m) || std::isnan(skids_m)) {
    return true;
  }
  const Eigen::Vector2d along = way / length_m;
  const double half_width_m = settings_.lander.rotor_diameter_m / 2;
  for (int r = 0; r < g.rows; ++r) {
    if (!(top_m_[static_cast<std::size_t>(r)] > skids_m)) {
      continue;
    }
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

std::uint8_t ApproachCorridors::ClearSectors(const SiteContext& context,
                                             const LandingSite& site) const {
  // To the end of the map for a vehicle nobody knows.
  const GridGeometry& g = map_.geometry;
  const double slope_m = SlopeLength(context, site);
  const double length_m = std::isnan(slope_m) ? g.cell_m * std::hypot(g.rows, g.cols) : slope_m;
  unsigned clear = 0;
  for (unsigned sector = 0; sector < 8; ++sector) {
    const double bearing_rad = sector * std::numbers::pi / 4;
    const Approach approach{
        {std::cos(bearing_rad), std::sin(bearing_rad)}, length_m, context.glide_slope_rad};
    clear |= IsReachable(approach, context, site) ? 1U << sector : 0U;
  }
  return static_cast<std::uint8_t>(clear);
}

bool ApproachCorridors::IsClear(const Approach& approach, const LandingSite& site) const {
  const ElevationMap& map = map_;
  if (std::isnan(site.height_m.value)) {
    return true;
  }
  const double length_m = approach.length_m;
  const Eigen::Vector2d& along = approach.from;
  const double tangent = std::tan(std::min(approach.glide_slope_rad, 1.55));
  const GridGeometry& g = map.geometry;
  const double half_width_m = settings_.lander.rotor_diameter_m / 2;
  const double lander_radius_m = settings_.lander.radius_m();
  // Rows that the corridor reaches, one too many on each side.
  const double end_m = length_m * along.x(), aside_m = half_width_m * std::abs(along.y());
  const double row_of_site = (g.NorthOfRow(0) - site.p_WS.x()) / g.cell_m;
  const double first_row = row_of_site - (std::max(0.0, end_m) + aside_m) / g.cell_m;
  const double last_row = row_of_site - (std::min(0.0, end_m) - aside_m) / g.cell_m;
  const int first = static_cast<int>(std::clamp(std::floor(first_row) - 1, 0.0, g.rows - 1.0));
  const int last = static_cast<int>(std::clamp(std::ceil(last_row) + 1, 0.0, g.rows - 1.0));
  // What may rise at the near end, where the least may: anywhere in the corridor.
  const double least_m = tangent < 0 ? -HUGE_VAL
                                     : (site.clear_radius_m - lander_radius_m) * tangent +
                                           settings_.limits.max_deviation_m;
  for (int r = first; r <= last; ++r) {
    if (!(top_m_[static_cast<std::size_t>(r)] - site.height_m.value > least_m)) {
      continue;
    }
    const double north_m = g.NorthOfRow(r) - site.p_WS.x();
    const ColumnRange columns =
        CorridorInRow(g, site.p_WS.y(), along, north_m, length_m, half_width_m);
    const float* height_m = map.height_m.row(r);
    const float* thin_top_m = map.thin_top_m.empty() ? nullptr : map.thin_top_m.row(r);
    for (int c = columns.first; c <= columns.last; ++c) {
      const double east_m = g.EastOfCol(c) - site.p_WS.y();
      const double s = north_m * along.x() + east_m * along.y();
      const double rise_m = static_cast<double>(height_m[c]) - site.height_m.value;
      const double free_m = (s - lander_radius_m) * tangent + settings_.limits.max_deviation_m;
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
      const double noise_m =
          kCorridorSigmas * std::sqrt(static_cast<double>(map.variance_m2.at(r, c)));
      if (rise_m - noise_m > free_m) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace palace
