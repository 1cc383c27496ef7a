// FlightPath: the one geometry of the way down. The vehicle flies it, the mission times it, the
// history measures the distance from it, the plots draw what of it is still ahead.
//
//   slope   the left camera's focal point stays on the ray from the site upward and back along the
//           heading, so that a camera tilted by -slope keeps the site at its image centre:
//             p_WC(h) = p_WS + h_c (up - cot(slope) forward),  h_c = height of that point above S
//           B follows level at the approach heading: p_WB = p_WC - R_W(heading) p_BC
//   level   from the slope's end at kSettleHeight_m to where the skids are above the site
//   settle  hovers there until it is still enough
//   sink    straight down until the skids touch
//   A look ends on the slope, in a hover at its stop height.
//
// `skid height` is the height of the skid centre above the site, metres, up-positive.
#pragma once

#include <optional>

#include "engine/core/frames.h"
#include "engine/core/units.h"
#include "engine/flight/waypoints.h"
#include "engine/model/mission/mission_status.h"
#include "engine/model/vehicle_message.h"
#include "engine/model/vehicle_state.h"

namespace palace {

inline constexpr double kSettleHeight_m = 2.0;

/// How fast each part is flown: by the built-in vehicle, and in every time that is told beforehand.
struct DescentSpeeds {
  double sink_mps = 1.0;       ///< down the slope, the vertical part: what an approval asks for
  double slow_sink_mps = 0.5;  ///< the same below slow_height_m of skid height
  double slow_height_m = 4.0;
  double slope_end_m = kSettleHeight_m;  ///< skid height where the slope ends; a look hovers there
  double touch_mps = 0.35;  ///< straight down onto the site
  double acceleration_mps2 = 0.3;
  TravelLimits level{0.9, 0.5};
  double settle_s = 0;           ///< from the level leg's end to the sink: the vehicle's own
  TravelLimits align{2.0, 0.4};  ///< to where the slope begins, at the present height
  double turn_rate_rad_s = Rad(15);
  double hand_over_s = 1.0;  ///< from there to the first metre down, likewise

  /// Wanted vertical speed on the slope: braked before the slow part, and before its end so that
  /// this is no step for a height loop. Never below 0.1 m/s: the slope ends in finite time.
  double SinkRateAt(double skid_height_m) const;
};

enum class PathLeg { kSlope, kLevel, kSink };

/// A point of the path.
struct PathPoint {
  PathLeg leg = PathLeg::kSlope;
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();
  double skid_height_m = 0;
};

struct FlightPath {
  Eigen::Vector3d p_WS = Eigen::Vector3d::Zero();
  double heading_rad = 0;                          ///< of the approach, from north over east
  double slope_rad = 0;                            ///< below the horizon, (0, pi/2]
  Eigen::Vector3d p_BC = Eigen::Vector3d::Zero();  ///< left focal point in B
  Eigen::Vector3d skid_centre_B = Eigen::Vector3d::Zero();  ///< the touchdown point
  DescentSpeeds speeds{};

  /// It ends with a hover at the slope's end, not on the ground.
  bool IsLook() const { return speeds.slope_end_m > kSettleHeight_m; }
  /// Body to world at the approach heading, level.
  Eigen::Matrix3d LevelRotation() const;
  /// Where B is on the slope when the skid centre is skid_height_m above the site.
  Eigen::Vector3d BodyAt(double skid_height_m) const;
  /// Change of BodyAt per metre of skid height.
  Eigen::Vector3d BodyPerMetre() const;
  /// B with the skid centre straight above the site, level at the approach heading.
  Eigen::Vector3d BodyAboveSite(double skid_height_m) const;
  /// Height of the skid centre above the site when B is at p_WB, level.
  double SkidHeight(const Eigen::Vector3d& p_WB) const;
  /// Where the slope is entered from p_WB: at its height, never below the slope's end.
  Eigen::Vector3d Start(const Eigen::Vector3d& p_WB) const;
  /// The point of the whole path that is nearest to p_WB; |p_WB - nearest| is the distance off it.
  PathPoint Nearest(const Eigen::Vector3d& p_WB) const;
};

/// What of a vehicle its path depends on; points in B.
struct PathVehicle {
  Eigen::Vector3d p_BC = Eigen::Vector3d::Zero();  ///< left focal point
  Eigen::Vector3d skid_centre_B = Eigen::Vector3d::Zero();
  double settle_s = 0;
};

/// The path of an approach plan, or of what an approval asks for, for such a vehicle.
FlightPath PathOf(const ApproachPlan& plan, const Eigen::Vector3d& p_WS,
                  const PathVehicle& vehicle);
FlightPath PathOf(const Approval& approval, const PathVehicle& vehicle);

/// The straight approach: course from the skid centre to the site, from north over east.
double StraightHeading(const Eigen::Vector3d& p_W_skid, const Eigen::Vector3d& p_WS);

/// Seconds from hovering at p_WB with this yaw to the first metre down the slope.
double TimeToAlign(const FlightPath& path, const Eigen::Vector3d& p_WB, double yaw_rad);

/// The leg that the vehicle says it flies, and since when: where legs meet, the place alone does
/// not tell which one it is on, nor how long it has been waiting above the site.
struct LegFlown {
  PathLeg leg = PathLeg::kSlope;  ///< kLevel: to above the site, and waiting there
  double for_s = 0;
};

/// The rest of the descent on time: starts at the nearest point of the path, or of the leg flown,
/// with the velocity that the vehicle has, and is stepped from there. The level leg runs by its own
/// clock. Perfect control, calm air.
class TimedDescent {
 public:
  TimedDescent(const FlightPath& path, const Eigen::Vector3d& p_WB, const Eigen::Vector3d& v_WB,
               const std::optional<LegFlown>& flown = {});

  void Step(double dt_s);
  double skid_height_m() const { return skid_height_m_; }
  /// On the ground, or of a look at the slope's end.
  bool over() const { return skid_height_m_ <= (path_.IsLook() ? path_.speeds.slope_end_m : 0); }

 private:
  void StartLevel(const Eigen::Vector3d& from_W, const Eigen::Vector3d& v_WB);
  void Sink(double wanted_mps, double dt_s);

  FlightPath path_;
  PathLeg leg_;
  double skid_height_m_;
  double sink_mps_;
  MovingReference level_;
  double settled_s_ = 0;
};

/// Seconds from p_WB on the path to the touchdown, or to a look's hover; NaN where a number is not
/// finite, or where the way takes longer than an hour.
double TimeToTouchdown(const FlightPath& path, const Eigen::Vector3d& p_WB,
                       const Eigen::Vector3d& v_WB, const std::optional<LegFlown>& flown = {});

/// Where p_WB is on the path, and the heights of the next minute.
PathProgress ProgressOn(const FlightPath& path, const Eigen::Vector3d& p_WB,
                        const Eigen::Vector3d& v_WB, const std::optional<LegFlown>& flown = {});

}  // namespace palace
