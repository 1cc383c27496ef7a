#include "engine/survey/rerun_files.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <system_error>
#include <utility>

#include "engine/core/csv_row.h"
#include "engine/core/files.h"
#include "engine/geodata/geo_tiff.h"
#include "engine/model/mission/picture_faults.h"
#include "engine/model/site_columns.h"
#include "engine/survey/map_layers.h"

namespace palace {
namespace {

namespace fs = std::filesystem;

constexpr double kShortest_s = 0.1, kLongest_s = 3600;
constexpr std::array kTables = {"sites.csv", "decisions.csv", "maps.csv"};

fs::path PartialName(const fs::path& folder, std::string_view table) {
  return folder / (std::string(table) + ".partial");
}

/// Maps that an earlier run's table lists: the new table would say nothing of them.
void RemoveMapsOf(const fs::path& folder) {
  std::ifstream table(folder / "maps.csv");
  std::string row;
  std::getline(table, row);
  while (std::getline(table, row)) {
    const std::string stem = row.substr(0, row.find(','));
    std::error_code ignored;
    for (const fs::directory_entry& file : fs::directory_iterator(folder, ignored)) {
      const std::string name = file.path().filename().string();
      if (stem.rfind("map_", 0) == 0 && name.rfind(stem + "_", 0) == 0 &&
          file.path().extension() == ".tif") {
        fs::remove(file.path(), ignored);
      }
    }
  }
}

/// What the pipeline says of a pass that made no map; empty: it was not asked for one.
std::string WhyNoMap(const EngineSnapshot& snapshot, bool new_pair) {
  const SessionPart& session = *snapshot.session;
  const TerrainPart& terrain = *snapshot.terrain;
  if (!session.missing_inputs.empty()) {
    return "missing for maps: " + session.missing_inputs;
  }
  if (!new_pair) {
    return "no pair of pictures came with it";
  }
  if (!terrain.why_no_map.empty()) {
    return terrain.why_no_map;
  }
  for (const Diagnostic& told : session.diagnostics) {
    if (told.level != DiagnosticLevel::kInfo) {
      return told.message;
    }
  }
  return JudgePictures(terrain.stereo_quality, session.role).words();
}

}  // namespace

Result<MapTimes> ParseMapTimes(const std::string& text) {
  if (text == "last") {
    return MapTimes{.last = true, .every_s = {}};
  }
  double every_s = 0;
  char unit[3] = "";
  char rest = 0;
  const int read = std::sscanf(text.c_str(), "every %lf %2s %c", &every_s, unit, &rest);
  const bool whole = read == 1 || (read == 2 && std::string_view(unit) == "s");
  if (!whole || !(every_s >= kShortest_s && every_s <= kLongest_s)) {
    return UsageError("--maps '" + text +
                      "': give \"last\" or \"every N s\" with N from 0.1 to 3600 seconds");
  }
  return MapTimes{.last = true, .every_s = every_s};
}

RerunFiles::RerunFiles(fs::path folder, const MapTimes& maps)
    : folder_(std::move(folder)), when_(maps) {}

Result<RerunFiles> RerunFiles::Open(const fs::path& folder, const MapTimes& maps) {
  if (const Status made = MakeFolder(folder); !made) {
    return made.error();
  }
  RemoveMapsOf(folder);
  RerunFiles files(folder, maps);
  const std::array streams = {&files.sites_, &files.decisions_, &files.maps_};
  for (std::size_t i = 0; i < kTables.size(); ++i) {
    streams[i]->open(PartialName(folder, kTables[i]), std::ios::binary | std::ios::trunc);
    if (!*streams[i]) {
      return UnavailableError((folder / kTables[i]).string() +
                              ": cannot be written; choose a writable --out");
    }
  }
  files.sites_ << kMapColumns << ',' << kSiteColumns << '\n';
  files.decisions_ << "time_us,state,why,map_hash,settings_hash,decision_hash,best_site,"
                      "best_safe_distance_m,height_above_site_m,recorded_state,"
                      "recorded_decision_hash,recorded_best_site,same\n";
  files.maps_ << "stem,time_us,map_hash,settings_hash,rows,cols,cell_m,north_min_m,east_min_m\n";
  return files;
}

void RerunFiles::AddSites(const TerrainDecision& decision, Timestamp time) {
  const auto begin = [&] {
    return BeginSiteRow({time, decision.map_time, decision.map_hash, decision.settings_hash,
                         decision.hazards ? decision.hazards->geometry : GridGeometry{}});
  };
  int rank = 0;
  for (const LandingSite& site : decision.selection.sites) {
    CsvRow row = begin();
    AppendSite(row, ++rank, site);
    sites_ << row.line();
  }
  if (rank == 0) {
    ++counts_.without_site;
    CsvRow row = begin();
    AppendNoSite(row, decision.selection.none_reason);
    sites_ << row.line();
  }
}

void RerunFiles::AddDecision(const EngineSnapshot& snapshot, const FlightRecordSample* recorded) {
  const TerrainDecision* map = snapshot.terrain->applied.get();
  const LandingSite* best =
      map && !map->selection.sites.empty() ? &map->selection.sites.front() : nullptr;
  CsvRow row;
  row << snapshot.time.us << MissionStateName(snapshot.flight->mission.state)
      << snapshot.flight->mission.why;
  row << (map ? std::to_string(map->map_hash) : "") << snapshot.session->settings_hash
      << snapshot.decision_hash;
  row << (best ? best->letter : "") << (best ? best->safe_distance_m : NAN);
  row << snapshot.flight->mission.height_above_site_m;
  if (recorded) {
    const bool same = recorded->decision_hash == snapshot.decision_hash;
    ++counts_.recorded;
    counts_.equal += same ? 1 : 0;
    row << MissionStateName(recorded->state) << recorded->decision_hash << recorded->best_site
        << int{same};
  } else {
    row << ""
        << ""
        << ""
        << "";
  }
  decisions_ << row.line();
}

std::string RerunFiles::NewStem(Timestamp map_time) {
  char stem[40];
  std::snprintf(stem, sizeof stem, "map_%010.3f", SecondsBetween(*start_, map_time));
  const int uses = ++stems_[stem];
  return uses == 1 ? stem : std::string(stem) + "_" + std::to_string(uses);
}

Status RerunFiles::WriteMap(const TerrainDecision& decision) {
  const GridGeometry& grid = decision.elevation->geometry;
  const std::string stem = NewStem(decision.map_time);
  for (const DecidedLayer& layer : LayersOf(decision)) {
    const fs::path path = folder_ / (stem + "_" + layer.name + ".tif");
    if (const Status done = WriteGeoTiff(path, {grid, layer.cells, {}}); !done) {
      return done;
    }
  }
  CsvRow row;
  row << stem << decision.map_time.us << decision.map_hash << decision.settings_hash << grid.rows
      << grid.cols << grid.cell_m << grid.north_min_m << grid.east_min_m;
  maps_ << row.line();
  ++counts_.written;
  return Ok();
}

Status RerunFiles::Add(const EngineSnapshot& snapshot, const FlightRecordSample* recorded) {
  start_ = start_.value_or(snapshot.time);
  ++counts_.frames;
  AddDecision(snapshot, recorded);
  const bool new_pair = snapshot.sensors->frame && snapshot.sensors->frame != frame_;
  frame_ = snapshot.sensors->frame;
  if (!snapshot.terrain->applied || snapshot.terrain->applied == newest_) {
    if (const std::string why = WhyNoMap(snapshot, new_pair); !why.empty()) {
      ++counts_.why_no_map[why];
    }
    return Ok();
  }
  const bool again = newest_ && newest_->elevation == snapshot.terrain->applied->elevation;
  ++(again ? counts_.judged_again : counts_.maps);
  newest_ = snapshot.terrain->applied;
  AddSites(*newest_, snapshot.time);
  const bool due = when_.every_s &&
                   (!last_map_ || SecondsBetween(*last_map_, newest_->map_time) >= *when_.every_s);
  if (!due) {
    return Ok();
  }
  last_map_ = newest_->map_time;
  written_ = newest_;
  return WriteMap(*newest_);
}

Status RerunFiles::Finish() {
  if (when_.last && newest_ && newest_ != written_) {
    if (const Status done = WriteMap(*newest_); !done) {
      return done;
    }
  }
  const std::array streams = {&sites_, &decisions_, &maps_};
  for (std::size_t i = 0; i < kTables.size(); ++i) {
    streams[i]->close();
    std::error_code failed;
    if (*streams[i]) {
      fs::rename(PartialName(folder_, kTables[i]), folder_ / kTables[i], failed);
    }
    if (!*streams[i] || failed) {
      return UnavailableError((folder_ / kTables[i]).string() +
                              ": cannot be written; is the disk full?");
    }
  }
  return Ok();
}

}  // namespace palace
