// Limits of the approach, the descent and the cameras: the rows that people see are the ones that
// guards and alarms ask.
//
//   wind           blocks approve (G15); in the descent an alarm. A wind that is not known, or is
//                  stale, is for information: many vehicles measure none
//   off the path   alarm while the vehicle flies the slope and the level leg
//   from centre    alarm while it sinks onto the site
//   beside         lower than 1 m and farther than 1.5 of nav_error_m off for 0.3 s: nobody judged
//                  that ground, and the descent aborts
//   descent rate   alarm beyond 1.5 of the approved one
//   coherence      blocks approve (G5); in the descent an alarm, and the tracker re-anchors
//   residual       alarm; the position filter refuses such a measurement
//   off wind       for information: no landing was tried that would tell what matters
//   cameras        alarms, at the AlarmLimits; rows apart also block approve (G3)
//   holds          ages and times of the alarm table that hold a descent (LimitsOfHolds), and the
//                  site's figures while it is flown to
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "engine/core/units.h"
#include "engine/flight/flight_path.h"
#include "engine/mission/mission_inputs.h"
#include "engine/mission/mission_memory.h"
#include "engine/model/mission/limit_row.h"

namespace palace {

struct DescentLimits {
  static constexpr double off_path_m = 1.2;  ///< of B from the path
  static constexpr double rate_share = 1.5;  ///< of the approved descent rate
  static constexpr double off_wind_rad = Rad(60);
  static constexpr double grave_share = 1.5;  ///< of a limit: a caution is a warning from there on
  static constexpr double last_height_m = 1;  ///< lower, a vehicle beside its site goes around ...
  static constexpr double beside_s = 0.3;     ///< ... once it was so for so long
};

/// What the rows are made of; NaN where unknown.
struct DescentFigures {
  MissionState state = MissionState::kNoLive;
  VehicleMode mode = VehicleMode::kUnknown;
  double off_path_m = NAN;
  double from_centre_m = NAN;
  double horizontal_3s_m = NAN;
  double descent_rate_mps = NAN;
  double descent_rate_3s_mps = NAN;
  double approved_rate_mps = NAN;
  double nav_error_m = NAN;
  bool tracked = false;  ///< the tracker is locked
  double coherence = NAN;
  double min_coherence = NAN;
  double residual_sigma = NAN;
  double max_residual_sigma = NAN;
  double wind_mps = NAN;  ///< NaN: unknown or stale
  double max_wind_mps = NAN;
  double off_wind_rad = NAN;
};

/// The wind as guard G15 sees it: for information while it is not known.
LimitRow WindLimit(double wind_mps, double max_wind_mps, EnforcedBy by);
std::vector<LimitRow> LimitsOfDescent(const DescentFigures& figures);
/// `standing`: the faults that three pairs in a row have shown.
std::vector<LimitRow> LimitsOfCameras(const StereoQuality& stereo, const RangeAgreement& range,
                                      const PictureFaults& standing, MissionState state);

/// The wind that the vehicle told last; NaN when it told none, or when that is stale.
double KnownWind(const MissionMemory& memory, Timestamp now);
/// Fills the limits of the status; on the ground those of the descent stay as the last turn in the
/// air told them. After PublishGeometry, which returned `path`.
void PublishLimits(MissionMemory& memory, const std::optional<FlightPath>& path, Timestamp now);

}  // namespace palace
