// What stands in the approach of a site.
#pragma once

#include <cstdint>
#include <limits>

namespace palace {

struct ApproachObstacle {
  enum class Kind : std::uint8_t {
    kStands,      ///< on the ground, as high as the way down or higher
    kThin,        ///< a thin structure: a wire, a rope
    kOnLevelWay,  ///< on the level way from the vehicle to where the approach begins; no more is
                  ///< known of it
  };
  Kind kind = Kind::kStands;
  /// Above the site. Infinite: a thin structure of unknown height. NaN: not known.
  double top_m = std::numeric_limits<double>::quiet_NaN();
  double distance_m = std::numeric_limits<double>::quiet_NaN();   ///< horizontal, from the site
  double bearing_rad = std::numeric_limits<double>::quiet_NaN();  ///< from it, north clockwise
};

}  // namespace palace
