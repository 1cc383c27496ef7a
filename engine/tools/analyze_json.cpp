#include "engine/tools/analyze_json.h"

#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

#include "engine/core/units.h"
#include "engine/core/version.h"
#include "engine/model/site_standing.h"
#include "engine/tools/explanation_json.h"

namespace palace {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no NaN: unknown is null.
Json Number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// Directions a vehicle may come from along the glide slope.
Json ApproachesJson(const LandingSite& site) {
  Json json = Json::array();
  for (unsigned k = 0; k < 8; ++k) {
    if ((site.clear_approaches >> k & 1U) != 0) {
      json.push_back(DirectionWord(Rad(45.0 * k)));
    }
  }
  return json;
}

Json SiteJson(const LandingSite& site, const SladSettings& slad) {
  return {{"row", site.cell.row},
          {"col", site.cell.col},
          {"north_m", site.p_WS.x()},
          {"east_m", site.p_WS.y()},
          {"height_m", Number(site.height_m.value)},
          {"pixel_x", Number(site.pixel.x())},
          {"pixel_y", Number(site.pixel.y())},
          {"slope_deg", Number(Deg(site.slope_rad.value))},
          {"roughness_m", Number(site.roughness_m.value)},
          {"clearance_m", site.clearance_m},
          {"cost", Number(site.cost)},
          {"safe_probability", Number(site.safe_probability)},
          {"confirmed", site.confirmed},
          {"standing", StandingWord(StandingOf(site, slad))},
          {"provisional_because", WhyProvisional(site, slad)},
          {"look_height_m", Number(site.look_height_m)},
          {"hidden_things", Number(site.hidden_things)},
          {"air_seen_m", Number(site.air_seen_m)},
          {"letter", site.letter},
          {"step_m", Number(site.step_m.value)},
          {"safe_distance_m", site.safe_distance_m},
          {"clear_radius_m", site.clear_radius_m},
          {"corridor_clear", std::isfinite(site.distance_m) ? Json(site.corridor_clear) : Json()},
          {"clear_approaches", ApproachesJson(site)},
          {"age_s", Number(site.age_s)},
          {"flags", FlagWords(site.flags)},
          {"worst_probability", Number(site.touchdown.worst_probability)},
          {"worst_heading_deg", Number(Deg(site.touchdown.worst_heading_rad))},
          {"best_probability", Number(site.touchdown.best_probability)},
          {"best_heading_deg", Number(Deg(site.touchdown.best_heading_rad))},
          {"margins", MarginsJson(site, slad)},
          {"why", site.reason},
          {"reason", site.reason}};
}

Json SettingsJson(const Settings& settings) {
  Json json = Json::object();
  for (const SettingInfo& info : SettingTable()) {
    const double value = GetSetting(settings, info.name);
    if (!info.words.empty()) {
      json[info.name] = info.words[static_cast<std::size_t>(value)];
    } else if (info.integer) {
      json[info.name] = std::llround(value);
    } else {
      json[info.name] = value;
    }
  }
  return json;
}

}  // namespace

std::string AnalyzeJson(const AnalyzeOutcome& o) {
  const auto& sites = o.selection().sites;
  const GridGeometry& g = o.map().geometry;
  Json json;
  json["version"] = kProgramVersion;
  json["input"] = o.files;
  json["settings_file"] = o.settings_file.empty() ? Json(nullptr) : Json(o.settings_file);
  json["status"] = sites.empty() ? "none" : "found";
  json["site"] = sites.empty() ? Json(nullptr) : SiteJson(sites.front(), o.settings.slad);
  json["candidates"] = Json::array();
  for (const LandingSite& site : sites) {
    json["candidates"].push_back(SiteJson(site, o.settings.slad));
  }
  if (sites.empty()) {
    json["none_reason"] = o.selection().none_reason;
  }
  for (const CellExplanation& cell : o.explained) {
    json["cells"].push_back(CellJson(cell));
  }
  json["map_hash"] = std::to_string(o.decision->map_hash);  // a number this long would be rounded
  json["grid"] = {{"rows", g.rows},
                  {"cols", g.cols},
                  {"cell_m", g.cell_m},
                  {"north_min_m", g.north_min_m},
                  {"east_min_m", g.east_min_m}};
  json["rejected"] = {
      {"slope", o.hazards().rejected.slope},       {"roughness", o.hazards().rejected.roughness},
      {"unknown", o.hazards().rejected.unknown},   {"flagged", o.hazards().rejected.flagged},
      {"doubtful", o.hazards().rejected.doubtful}, {"footprint", o.hazards().rejected.footprint}};
  if (o.input.pairs > 0) {
    json["pairs"] = o.input.pairs;
    json["pairs_in_map"] = o.input.pairs_in_map;
    json["stereo"] = {{"coverage", o.input.stereo.coverage},
                      {"median_depth_m", o.input.stereo.median_depth_m},
                      {"median_sigma_px", o.input.stereo.median_sigma_px},
                      {"row_error_px", o.input.stereo.row_error_px}};
  }
  json["settings"] = SettingsJson(o.settings);
  json["timing_ms"] = Json::object();
  for (const StageTime& time : o.input.watch.times()) {
    json["timing_ms"][time.stage] = time.milliseconds;
  }
  json["warnings"] = o.input.warnings;
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace palace
