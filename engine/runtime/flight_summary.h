// Summary of one flight: what a report states in figures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/model/snapshot.h"
#include "engine/world/world.h"

namespace palace {

/// Mean, largest and count of a series; NaN samples do not count.
struct SeriesStats {
  int count = 0;
  double mean = 0;
  double max = 0;
  void Add(double value);
};

struct FlightSummary {
  MissionState final_state = MissionState::kNoLive;
  double duration_s = 0;
  std::optional<LandingSite> site;           ///< the one approved to be landed on
  bool site_confirmed = false;               ///< when it was approved
  Timestamp approved_at;                     ///< vehicle time
  int looks = 0;                             ///< closer looks that ended in their hover
  SeriesStats estimate_error_m;              ///< |estimate - truth| of B while vision was in force
  SeriesStats gps_error_m;                   ///< the same of the GPS filter
  SeriesStats approach_error_m;              ///< |estimate - truth| over the whole flight
  std::optional<double> touchdown_miss_m;    ///< skid centre to site, true, horizontal
  std::optional<double> estimated_miss_m;    ///< the same by the estimate in force
  double nav_error_m = NAN;                  ///< that was allowed for
  std::optional<double> touchdown_sink_mps;  ///< just before it, by the estimate
  std::optional<double> site_obstacle_distance_m;  ///< nearest true obstacle to the site
  double lander_radius_m = 0;
};

/// Follows a flight snapshot by snapshot.
class FlightSummarizer {
 public:
  /// `scene` is the simulated truth, when there is one.
  explicit FlightSummarizer(std::optional<World> scene) : scene_(std::move(scene)) {}
  void Add(const EngineSnapshot& snapshot);
  const FlightSummary& summary() const { return summary_; }

 private:
  std::optional<World> scene_;
  FlightSummary summary_;
  std::optional<Timestamp> start_;  ///< of the vehicle's clock as it runs now
  Timestamp newest_;
  double before_s_ = 0;  ///< by clocks before
  std::uint64_t last_sequence_ = 0;
  bool looking_ = false;  ///< the vehicle was on its way to a look
};

/// Lines for people, each with its unit.
std::vector<std::string> SummaryLines(const FlightSummary& summary);

}  // namespace palace
