#include "engine/model/site_columns.h"

#include <algorithm>
#include <string_view>

namespace palace {

void AppendSite(CsvRow& row, int rank, const LandingSite& s) {
  row << rank << s.id << s.letter << s.cell.row << s.cell.col;
  row << s.p_WS.x() << s.p_WS.y() << s.p_WS.z();
  for (const Figure& figure : {s.slope_rad, s.roughness_m, s.step_m, s.height_m}) {
    row << figure.value << figure.three_sigma;
  }
  row << s.safe_distance_m << s.clear_radius_m << s.clearance_m << s.cost << s.safe_probability;
  row << s.touchdown.worst_probability << s.touchdown.worst_heading_rad;
  row << s.touchdown.best_probability << s.touchdown.best_heading_rad;
  row << int{s.flags} << int{s.confirmed} << int{s.corridor_clear} << int{s.clear_approaches};
  row << s.age_s << s.distance_m << s.frames_fused << s.unknown_cells;
  row << s.normal_W.x() << s.normal_W.y() << s.normal_W.z() << s.pixel.x() << s.pixel.y();
  row << s.reason;
}

CsvRow BeginSiteRow(const SiteTableMap& map) {
  CsvRow row;
  row << map.time.us << map.map_time.us << map.map_hash << map.settings_hash;
  row << map.grid.rows << map.grid.cols << map.grid.cell_m;
  row << map.grid.north_min_m << map.grid.east_min_m;
  return row;
}

void AppendNoSite(CsvRow& row, const std::string& reason) {
  const std::string_view names = kSiteColumns;
  const auto columns = std::count(names.begin(), names.end(), ',');
  for (std::ptrdiff_t i = 0; i < columns; ++i) {
    row << "";
  }
  row << reason;
}

}  // namespace palace
