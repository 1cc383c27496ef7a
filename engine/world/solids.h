// Obstacles of ray-cast worlds: convex solids as intersections of half-spaces.
//
// W is north-east-down, so tops have negative z. Round solids have kSides flat sides that touch and
// leave the true surface by less than 1 % of its radius.
#pragma once

#include <limits>
#include <vector>

#include <Eigen/Dense>

namespace palace {

/// Points p of W with normal . p <= offset.
struct HalfSpace {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset = 0;
};

/// Convex: the points inside all faces. Made by the functions below, which know its corners.
struct Solid {
  std::vector<HalfSpace> faces;
  std::vector<Eigen::Vector3d> corners{};  ///< empty: unknown, it may be anywhere
  /// Mean grey of its own paint, under which the ground's texture shows at a third of its contrast;
  /// NaN: it looks like the ground.
  double tone_grey = std::numeric_limits<double>::quiet_NaN();
};

/// The bounded intersection of half-spaces, with its corners.
Solid MakeSolid(std::vector<HalfSpace> faces);

/// On level ground at height 0, sides along north and east; metres.
Solid MakeBox(double north_m, double east_m, double size_north_m, double size_east_m,
              double height_m);
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

/// Where the ray p + s r enters the solid, s >= 0; infinity when it misses, 0 from inside
/// (Cyrus & Beck 1978).
double EnterSolid(const Solid& solid, const Eigen::Vector3d& p_W, const Eigen::Vector3d& r_W);

/// Horizontal distance from a place to the solid seen from above, metres; 0 under or on it.
double DistanceFromAbove(const Solid& solid, double north_m, double east_m);

}  // namespace palace
