// What is asked of a way to another hover, wherever it is asked: of a command, of the look that is
// proposed, and of a button in the window before it is pressed.
//
// It stays in the area that was drawn and below its ceiling, goes no lower (a way down is flown to
// a site), no farther than kFarthestGo_m and no higher than kMostClimb_m at once, and the newest
// map knows nothing that reaches within kLeastBelowSkids_m of its skids on the level part. While
// GPS disagrees with the estimate it may turn and climb on the spot alone.
#pragma once

#include <cmath>
#include <string>

#include <Eigen/Dense>

#include "engine/model/command.h"
#include "engine/model/snapshot.h"

namespace palace {

inline constexpr double kFarthestGo_m = 60;
inline constexpr double kMostClimb_m = 30;
inline constexpr double kLeastBelowSkids_m = 3;

/// Where a way begins, and what it may meet. In W.
struct WayFacts {
  Eigen::Vector3d p_WB = Eigen::Vector3d::Constant(NAN);  ///< must be known
  double yaw_rad = NAN;
  const ElevationMap* elevation = nullptr;  ///< the newest; null: nothing is known to stand there
  const FlyArea* area = nullptr;            ///< null: none was drawn
  const Lander& lander;
  std::string place_doubt{};  ///< why the vehicle is not sure to be at p_WB; empty: it is
};

/// The vehicle flies by another place than the station measures from; empty: none knows of that.
std::string PlaceDoubt(const NavigationStatus& navigation);
/// Why it is not flown, with value and limit; empty when it is.
std::string WhyNotThatWay(const WayFacts& from, const FlyTo& there);
/// The same by what a snapshot tells, the mission's own reason first (MissionStatus::why_not_go).
/// What the engine answers to the command is this, of the newest map by then.
std::string WhyNotFlown(const EngineSnapshot& snapshot, const FlyTo& there);
/// Metres of a way over ground that no map showed (flight/level_way.h); all of it without a map.
double UnseenOfWay(const ElevationMap* map, const Eigen::Vector3d& from_W,
                   const Eigen::Vector3d& to_W);
/// The same by what a snapshot tells, as the event of the way will tell it; 0 where the vehicle's
/// place is not known.
double UnseenOnWay(const EngineSnapshot& snapshot, const FlyTo& there);

}  // namespace palace
