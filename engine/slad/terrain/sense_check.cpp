#include "engine/slad/terrain/sense_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/text.h"

namespace palace {
namespace {

constexpr double kSmallestCell_m = 1e-3;

std::string Number(double value) { return WithNumbers("%.3g", value); }

template <typename T>
bool Fits(const GridGeometry& geometry, const Grid<T>& layer) {
  return layer.rows() == geometry.rows && layer.cols() == geometry.cols;
}

template <typename T>
bool FitsOrIsLeftOut(const GridGeometry& geometry, const Grid<T>& layer) {
  return layer.empty() || Fits(geometry, layer);
}

}  // namespace

std::string ObjectionTo(const ElevationMap& map, const SladSettings& settings) {
  Settings asked;
  asked.slad = settings;
  for (const SettingInfo& info : SettingTable()) {
    // The table's own ranges are for people; here only what no figure can be made from.
    const double value = GetSetting(asked, info.name);
    if (!std::isfinite(value) || (info.min >= 0 && value < 0)) {
      return info.name + " = " + Number(value) + " makes no sense, limits " + Number(info.min) +
             " to " + Number(info.max);
    }
  }
  if (!(settings.lander.base_size_m > 0) || settings.choice.sites_kept < 1) {
    return settings.choice.sites_kept < 1 ? "slad.sites_kept = 0: no site is asked for"
                                          : "slad.lander_base_size_m = 0 m is no lander";
  }
  const GridGeometry& g = map.geometry;
  if (!LayersFit(map)) {
    return "the map's layers differ in size";
  }
  if (!map.height_m.empty() &&
      !(g.cell_m >= kSmallestCell_m && g.cell_m <= settings.lander.base_size_m)) {
    return "cells of " + Number(g.cell_m) + " m, limits " + Number(kSmallestCell_m) +
           " m to one lander, " + Number(settings.lander.base_size_m) +
           " m: too few points, or too large an area for the map's rows and columns";
  }
  return {};
}

bool LayersFit(const ElevationMap& map) {
  const GridGeometry& g = map.geometry;
  return Fits(g, map.height_m) && Fits(g, map.variance_m2) && Fits(g, map.frame_count) &&
         Fits(g, map.state) && FitsOrIsLeftOut(g, map.measured_m) &&
         FitsOrIsLeftOut(g, map.age_s) && FitsOrIsLeftOut(g, map.flags) &&
         FitsOrIsLeftOut(g, map.thin_top_m);
}

Lander WithinReason(const Lander& lander, const GridGeometry& geometry) {
  Lander within = lander;
  const double widest_m = 2 * std::max(geometry.rows, geometry.cols) * geometry.cell_m;
  for (double* size_m : {&within.base_size_m, &within.max_rock_size_m, &within.gear_length_m,
                         &within.gear_width_m}) {
    *size_m = *size_m <= widest_m ? std::max(0.0, *size_m) : widest_m;
  }
  return within;
}

bool IsSound(const LandingSite& site) {
  const std::array figures = {site.slope_rad.value, site.roughness_m.value,
                              site.height_m.value,  site.height_m.three_sigma,
                              site.safe_distance_m, site.cost};
  return site.p_WS.allFinite() && site.normal_W.allFinite() &&
         std::all_of(figures.begin(), figures.end(), [](double f) { return std::isfinite(f); }) &&
         std::abs(site.height_m.value) <= kHighestGround_m;
}

}  // namespace palace
