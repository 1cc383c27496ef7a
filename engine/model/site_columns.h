// A landing site as columns of a CSV table: what `log export` and `log rerun` write alike.
#pragma once

#include <cstdint>
#include <string>

#include "engine/core/csv_row.h"
#include "engine/core/time.h"
#include "engine/model/grid.h"
#include "engine/model/landing_site.h"

namespace palace {

/// Names with units, from "rank" to "reason", as AppendSite fills them.
inline constexpr const char* kSiteColumns =
    "rank,site_id,letter,row,col,north_m,east_m,down_m,slope_rad,slope_3sigma_rad,roughness_m,"
    "roughness_3sigma_m,step_m,step_3sigma_m,height_m,height_3sigma_m,safe_distance_m,"
    "clear_radius_m,clearance_m,cost,safe_probability,worst_probability,worst_heading_rad,"
    "best_probability,best_heading_rad,flags,confirmed,corridor_clear,clear_approaches,age_s,"
    "distance_m,frames_fused,unknown_cells,normal_north,normal_east,normal_down,pixel_x,pixel_y,"
    "reason";

/// Columns before kSiteColumns: when, which map, and where its grid lies (row 0 northernmost; north
/// of row r: north_min_m + (rows - 0.5 - r) cell_m; east of column c: east_min_m + (c + 0.5)
/// cell_m).
inline constexpr const char* kMapColumns =
    "time_us,map_time_us,map_hash,settings_hash,rows,cols,cell_m,north_min_m,east_min_m";

/// One map that sites are written for.
struct SiteTableMap {
  Timestamp time;
  Timestamp map_time;
  std::uint64_t map_hash = 0;
  std::uint64_t settings_hash = 0;
  GridGeometry grid;
};
/// Begins a row: kMapColumns.
CsvRow BeginSiteRow(const SiteTableMap& map);

/// Appends the site of that rank (1 the best). SI units, NED metres.
void AppendSite(CsvRow& row, int rank, const LandingSite& site);

/// Appends a row without a site: every column empty but the last, which says why there is none.
void AppendNoSite(CsvRow& row, const std::string& reason);

}  // namespace palace
