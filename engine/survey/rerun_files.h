// What `palacectl log rerun` writes: a log's maps, sites and decisions as data.
//
//   sites.csv      every judged map's sites, best first; one without has a row that says why
//   decisions.csv  every frame: state, hashes, best site, beside what was recorded
//   maps.csv       the maps written, with their grid and origin in W (metres north and east)
//   map_T_*.tif    the layers (map_layers.h) of the fused map at T seconds after the first frame:
//                  float32 GeoTIFF, SI (slope in radians), NaN unknown
//
// A map whose settings changed is judged again: it has new rows in sites.csv, and where it is
// written once more, its files are map_T_2_*.tif.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "engine/core/result.h"
#include "engine/model/flight_record.h"
#include "engine/model/snapshot.h"

namespace palace {

/// When fused maps are written as GeoTIFF.
struct MapTimes {
  bool last = false;              ///< the newest one at the end, as it was judged last
  std::optional<double> every_s;  ///< and the first one after each such stretch of data time
};

/// "last", or "every N s" ("every 5", "every 0.5 s") with N from 0.1 to 3600.
Result<MapTimes> ParseMapTimes(const std::string& text);

class RerunFiles {
 public:
  /// Makes the folder; maps that an earlier run's table lists are removed. The tables are written under other names and moved by Finish, so that a run
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
    std::uint64_t judged_again = 0;  ///< maps under other settings
    std::uint64_t without_site = 0;  ///< of both
    std::uint64_t written = 0;       ///< of both
    /// Of the frames without a new map, how many say what: "Left and right camera look exchanged".
    std::map<std::string, std::uint64_t> why_no_map{};
  };
  const Counts& counts() const { return counts_; }

 private:
  RerunFiles(std::filesystem::path folder, const MapTimes& maps);
  void AddSites(const TerrainDecision& decision, Timestamp time);
  void AddDecision(const EngineSnapshot& snapshot, const FlightRecordSample* recorded);
  Status WriteMap(const TerrainDecision& decision);
  /// map_T, with a number from the second on that has this time.
  std::string NewStem(Timestamp map_time);

  std::filesystem::path folder_;
  MapTimes when_;
  std::ofstream sites_, decisions_, maps_;
  std::shared_ptr<const TerrainDecision> newest_;
  std::shared_ptr<const TerrainDecision> written_;
  std::shared_ptr<const StereoFrame> frame_;  ///< the newest pair
  std::optional<Timestamp> start_;
  std::optional<Timestamp> last_map_;  ///< time of the last map written by every_s
  std::map<std::string, int> stems_;   ///< times each was asked for
  Counts counts_;
};

}  // namespace palace
