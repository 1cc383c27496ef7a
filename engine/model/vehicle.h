// The airframe as data: where its gear is, so that no room has it written into its code.
#pragma once

#include <array>

#include <Eigen/Dense>

namespace palace {

/// Defaults: the R-50 on its skids. Metres, in B.
struct Airframe {
  /// The touchdown point: centre of the skids.
  Eigen::Vector3d skid_centre_B{0.0, 0.0, 0.9};
  double skid_length_m = 1.2;
  double skid_width_m = 0.9;  ///< between the skids

  /// Where the gear can meet the ground: its centre and the four ends.
  std::array<Eigen::Vector3d, 5> SkidPoints() const {
    const Eigen::Vector3d ahead(skid_length_m / 2, 0, 0), aside(0, skid_width_m / 2, 0);
    return {skid_centre_B, skid_centre_B + ahead + aside, skid_centre_B + ahead - aside,
            skid_centre_B - ahead + aside, skid_centre_B - ahead - aside};
  }
};

}  // namespace palace
