// What stands in the simulated world: shapes with a pose, a paint and a motion, and how experiments
// make them.
//
// W is north-east-down, so tops have negative z. The makers below give polyhedra, which can be cut
// further; their round ones have kSides flat sides that touch and leave the true surface by less
// than 1 % of its radius.
#pragma once

#include <limits>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/frames.h"
#include "engine/world/shapes.h"

namespace palace {

struct Solid {
  Shape shape;
  RigidTransform X_WO{};  ///< at time 0; upright: turned about the down axis only
  /// Albedo 0..1 of its own paint; NaN: it looks like the ground. Ray-cast pictures show a painted
  /// solid at that share of 255, under a third of the ground's contrast.
  double albedo = std::numeric_limits<double>::quiet_NaN();
  /// m/s. Rays, pictures and the simulator meet it where X_WO says; WorldAt moves it there.
  Eigen::Vector3d v_WO = Eigen::Vector3d::Zero();
  bool soft = false;  ///< leaves and twigs, which give way; known to the truth alone
};

/// Upright on a place, turned from north towards east.
RigidTransform Upright(const Eigen::Vector3d& p_WO, double yaw_rad);
/// Where the ray p + s r of W enters the solid: as Enter of its shape.
double Enter(const Solid& solid, const Eigen::Vector3d& p_W, const Eigen::Vector3d& r_W);
/// Horizontal distance from a place to the solid seen from above, metres; 0 under or on it.
double DistanceFromAbove(const Solid& solid, double north_m, double east_m);

/// On level ground at height 0, sides along north and east; metres.
Solid MakeBox(double north_m, double east_m, double size_north_m, double size_east_m,
              double height_m);
/// A level slab between two heights.
Solid MakeSlab(double north_m, double east_m, double size_north_m, double size_east_m,
               double from_m, double to_m);
/// A ramp that rises to the north by `slope_rad` over `length_m`, centred at (north, east).
Solid MakeWedge(double north_m, double east_m, double length_m, double width_m, double slope_rad);
/// Upright cone whose radius shrinks from the ground to the top; equal radii make a cylinder, a top
/// radius of 0 a point.
Solid MakeCone(double north_m, double east_m, double foot_radius_m, double top_radius_m,
               double height_m);
/// Straight wire, pole or antenna of any direction between two points of W.
Solid MakeRod(const Eigen::Vector3d& from_W, const Eigen::Vector3d& to_W, double diameter_m);
/// A road cone: a square foot half as wide as the cone is high, 1/20 of its height thick, and a
/// cone of 0.36 to 0.08 of the height across (28 in: 0.71 m high, 0.36 m wide). The foot is black
/// rubber, the cone orange with a white collar.
std::vector<Solid> MakeTrafficCone(double north_m, double east_m, double height_m);

/// Turned about the down axis through the origin of W, north towards east, then shifted.
Solid Moved(const Solid& solid, double turn_rad, const Eigen::Vector3d& shift_W);

}  // namespace palace
