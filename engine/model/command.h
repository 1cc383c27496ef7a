// Commands: the other door into the engine. Commands set, never toggle.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include <Eigen/Dense>

#include "engine/model/mission/fly_area.h"

namespace palace {

/// Who asks; kStation is the program itself. Scripts may select and approve only on a simulated
/// vehicle (DESIGN.md 8).
enum class CommandOrigin : std::uint8_t { kOperator, kScript, kReplay, kStation };

/// Sets one limit by its config name, e.g. "slad.max_slope_deg". SEARCH, PROPOSED: applies at the
/// next map. ARMED and later: previews on a second evaluation.
struct SetSetting {
  std::string name;
  double value = 0;
};
/// Applies all previewed settings; drops an approval that is not flying yet.
struct ApplySettings {};
/// Discards all previewed settings.
struct DiscardSettings {};
/// Arms exactly one site; freezes its evidence.
struct SelectSite {
  std::uint64_t site_id = 0;
};
struct DisarmSite {};
/// Approves the armed site. Bound to the site id and the snapshot the operator was looking at.
struct ApproveSite {
  std::uint64_t site_id = 0;
  std::uint64_t snapshot_sequence = 0;
};
/// Sends the vehicle down the approach of the armed site to stop_height_m above it, the look height
/// that was on the screen, to hover there. Bound as an approval is, and as easily stopped.
struct LookAtSite {
  std::uint64_t site_id = 0;
  std::uint64_t snapshot_sequence = 0;
  double stop_height_m = 0;
};
/// Plans the approach of the armed site anew: from a side on which the maps call it clear.
struct TurnApproach {
  std::uint64_t site_id = 0;
  int side = 0;  ///< kStraightApproach or a sector (model/approach_side.h)
};
struct RefuseSite {
  std::uint64_t site_id = 0;
};
/// Sends the hovering vehicle to another hover, to look from there (mission/going.h).
struct FlyTo {
  Eigen::Vector3d p_WB = Eigen::Vector3d::Zero();  ///< NED metres
  double heading_rad = 0;                          ///< from north over east
};
/// Keeps the vehicle to an area from now on, in place of the one before.
struct SetFlyArea {
  FlyArea area;
};
struct ClearFlyArea {};
/// Stops a descent where it is. The approval is dead afterwards.
struct HoldHere {};
/// Aborts from any state: climb away.
struct WaveOff {};
struct AcknowledgeAlarm {
  std::string alarm;
};
/// Acknowledges that the wave-off is complete; back to SEARCH.
struct AcknowledgeWaveOff {};
struct AddBookmark {
  std::string note;
};
/// Asks the vehicle for command. `take_over`: also from a station that is heard.
struct AskForCommand {
  bool take_over = false;
};
/// Gives command of the vehicle back.
struct ReleaseCommand {};
/// The station's own note of a change of who commands: what is armed or flies is dropped with it.
struct CommandLost {
  std::string why;
};

using CommandAction =
    std::variant<SetSetting, ApplySettings, DiscardSettings, SelectSite, DisarmSite, ApproveSite,
                 LookAtSite, TurnApproach, RefuseSite, HoldHere, WaveOff, AcknowledgeAlarm,
                 AcknowledgeWaveOff, AddBookmark, AskForCommand, ReleaseCommand, CommandLost, FlyTo,
                 SetFlyArea, ClearFlyArea>;

struct EngineCommand {
  CommandOrigin origin = CommandOrigin::kOperator;
  CommandAction action;
};

/// Control of time, for sources that can: the simulator, a log, a folder of images.
struct PlaybackControl {
  enum class Kind : std::uint8_t { kPlay, kPause, kStepForward, kStepBack, kSeek, kSpeed, kRunTo };
  Kind kind = Kind::kPlay;
  /// kSeek: seconds from the start; kSpeed: times real time, 0 as fast as possible; kRunTo, of a
  /// simulation: plays to the first bundle at or after so many seconds from the start and pauses,
  /// at once where that is past.
  double value = 0;
};

}  // namespace palace
