// Where the landing rules of others would send the lander on the same pictures: yardsticks beside
// our sites. Each rule has its authors' parameters, and this lander's size and limits where it asks
// for a lander's.
//
//   raster     of each cell, 3x3: Horn's slope and largest less smallest height (gdaldem), against
//              the limits of slope and roughness
//   auterion   of each touchdown the least-squares plane over the lander's radius: slope at most
//              9 degrees, deviations at most 0.18 m, their standard deviation at most 0.055 m
//   alhat      a square lander with four pads of 0.3 m, for each heading on the three pads that
//              bear it (Ivanov, Huertas & Carson 2013): slope, and of what rises above the plane
//                P = min over the cells between the pads of Phi((limit - rise) / sigma),
//              rise and sigma (5 cm / 3) along the plane's normal, as a public copy has it; P at
//              least min_safe_probability
//   px4        PX4-Avoidance's safe_landing_planner (2024), points in cells of 0.25 m: at least 100
//              a frame, standard deviation at most 0.2 m; of the 11 x 11 cells around more than 70
//              such and at most 70 whose mean is 0.1 m off; filters over frames 0.9, decided at
//              0.4; the nearest place to the map's middle with all within 6 cells good. Unknown
//              cells count as of height 0 and not as such: up to 50 of the 121 may be
//
// raster, auterion and alhat are asked of the fused map's measured heights and take the place
// farthest from what they refuse: raster by the clear radius, the others by the navigation error,
// for theirs is a whole touchdown. px4 takes the points of the range maps; its grid, 10 m about the
// vehicle there, is the map's area here, and ten frames are half of those it decides by. Unknown
// ground is refused by the other three.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Dense>

#include "engine/experiments/field_trial.h"
#include "engine/model/elevation_map.h"
#include "engine/model/settings/settings.h"

namespace palace {

struct PeerPlace {
  const char* rule;
  std::optional<Eigen::Vector2d> place_m;  ///< W, north and east; nothing: it proposes none
};

/// One of each rule, in that order. `frames` must not be empty.
std::vector<PeerPlace> PlacesOfPeers(const std::vector<FieldFrame>& frames, const ElevationMap& map,
                                     const SladSettings& settings);

}  // namespace palace
