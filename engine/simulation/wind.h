// Wind: a mean wind with logarithmic shear, and Dryden turbulence on top of it.
//
//   mean   U(h) = U20 ln(h / z0) / ln(h20 / z0), z0 = 0.15 ft, h20 = 20 ft
//   gusts  L_w = h, L_u = L_v = h / (0.177 + 0.000823 h)^1.2            (feet)
//          s_w = 0.1 W20, s_u = s_v = s_w / (0.177 + 0.000823 h)^0.4
//          H_u = s_u sqrt(2T)/(1 + T s), H_v = s_v sqrt(T)(1 + sqrt(3) T s)/(1 + T s)^2, T = L / V
// Source: MIL-F-8785C, low-altitude model, valid 10 ft to 1000 ft above ground (clamped).
// Deviation: V = max(|airspeed|, mean wind, 3 m/s), or the frozen gust field would stop in hover.
#pragma once

#include <Eigen/Dense>

#include "engine/core/random.h"

namespace palace {

struct WindOptions {
  double mean_mps = 0;      ///< at 20 ft above ground
  double from_rad = 0;      ///< direction the wind comes from, clockwise from north
  double gust_w20_mps = 0;  ///< W20 of the turbulence: light 7.7, moderate 15.4, severe 23.2
};

/// A mean wind with the gusts that go with it: their W20 is 1.5 times as much.
WindOptions GustyWind(double mean_mps, double from_rad);

class WindModel {
 public:
  WindModel(const WindOptions& options, std::uint64_t seed);
  /// Advances by dt_s and returns the velocity of the air in W (m/s).
  Eigen::Vector3d Advance(double dt_s, double height_above_ground_m, double airspeed_mps);
  /// Another wind from now on; the gusts under way grow or fade into the new ones.
  void Set(const WindOptions& options) { options_ = options; }
  /// The mean wind alone at that height, in W.
  Eigen::Vector3d Mean(double height_above_ground_m) const;

 private:
  WindOptions options_;
  RandomStream random_;
  double u_ = 0;                                       ///< longitudinal gust, m/s
  Eigen::Vector2d lateral_ = Eigen::Vector2d::Zero();  ///< filter state (x1, x2)
  Eigen::Vector2d vertical_ = Eigen::Vector2d::Zero();
};

/// Standard deviations (longitudinal, lateral, vertical) of the Dryden gusts, m/s.
Eigen::Vector3d DrydenSigma(double gust_w20_mps, double height_above_ground_m);

}  // namespace palace
