// A landing site as columns of a CSV table: what `log export` and `log rerun` write alike.
#pragma once

#include <string>

#include "engine/core/csv_row.h"
#include "engine/model/landing_site.h"

namespace palace {

/// Names with units, from "rank" to "reason", as AppendSite fills them.
inline constexpr const char* kSiteColumns =
    "rank,site_id,letter,row,col,north_m,east_m,down_m,slope_rad,slope_3sigma_rad,roughness_m,"
    "roughness_3sigma_m,step_m,step_3sigma_m,height_m,height_3sigma_m,safe_distance_m,"
    "clear_radius_m,clearance_m,cost,safe_probability,worst_probability,worst_heading_rad,"
    "best_probability,best_heading_rad,flags,confirmed,corridor_clear,clear_approaches,age_s,"
    "distance_m,reason";

/// Appends the site of that rank (1 the best). SI units, NED metres.
void AppendSite(CsvRow& row, int rank, const LandingSite& site);

/// Appends a row without a site: every column empty but the last, which says why there is none.
void AppendNoSite(CsvRow& row, const std::string& reason);

}  // namespace palace
