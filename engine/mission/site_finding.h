// What one map says of the site that was approved.
//
//   gross      an obstacle under the lander, beyond twice its limit and beyond 3 sigma of it
//   over       some figure is over its limit, unknown, or the site is off the map; or the vehicle
//   is
//              on its way and something stands in it
//   doubtful   inside every limit, but: the limit lies within the 3 sigma of a figure although the
//              site was confirmed before, the approach is blocked before any approval, a hazard
//              leaves less than half the room that was approved, or the ground was last measured
//              too long ago
//   good       none of these
//
// The vehicle's limits are fixed; what distance changes is the sigma. A provisional site is one
// whose sigma cannot tell yet: its bands are no reason for doubt until it was confirmed once.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/model/cell_explanation.h"
#include "engine/model/landing_site.h"
#include "engine/model/settings/settings.h"

namespace palace {

enum class Finding : std::uint8_t { kGood, kDoubtful, kOver, kGross };

struct SiteFinding {
  Finding finding = Finding::kOver;
  std::string reason;           ///< "Slope 12.0°, max 10°"; empty when good
  bool approach_clear = false;  ///< straight from the vehicle
  /// "Ground last measured 16.3 s ago, limit 2.0 s"; empty while it is new enough. In the descent
  /// it is a doubt; before it, no approval is given on it (G8).
  std::string old_ground{};
  /// "Air over the site seen up to 3.9 m, on the way down up to 4.2 m, min 5.0 m"; empty where one
  /// is enough. No approval is given on it: what hangs higher (a wire, a branch) no picture shows.
  std::string low_air{};
  bool holds() const { return finding < Finding::kOver; }
};

/// What the site was known to be.
struct ApprovedEvidence {
  bool confirmed = false;
  double clearance_m = 0;  ///< room beyond the clear radius
  bool flown_to = false;   ///< approved: the vehicle is on its way, or about to be
};

constexpr double kLeastRoomShare = 0.5;  ///< of the approved clearance
constexpr double kNoticedRoom_m = 0.3;   ///< a smaller loss of room is noise of two cells

/// `now`: the site evaluated on the newest map, empty when it lies outside. `nearest`: the hazard
/// nearest to it, when known. Room that shrinks because the map ends or was not seen is no doubt by
/// itself: the view narrows on the way down.
SiteFinding JudgeRecheck(const std::optional<LandingSite>& now,
                         const std::optional<NearestHazard>& nearest,
                         const ApprovedEvidence& approved, const SladSettings& settings);

}  // namespace palace
