// What `palacectl log rerun` writes: a log's maps, sites and decisions as data.
//
//   sites.csv      every map's sites, best first; a map without one has a row that says why
//   decisions.csv  every frame: state, hashes, best site, beside what was recorded
//   maps.csv       the maps written, with their grid and origin in W (metres north and east)
//   map_T_*.tif    elevation, its sigma, slope, roughness, cost, safe distance and hazard of the
//                  fused map at T seconds after the first frame: float32 GeoTIFF, SI, NaN unknown
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>

#include "engine/core/result.h"
#include "engine/model/flight_record.h"
#include "engine/model/snapshot.h"

namespace palace {

/// When fused maps are written as GeoTIFF.
struct MapTimes {
  bool last = false;              ///< the newest one at the end
  std::optional<double> every_s;  ///< and the first one after each such stretch of data time
};

/// "last", or "every N s" ("every 5", "every 0.5 s") with N from 0.1 to 3600.
Result<MapTimes> ParseMapTimes(const std::string& text);

class RerunFiles {
 public:
  /// Makes the folder. The tables are written under other names and moved by Finish, so that a run
  /// that was broken off leaves none that looks whole. Errors name the file.
  static Result<RerunFiles> Open(const std::filesystem::path& folder, const MapTimes& maps);

  /// One pass of the pipeline, and what the log says was decided then (null: not on record).
  Status Add(const EngineSnapshot& snapshot, const FlightRecordSample* recorded);
  /// Writes the last map where asked, and gives the tables their names.
  Status Finish();

  struct Counts {
    std::uint64_t frames = 0;
    std::uint64_t recorded = 0;  ///< frames with a decision on record
    std::uint64_t equal = 0;     ///< of those, decided the same again, to the bit
    std::uint64_t maps = 0;
    std::uint64_t maps_without_site = 0;
    std::uint64_t maps_written = 0;
  };
  const Counts& counts() const { return counts_; }

 private:
  RerunFiles(std::filesystem::path folder, const MapTimes& maps);
  void AddSites(const TerrainDecision& decision, Timestamp time);
  void AddDecision(const EngineSnapshot& snapshot, const FlightRecordSample* recorded);
  Status WriteMap(const TerrainDecision& decision);

  std::filesystem::path folder_;
  MapTimes when_;
  std::ofstream sites_, decisions_, maps_;
  std::shared_ptr<const TerrainDecision> newest_;
  std::shared_ptr<const TerrainDecision> written_;
  std::optional<Timestamp> start_;
  std::optional<Timestamp> last_map_;  ///< time of the last map written by every_s
  Counts counts_;
};

}  // namespace palace
