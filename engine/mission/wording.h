// Sentences of the mission: why a state was entered or a command refused, and what became of the
// armed site. The rules decide; these say it. Sentences of guards and alarms stand in their tables.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/mission/mission_memory.h"
#include "engine/model/command.h"

namespace palace::words {

// Why a state was entered or left.
inline constexpr const char* kNoDataYet = "No data yet";
inline constexpr const char* kCamerasLive = "Cameras are live";
inline constexpr const char* kNoNewMap = "No new map";
inline constexpr const char* kNoSiteStands = "No site stands on the newest map";
inline constexpr const char* kEverySiteRefused = "Every site on the newest map is refused";
inline constexpr const char* kRestarted = "Vehicle restarted";
inline constexpr const char* kLimitsChanged = "Limits changed";
inline constexpr const char* kCalibrationChanged = "Calibration changed";
inline constexpr const char* kArmWindowOver = "Arm window is over, select the site again";
inline constexpr const char* kExpired = "Approval expired before the descent began";
inline constexpr const char* kVehicleAborts = "Vehicle aborts by itself";
inline constexpr const char* kVehicleHolds = "Vehicle holds by itself";
inline constexpr const char* kLeftDescent = "Vehicle left the descent";
inline constexpr const char* kCourseNotJudged = "No map has judged this approach yet";
inline constexpr const char* kSideNotClear = "No clear approach is known from that side";
inline constexpr const char* kWentPastLook = "Vehicle did not stop where the look was to end";
inline constexpr const char* kFliesWithdrawn = "Vehicle flies a withdrawn approval";
inline constexpr const char* kHeightUnknown = "Height above the site is unknown";
inline constexpr const char* kReevaluated = "Vehicle hovers, sites re-evaluated";
inline constexpr const char* kWaveOffOver = "Wave-off complete and acknowledged";
inline constexpr const char* kTimeJumped = "Time jumped";
inline constexpr const char* kJumped = "Jumped in time";
inline constexpr const char* kHeldByOperator = "Held by the operator";
inline constexpr const char* kWavedOff = "Waved off by the operator";
inline constexpr const char* kDeselected = "Deselected by the operator";
inline constexpr const char* kWithdrawn = "Approval withdrawn by the operator";

// Why a command was refused.
inline constexpr const char* kRecordedOnly = "Recorded commands act in a replay only";
inline constexpr const char* kNoScript =
    "A script may select and approve only on a simulated vehicle";
inline constexpr const char* kNoDescent = "No descent to hold";
inline constexpr const char* kNoWaveOff = "No wave-off to acknowledge";
inline constexpr const char* kNotOnMap = "That site is not on the newest map";
inline constexpr const char* kPreviewOnly = "That place has no letter: only a preview shows it";
inline constexpr const char* kPlaceUnknown = "The place of that site is not known";
inline constexpr const char* kNoneSelected = "No site is selected";
inline constexpr const char* kNoneProposed = "No site is proposed";
inline constexpr const char* kSelectFirst = "Select a site first";
inline constexpr const char* kAlreadyApproved = "Already approved";
inline constexpr const char* kApprovedHold = "Already approved, hold or wave off";
inline constexpr const char* kNearEnough = "The vehicle is hardly higher than the look would be";
inline constexpr const char* kOnAWay = "The vehicle flies to another hover";
inline constexpr const char* kOtherPicture =
    "The picture on the screen was not that of this selection";
std::string Commands(const std::string& fingerprint);
/// "Foreign command from 10.0.0.2:4711: APPROVE on COMMAND, 3 in all".
std::string ForeignCommand(const ForeignTraffic& foreign);
inline constexpr const char* kCommandsAlready = "This station commands already";
inline constexpr const char* kReleased = "Command given back by the operator";
std::string AskedForCommand(const AskForCommand& action, const std::string& holder);
std::string CommandLostTo(const std::string& why);
/// "Vehicle aborts by itself: no position from vision for 2.0 s, limit 2.0 s", or without a reason.
std::string VehicleAborts(const std::string& reason);
/// "Vision lost for 2.1 s, limit 2.0 s (left camera shows nothing)"; `why` is not empty.
std::string Because(const std::string& what, std::string why);
/// "Vehicle holds by itself: estimate and GPS part", or without a reason.
std::string VehicleHolds(const std::string& reason);
/// `text`: of the alarm, in whose words the event names it; empty: it was never told.
std::string Acknowledged(const std::string& text);
std::string NotStanding(const std::string& text);
/// "Over after 3.4 s: GPS horizontal error 2.6 m"; of one that has a figure, its worst.
std::string AlarmOver(const Alarm& alarm, Timestamp now);
std::string CannotSelectIn(MissionState state);
std::string CannotGoIn(MissionState state);
/// "Sent 12.0 m north, 3.0 m up, to look along 045°, over 5.2 m of ground that no map showed, by
/// the operator".
std::string SentTo(const Eigen::Vector3d& way_W, double heading_rad, double unseen_m,
                   const char* who);
/// "Vehicle kept to an area of 1250 m² up to 30 m, by the operator", and how far outside it hovers,
/// if it does; `p_WB`: NaN where that is not known.
std::string AreaSet(const FlyArea& area, const char* who, const Eigen::Vector3d& p_WB);
/// Why a way leaves the area: "It leaves the area by 3.2 m", of one that comes from outside "It
/// ends 3.2 m outside the area" or "It leaves the area again by 3.2 m". Empty: it stays in, or goes
/// in.
std::string WayLeavesArea(const FlyArea& area, const Eigen::Vector2d& from_W,
                          const Eigen::Vector2d& to_W);
/// The same of the legs of a way to a site: "The way to site B leaves the area by 3.2 m", "Site B
/// lies 3.2 m outside the area".
std::string WayToSiteLeavesArea(const FlyArea& area, const std::vector<Eigen::Vector3d>& way_W,
                                const std::string& letter);
/// "right 45°", "up 3 m", "12 m NE": the way in words short enough for a button.
std::string WayInShort(const Eigen::Vector3d& way_W, double turn_rad);
std::string NotTheArmedOne(const MissionStatus& status);

/// "stale, 1.8 s" or "never received".
std::string Age(double age_s);
/// "Vehicle clock stepped ahead 5.0 s".
std::string ClockStepped(double step_s);
/// "Left camera stale, 1.8 s"; empty when the age is known and within the limit.
std::string Older(const char* what, double age_s, double limit_s);

/// "Image time off by 100 ms against attitude: pictures of both cameras are late"; empty while no
/// camera's is known to be off.
std::string ImageTimeOff(const NavigationStatus& navigation);
/// "Attitude is 3.0° off gravity, limit 1.5° (or the accelerometer errs)"; empty while not.
std::string GravityOff(const GravityAgreement& gravity);
/// "GPS is 8.0 m off the inertial prediction, limit 1.0 m"; empty while it is not.
std::string GpsOff(const GpsAgreement& gps);
/// "Laser lost for 0.6 s, limit 0.5 s"; empty while nothing is wrong with it.
std::string LaserFault(const LaserHealth& laser);

/// "site A", or "the site" when none is armed.
std::string SiteName(const MissionStatus& status);
/// What an approval is of: the same, or "a look at site A".
std::string Approved(const MissionStatus& status);
std::string SiteSelected(const std::string& letter);
/// "Selection of site A ended: arm window is over ..."
std::string SelectionEnded(std::string_view site, std::string_view why);
std::string DescentStopped(const MissionStatus& status, std::string_view why);
std::string SiteWon(const std::string& letter, int maps);
std::string SiteLeads(const std::string& letter);
/// "Site A refused".
std::string SiteRefused(const std::string& letter);
/// `next`: the site that is best now, null when there is none.
std::string RefusedAndNext(const std::string& letter, const LandingSite* next);
/// A changed verdict over the armed site.
std::string SiteTold(const MissionMemory& memory, SiteVerdict verdict);
/// "Site A confirmed, 9.8 m above it".
std::string SiteConfirmed(const std::string& letter, double height_m);
std::string Alternative(const MissionMemory& memory);
/// "Site A is not on the newest map".
std::string OffTheMap(const std::string& letter);
std::string NotConfirmed(const std::string& letter);
/// A provisional site so low that it cannot be approved any more.
std::string ConfirmHigher(const std::string& letter);
/// Why a site cannot be approved from so low, and what to do.
std::string LookFromAbove(const std::string& why);
std::string NothingToLookAt(const std::string& letter);
/// "Site B was looked at from 12.1 m above it: confirmed", or what the newest map found.
std::string LookedAt(const MissionMemory& memory, double height_m);
/// `round_unseen`: ways round are clear, over ground that was not looked at.
std::string ApproachBlocked(const std::string& letter, bool round_unseen);
/// "Something 3.2 m high stands in the approach, 4.5 m south of the site". Null: not known what.
std::string InApproach(const std::optional<ApproachObstacle>& obstacle);
/// After what is told of a selection; empty for a straight approach, or none yet.
std::string ApproachTurned(const std::optional<ApproachPlan>& plan);
/// "Approach of site B turned by the operator: from the west".
std::string ApproachTurnedBy(const MissionStatus& status, const char* who);

std::string ApprovalGiven(const MissionStatus& status, const SladSettings& limits,
                          std::uint64_t counter);
std::string ApprovedBy(const char* who);
std::string ApprovalEnded(std::string_view site, std::string_view why);
std::string Withdrawn(std::string_view why);
std::string VehicleAccepted(std::string_view site);
std::string VehicleRefusedApproval(std::string_view site, std::string_view why);
std::string VehicleRefused(std::string_view site, std::string_view why);
std::string Descends(std::string_view site);
std::string OnTheGround(std::string_view site);
/// "Vehicle says it is on the ground, 7.7 m from the centre of site A and 6.1 m above it".
std::string NotAtSite(std::string_view site, double miss_m, double height_m);
/// What became of a wave-off: ". Vehicle climbs. When it hovers, confirm ..."
std::string WaveOffTold(const WaveOffReport& report);
/// "Ground of site A not measured for 2.1 s".
std::string GroundNotMeasured(const std::string& letter, double age_s);
std::string VisionLost(double outage_s, double limit_s);
/// "0.92 m beside site A, limit 0.75 m: nobody judged the ground there".
std::string Beside(std::string_view site, double miss_m, double limit_m);

}  // namespace palace::words
