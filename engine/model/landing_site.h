// Landing site: a place SLAD proposes, with the figures that justify it.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/time.h"
#include "engine/model/approach_obstacle.h"
#include "engine/model/grid.h"

namespace palace {

/// Ids from here on are of places that no list of the flight holds, only one under other limits (a
/// preview, a re-decision). Their letters are "+1", "+2", of that one list, and no command takes
/// them.
inline constexpr std::uint64_t kFirstUnnamedSite = std::uint64_t{1} << 63;
/// The place has a letter of the flight.
constexpr bool IsNamedSite(std::uint64_t site_id) { return site_id < kFirstUnnamedSite; }

/// A figure with three standard deviations, as every band on screen is.
struct Figure {
  double value = 0;
  double three_sigma = 0;
};

/// Safe touchdown of the lander's gear by heading; NaN in thesis mode.
struct TouchdownOdds {
  double worst_probability = std::numeric_limits<double>::quiet_NaN();
  double worst_heading_rad = std::numeric_limits<double>::quiet_NaN();  ///< from north, 0..2 pi
  double best_probability = std::numeric_limits<double>::quiet_NaN();
  double best_heading_rad = std::numeric_limits<double>::quiet_NaN();
};

struct LandingSite {
  std::uint64_t id = 0;  ///< stays with the place for the whole mission
  /// A to Z, then A2 to Z2, ...; stays with the id, never given twice. "+1": IsNamedSite.
  std::string letter = "A";
  Timestamp map_time;
  Cell cell;                                             ///< in the map it was chosen on
  Eigen::Vector3d p_WS = Eigen::Vector3d::Zero();        ///< site centre on the ground, NED metres
  Eigen::Vector3d normal_W = -Eigen::Vector3d::UnitZ();  ///< ground normal, pointing up
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< in the rectified left image of map_time
  Figure slope_rad;
  Figure roughness_m;
  Figure step_m;
  Figure height_m;             ///< height in W, up-positive; three_sigma is the height noise
  double safe_distance_m = 0;  ///< to the nearest hazard
  double clear_radius_m = 0;   ///< required: lander radius + navigation error
  double clearance_m = 0;      ///< safe_distance - clear_radius
  double cost = 0;
  double safe_probability = 1;
  TouchdownOdds touchdown;
  /// Rocks and holes over the roughness limit expected unseen within the clear radius; NaN: not
  /// known (a survey, a record). It is part of the probabilities.
  double hidden_things = std::numeric_limits<double>::quiet_NaN();
  std::uint8_t flags = 0;  ///< TerrainFlag bits of the cells inside the clear radius
  int unknown_cells = 0;   ///< inside the clear radius
  int frames_fused = 0;    ///< that nine tenths of the clear radius's cells have at least
  /// 3 sigma of height below the roughness limit, P at least min_safe_probability, seen in 3 frames
  /// (pictures only), cell no wider than max_rock_size_m, hidden_things at most kMostHidden.
  bool confirmed = false;        ///< and air_seen_m at least kLeastAirSeen_m, where that is asked
  bool newest_confirms = false;  ///< so says the newest map; `confirmed` is steady over maps
  /// The corridor, rotor-wide, and the level way to where it begins: straight, or as it is planned.
  bool corridor_clear = true;
  /// What stands there, of a site that was re-checked (Slad::Recheck) and is not clear.
  std::optional<ApproachObstacle> in_approach;
  /// Bit k: such a corridor is clear from sector k of eight, from north clockwise, and so is the
  /// level way from the vehicle to where it begins.
  std::uint8_t clear_approaches = 0xFF;
  double age_s = 0;  ///< since the ground inside the clear radius was measured, mean
  /// How far up over nine tenths of the clear radius the cameras have looked, above the site: what
  /// hangs higher was not seen. NaN: nobody asked (a survey, thesis mode, a record).
  double air_seen_m = std::numeric_limits<double>::quiet_NaN();
  /// How far up the camera looks over as much of the clear radius from where the glide slope to the
  /// site begins, at its height and tilt of map_time: no later part of the way down shows more. NaN
  /// as air_seen_m.
  double air_on_way_m = std::numeric_limits<double>::quiet_NaN();
  /// Height of the touchdown point above the site from which, along the same line of sight, its
  /// noise would be low enough and hardly anything could hide, which is what speaks against it now;
  /// where only the air speaks against it, the highest that is a way to go. NaN: neither does, no
  /// height above kConfirmHeight_m would do, air_on_way_m is too little, a mark lies there that no
  /// height explains, or nobody asked.
  double look_height_m = std::numeric_limits<double>::quiet_NaN();
  double distance_m = 0;  ///< horizontal, from the vehicle at map_time
  /// Since a map called it, or the ground beside it, unsafe: for that it stands behind the others.
  /// NaN: for no such reason.
  double called_unsafe_s = std::numeric_limits<double>::quiet_NaN();
  std::string reason;  ///< one reason for its rank, in words
};

/// Outcome of one site selection.
struct SiteSelection {
  std::vector<LandingSite> sites;  ///< best first
  std::string none_reason;         ///< set when empty: "71 % slope, 22 % unknown, 7 % footprint"
  bool waits = false;              ///< too early to list any: none_reason says how far it is
  std::uint64_t named = 0;         ///< places that had a letter by then, listed now or not
};

}  // namespace palace
