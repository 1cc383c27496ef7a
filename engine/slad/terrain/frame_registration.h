// Registration of one frame's heights to the fused map. Internal to the SLAD room.
#pragma once

#include "engine/model/elevation_map.h"

namespace palace {

/// Height correction offset + north_tilt (n - n0) + east_tilt (e - e0): frame minus map.
struct PlaneCorrection {
  double offset_m = 0;
  double north_tilt = 0;
  double east_tilt = 0;
  double north_m = 0;   ///< n0
  double east_m = 0;    ///< e0
  double height_m = 0;  ///< of the map, mean over what both measured

  double At(double n_m, double e_m) const {
    return offset_m + north_tilt * (n_m - north_m) + east_tilt * (e_m - east_m);
  }
};

/// Tukey-weighted least squares of frame - map over the cells measured in both. Zero when they
/// overlap too little to tell, or when the answer is larger than attitude and position noise can
/// explain (0.5 m, 1.5 degrees). Both maps share one geometry.
PlaneCorrection RegisterFrame(const ElevationMap& frame, const ElevationMap& map);

/// Adds gain times the correction to every known height.
void ApplyCorrection(const PlaneCorrection& correction, double gain, ElevationMap& map);

}  // namespace palace
