// What the families share: how numbers, places, light and relief are drawn.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include <Eigen/Dense>

#include "engine/core/random.h"
#include "engine/world/lattice_noise.h"
#include "engine/world/world.h"

namespace palace {

struct Range {
  double low = 0;
  double high = 0;
};

double Draw(RandomStream& random, const Range& range);     ///< uniform
double DrawLog(RandomStream& random, const Range& range);  ///< uniform in the logarithm
bool Chance(RandomStream& random, double share);
/// Sizes of which N(> size) falls as size^-exponent (rocks, Golombek and Rapp 1997, in short).
double DrawPower(RandomStream& random, const Range& range, double exponent);
double DrawAngle(RandomStream& random);  ///< 0 .. 2 pi

/// Ground the pictures show: 2 to 44 m north, 20 m to both sides.
Eigen::Vector2d DrawPlace(RandomStream& random);
/// At most `count` places no nearer to each other than `apart_m`.
std::vector<Eigen::Vector2d> DrawPlaces(RandomStream& random, int count, double apart_m);

/// Seed and direction of the texture are drawn too.
Material DrawMaterial(RandomStream& random, GroundTexture texture, const Range& scale,
                      const Range& contrast);
/// From hazy to hard light, any direction, at least 18 degrees high.
Sun DrawSun(RandomStream& random);

/// A square of relief about the middle of what is seen.
std::shared_ptr<const HeightField> ReliefOf(const std::function<double(double, double)>& height,
                                            int levels = 10, double size_m = 64,
                                            double north_m = 16);

/// A solid whose own origin goes onto the ground there, turned and sunk.
Solid PutOn(const Ground& ground, Solid solid, const Eigen::Vector2d& place_m, double turn_rad = 0,
            double sunk_m = 0);
/// The same for what is made of several.
void PutOn(World& world, const std::vector<Solid>& solids, const Eigen::Vector2d& place_m,
           double turn_rad = 0);
Solid Painted(Solid solid, double albedo);

/// 0 below -half a width, 1 above: how far down a steep wall a place is.
double WallShare(double inside_m, double wall_m);

/// An irregular closed outline about a place: pads, holes, pools, clearings, patches.
class Blob {
 public:
  /// Lobes of at most this share of the radius.
  Blob(RandomStream& random, const Eigen::Vector2d& middle_m, double radius_m, double lobes);
  /// Metres from the outline towards the middle, along a radius; negative outside.
  double Inside(double north_m, double east_m) const;
  GroundPatch Patch(const Material& material) const;
  Blob Widened(double by_m) const;
  const Eigen::Vector2d& middle_m() const { return middle_m_; }
  double radius_m() const { return radius_m_; }

 private:
  double RadiusAt(double angle_rad) const;
  struct Lobe {
    double share, phase_rad;
  };
  Eigen::Vector2d middle_m_;
  double radius_m_;
  std::vector<Lobe> lobes_;  ///< of two, three ... waves around
  double reach_m_;
};

/// A line with corners: ditches, drains, kerbs, tracks.
class Course {
 public:
  explicit Course(std::vector<Eigen::Vector2d> corners_m);
  /// From one place on, wandering by up to `wander_m` over `pieces`.
  Course(RandomStream& random, const Eigen::Vector2d& from_m, double heading_rad, double length_m,
         int pieces, double wander_m);
  double Distance(double north_m, double east_m) const;
  const std::vector<Eigen::Vector2d>& corners_m() const { return corners_m_; }
  /// Strips of this width along it.
  void Paint(Ground& ground, double width_m, const Material& material) const;

 private:
  std::vector<Eigen::Vector2d> corners_m_;
  Eigen::AlignedBox2d box_;
};

}  // namespace palace
