// A place to land at as the maps of a flight have shown it so far, and what the newest one found
// there.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Dense>

#include "engine/core/time.h"
#include "engine/model/landing_site.h"
#include "engine/slad/sites/steadiness.h"

namespace palace {

struct SitePlace {
  std::uint64_t id = 0;  ///< 0: never listed yet
  std::string letter{};
  Eigen::Vector2d p_W = Eigen::Vector2d::Zero();  ///< north, east
  Eigen::Vector2d named_at = p_W;                 ///< where the letter was given
  int rank = -1;                                  ///< in the list; -1: not listed
  int run = 0;                                    ///< maps in a row that it could bear the lander
  SteadyFigure score{};
  SteadyVerdict confirmed{}, air_shown{}, straight_clear{}, some_clear{}, roomy{};
  LastingClaim beaten{};
  double look_height_m = NAN;            ///< LandingSite::look_height_m, as it was told last
  int losses = 0;                        ///< maps that called it unsafe
  std::optional<Timestamp> shaken_at{};  ///< by the last of them

  /// Seconds since a map called it unsafe, while it stands behind the others for it; else NaN.
  double ShakenFor(Timestamp now) const;
};

/// What a map found at a place.
struct FoundSite {
  std::size_t place = 0;  ///< among those of the flight
  LandingSite site;
};

}  // namespace palace
